// The catalogue: complete, as PHYSICS names it, and open: an effect that is declared in one file shows up everywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <freestand/error.hpp>
#include <map>

#include "effects/effect_fixture.hpp"
#include "study/effects_page.hpp"
#include "study/known.hpp"
#include "study/realise.hpp"
#include "support/data.hpp"
#include "support/error_text.hpp"

namespace freestand::test {
namespace {

using testing::HasSubstr;

const std::map<std::string, std::vector<std::string>> names_and_keys = {
    {"static_friction", {"ratio"}},
    {"rate_weakening", {"drop", "speed_mps"}},
    {"rate_strengthening", {"rise", "speed_mps"}},
    {"friction_wear", {"ratio", "path_m"}},
    {"directional_friction", {"asymmetry"}},
    {"pressure_friction", {"exponent"}},
    {"viscous_drag", {"rate_per_s"}},
    {"floor_tilt", {"angle_rad"}},
    {"vertical_shaking", {"scale"}},
    {"flexible_legs", {"frequency_hz", "damping"}},
    {"slack_tether", {"slack_m", "frequency_hz", "rate_per_s"}},
    {"centering_spring", {"frequency_hz"}},
    {"wall_impact", {"gap_m", "restitution", "side", "other_gap_m"}},
    {"moving_contents", {"mass_ratio", "frequency_hz", "damping"}},
    {"impact_loss", {"factor"}},
    {"reduced_base", {"ratio"}},
    {"offset_mass", {"eccentricity"}},
};

bool is_toy(const effects::Effect& effect) { return effect.name == "spilt_oil"; }

study::Study study_with(const std::string& effects, const std::string& model = "slide_rock") {
  return study::parse_study(
      "samples: 100\nblock: {width_m: 0.6, height_m: 1.8}\nfriction: {mu: 0.25}\nmodel: " + model + "\neffects: [" +
          effects + "]\nmotions: [{pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}]\n",
      "some.yaml", study::registries());
}

std::string problem_of(const std::string& effects) {
  return error_text(Exit::usage, [&] { study_with(effects); });
}

TEST(Catalogue, HasAFileForEachNameOfTheReport) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "src/effects"))
    if (entry.path().extension() == ".cpp" && entry.path().stem() != "effects") {
      ++files;
      EXPECT_TRUE(effects::find(entry.path().stem())) << "the file's name is the effect's: " << entry.path();
    }
  EXPECT_EQ(files, 17u);
  EXPECT_EQ(names_and_keys.size(), 17u);
  for (const auto& effect : effects::all()) {
    if (is_toy(effect)) continue;
    std::vector<std::string> keys;
    for (const auto& parameter : effect.parameters) keys.push_back(parameter.name);
    ASSERT_TRUE(names_and_keys.count(effect.name)) << effect.name;
    EXPECT_EQ(keys, names_and_keys.at(effect.name));
  }
}

TEST(Catalogue, DeclarationsAreComplete) {
  for (const auto& effect : effects::all()) {
    for (const auto& text : {effect.summary, effect.law, effect.source, effect.suspect})
      EXPECT_NE(text, "") << effect.name;
    bool vanishes = effect.name == "slack_tether" || effect.name == "wall_impact";
    for (const auto& p : effect.parameters) {
      const std::string text = effect.name + "." + p.name;
      EXPECT_NE(p.summary, "") << text;
      const std::string suffix = p.unit == "1"     ? ""
                                 : p.unit == "m/s" ? "_mps"
                                 : p.unit == "1/s" ? "_per_s"
                                 : p.unit == "Hz"  ? "_hz"
                                                   : "_" + p.unit;
      EXPECT_THAT(p.name, testing::EndsWith(suffix)) << text;
      EXPECT_LE(p.lower, p.low) << text;
      EXPECT_LT(p.low, p.high) << text;
      EXPECT_LE(p.high, p.upper) << text;
      if (p.neutral) vanishes = true;
      EXPECT_TRUE(!p.fallback || (*p.fallback >= p.lower && *p.fallback <= p.upper)) << text;
    }
    EXPECT_TRUE(vanishes) << effect.name;
  }
}

