#include "effects/effect_fixture.hpp"

#include <cmath>

namespace freestand::test {
namespace {

CaseFamily family_of(Model model) {
  CaseFamily family;
  family.seed = 77;
  family.alpha_low = model == Model::slide ? 0.6 : 0.15;
  family.alpha_high = model == Model::slide ? 1.2 : 0.45;
  family.mu_high = model == Model::slide ? 0.5 : 0.7;
  family.two_coefficients = 0;
  family.one_model = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 5;
  family.excess_low = 1.1;
  family.excess_high = 3;
  return family;
}

constexpr Settings tight{.tolerance = 1e-12}, looser{.tolerance = 1e-10};
constexpr double nudge = 1e-10;    // of the shaking
constexpr double too_much = 1e-7;  // what moves by more is not compared

void expect_mirror(const Response& a, const Response& b, const std::string& text) {
  EXPECT_EQ(a.outcome, b.outcome) << text;
  EXPECT_EQ(a.peak_slip_m, b.peak_slip_m) << text;
  EXPECT_EQ(a.residual_slip_m, -b.residual_slip_m) << text;
  EXPECT_EQ(a.slid_path_m, b.slid_path_m) << text;
  EXPECT_EQ(a.peak_rotation_rad, b.peak_rotation_rad) << text;
  EXPECT_EQ(a.peak_acceleration_mps2, b.peak_acceleration_mps2) << text;
  EXPECT_EQ(a.events, b.events) << text;
}

Block plain_block(double width, double height) { return Block::rectangular(width, height, 100); }

}  // namespace

EffectUse effect(const std::string& name, const std::vector<double>& parameters) {
  const effects::Effect* found = effects::find(name);
  if (!found || found->parameters.size() < parameters.size()) throw std::invalid_argument(name);
  EffectUse use{found, parameters};
  for (std::size_t i = parameters.size(); i < found->parameters.size(); ++i)
    use.parameters.push_back(found->parameters[i].fallback.value());
  return use;
}

Specimen sliding(double mu, const std::vector<EffectUse>& effects) {
  return {plain_block(1.2, 0.8), {mu, mu}, {}, Model::slide, effects};
}

Specimen slender(double mu, const std::vector<EffectUse>& effects, Model model) {
  return {plain_block(0.4, 1.8), {mu, mu}, {}, model, effects};
}

Path run(const Solver& solver, const Specimen& specimen, const Shaking& shaking, double free_s, double step_s) {
  Settings settings;
  settings.tolerance = 1e-12;
  settings.free_vibration_s = free_s;
  History history;
  history.step_s = step_s;
  Path result;
  result.response = solver(specimen, shaking, settings, &history);
  result.points = std::move(history.points);
  return result;
}

double distance(const Response& a, const Response& b) {
  if (a.outcome != b.outcome) return 1;
  double most = 0;
  for (const auto value :
       {&Response::peak_slip_m, &Response::residual_slip_m, &Response::slid_path_m, &Response::peak_rotation_rad})
    most = std::fmax(most, std::abs(a.*value - b.*value));
  return most;
}

double moved_by(double part, const Specimen& specimen, const Shaking& shaking, const Settings& settings,
                const Response& answer) {
  double most = 0;
  for (const double factor : {1 - part, 1 + part}) {
    Shaking changed = shaking;
    changed.scale *= factor;
    most = std::fmax(most, distance(respond(specimen, changed, settings), answer));
  }
  return most;
}

namespace {

// How far a hundred tolerances may move an answer, of the shaking or of the steps: impacts and slips amplify round-off.
double doubt(const Specimen& specimen, const Shaking& shaking, const Response& answer) {
  return std::fmax(moved_by(nudge, specimen, shaking, tight, answer),
                   distance(respond(specimen, shaking, looser), answer));
}

}  // namespace

void expect_general(const General& general) {
  const effects::Effect& law = *effects::find(general.name);
  for (const Model model : general.models) {
    int compared = 0, mattered = 0;
    for (int number = 0; number < general.cases; ++number) {
      RandomCase c = random_case(family_of(model), static_cast<std::uint64_t>(number));
      c.specimen.model = model;
      if (c.specimen.impact.law == ImpactLaw::coulomb) c.specimen.impact.factor = 1;
      const std::string text = general.name + ", " + c.text();
      const Response plain = respond(c.specimen, c.shaking, tight);
      const double plain_moves = doubt(c.specimen, c.shaking, plain);

      if (!general.neutral.empty() && plain_moves < too_much) {
        Specimen without = c.specimen;
        without.effects = {effect(general.name, general.neutral)};
        EXPECT_LE(distance(respond(without, c.shaking, tight), plain), law.dynamic() ? 1e-10 + plain_moves : 0.0)
            << text << ", neutral; moves by " << plain_moves;
      }

      c.specimen.effects = {effect(general.name, general.values)};
      const Response with = respond(c.specimen, c.shaking, tight);
      EXPECT_TRUE(with.outcome == Outcome::at_rest || with.outcome == Outcome::moved ||
                  with.outcome == Outcome::overturned || with.outcome == Outcome::painleve)
          << text << " " << name(with.outcome);
      mattered += distance(with, plain) > 1e-6;

      Specimen image = c.specimen;
      std::swap(image.block.left_m, image.block.right_m);
      image.effects = {effect(general.name, general.mirrored)};
      Shaking negative = c.shaking;
      negative.scale = -negative.scale;
      expect_mirror(with, respond(image, negative, tight), text + ", mirrored");

      const double moves = doubt(c.specimen, c.shaking, with);
      if (moves > too_much) continue;
      EXPECT_LE(distance(respond_reference(c.specimen, c.shaking, tight), with), 1e-8 + moves)
          << text << ", reference; moves by " << moves;
      ++compared;
    }
    EXPECT_GE(compared, general.cases / 2) << general.name;
    EXPECT_GE(mattered, general.matters) << general.name;
  }
}

}  // namespace freestand::test