// Each, with the example of its page, in a study: its columns, its law in the results, and samples that come out sound.
TEST(Catalogue, EveryEffectWorksInAStudyAsItsPageSays) {
  for (const auto& effect : effects::all()) {
    const auto json = study::effect_json(effect);
    const std::string example = json["example"];
    EXPECT_THAT(study::effect_page(effect), HasSubstr(example));
    EXPECT_THAT(study::effects_list(), HasSubstr(effect.name));
    if (effect.name == "vertical_shaking") continue;  // wants a record with a vertical channel
    const study::Study s = study_with(example);
    EXPECT_EQ(study::parse_stored(expanded(s), ".").model.effects.size(), 1u);
    const study::Realiser realise(s, load_motions(s));
    for (const auto& p : effect.parameters) {
      const auto& columns = realise.draw_columns();
      const auto& column = columns[column_index(columns, "effects_" + effect.name + "_" + p.name)];
      EXPECT_EQ(column.unit, p.unit);
      EXPECT_THAT(column.description, HasSubstr(p.summary));
    }
    EXPECT_EQ(study::effects_json(s)[0]["law"], effect.law);
    const auto sample = realise(0);
    const Outcome outcome = respond(sample.specimen, sample.shaking).outcome;
    EXPECT_TRUE(outcome == Outcome::moved || outcome == Outcome::at_rest || outcome == Outcome::overturned)
        << effect.name << " " << name(outcome);
  }
}

// The toy is declared in toy_effect.cpp and nowhere else.
TEST(Catalogue, AnEighteenthEffectShowsUpEverywhere) {
  ASSERT_EQ(effects::all().size(), 18u);
  EXPECT_THAT(study::effects_list(), HasSubstr("A slippery patch on the floor"));
  EXPECT_THAT(study::effect_page(*effects::find("spilt_oil")), HasSubstr("mu (1 - d exp(-(u/l)^2))"));
  EXPECT_THAT(problem_of("{name: spilt_oil}"), HasSubstr("effects[0].drop is missing"));
  EXPECT_THAT(problem_of("{name: spilt_oil, drop: 1.5}"), HasSubstr("between 0 and 1"));
  EXPECT_THAT(problem_of("{name: spilt_oil, drop: 0.5, reach_m: 0}"), HasSubstr("above 0"));
  EXPECT_THAT(problem_of("{name: spilt_oil, drop: 0.5, reach: 0.1}"), HasSubstr("reach_m"));
  EXPECT_THAT(problem_of("{name: spilled_oil, drop: 0.5}"), HasSubstr("did you mean spilt_oil?"));

  const study::Study s = study_with("{name: spilt_oil, drop: {uniform: [0.2, 0.8]}}");
  const study::Realiser realise(s, load_motions(s));
  const std::size_t column = column_index(realise.draw_columns(), "effects_spilt_oil_drop");
  EXPECT_NE(realise(0).draws[column], realise(1).draws[column]);
  EXPECT_EQ(study::effects_json(s)[0]["parameters"][0]["value"], "{uniform: [0.2, 0.8]}");
}

// Sliding from 0 to U under a steady push a: v^2/2 = int (a - mu (1 - d exp(-(u/l)^2)) g) du
//   = (a - mu g) U + mu g d l sqrt(pi)/2 erf(U/l).
TEST(Catalogue, AnEighteenthEffectActsAsItsLawSays) {
  const double mu = 0.3, d = 0.6, l = 0.08, a = 4;
  const FloorMotion push = rectangular_pulse(-a, 0.5);
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(mu, {effect("spilt_oil", {d, l})}), {&push});
    const auto& p = r.points.at(400);
    const double work = (a - mu * g) * p.slip_m + mu * g * d * l * std::sqrt(pi) / 2 * std::erf(p.slip_m / l);
    EXPECT_NEAR(0.5 * p.slip_velocity_mps * p.slip_velocity_mps, work, 1e-10) << solver.name;
  }
}

TEST(Catalogue, EffectsThatExcludeEachOtherAreRefused) {
  EXPECT_THAT(problem_of("{name: wall_impact, gap_m: 0.1}, {name: flexible_legs, frequency_hz: 4}"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(error_text(Exit::usage, [] { study_with("{name: offset_mass, eccentricity: 0.1}", "slide"); }),
              HasSubstr("does not go with model slide"));
}

}  // namespace
}  // namespace freestand::test
