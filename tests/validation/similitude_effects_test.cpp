// Similitude of the effects: every length, speed and frequency of the catalogue scaled by its unit.
#include <gtest/gtest.h>

#include <vector>

#include "effects/effects.hpp"
#include "formula/formula.hpp"
#include "support/bouc_wen_cases.hpp"
#include "support/keyed_random.hpp"
#include "support/similitude.hpp"

namespace freestand::test {
namespace {

constexpr const char* model_names[] = {"slide", "rock", "slide_rock", "bouc_wen"};

bool excludes(const dynamics::Effect& effect, Model model) {
  return std::find(effect.excludes.begin(), effect.excludes.end(), model_names[static_cast<int>(model)]) !=
         effect.excludes.end();
}

Pair pair_with(const dynamics::Effect& effect, const std::vector<double>& parameters, Model model,
               std::uint64_t number) {
  CaseFamily family;
  family.seed = 75;
  family.alpha_high = 0.8;
  family.mu_high = 0.7;
  family.duration_low_s = 2;
  family.duration_high_s = 4;
  RandomCase c = model == Model::bouc_wen ? random_bouc_wen_case({.seed = 76, .longest_s = 1}, number)
                                          : random_case(family, number);
  c.specimen.model = model;
  c.specimen.effects = {{&effect, parameters}};
  std::string text = effect.name;
  for (const double p : parameters) (text += ' ') += testing::PrintToString(p);
  return pair_of(text + ' ' + c.text(), c.specimen, c.motion, c.shaking, report_scale);
}

std::vector<double> draw(const dynamics::Effect& effect, std::uint64_t number) {
  KeyedRandom random(77, number);
  std::vector<double> parameters;
  for (const auto& p : effect.parameters) parameters.push_back(random.uniform(p.low, p.high));
  return parameters;
}

struct Spread {
  int runs = 0, bits = 0;
  double worst = 0;
};

void compare(const Pair& pair, Spread& spread) {
  const Answers both = solve(respond, pair, report_scale);
  const double off = difference(both.large, both.small, pair.length());
  ++spread.runs;
  spread.bits += same_bits(both);
  spread.worst = std::max(spread.worst, off);
  EXPECT_LT(off, 1e-9) << pair.text << text_of(both);
  EXPECT_EQ(both.large.events, both.small.events) << pair.text << text_of(both);
}

constexpr Model models[] = {Model::slide, Model::rock, Model::slide_rock, Model::bouc_wen};

// Every effect of the catalogue, its parameters scaled by their units.
TEST(SimilitudeOfEffects, ParametersScaleByTheirUnits) {
  for (const auto& effect : effects::all())
    for (const Model model : models) {
      if (excludes(effect, model)) continue;
      Spread spread;
      for (std::uint64_t number = 0; number < static_cast<std::uint64_t>(cases(6)); ++number)
        compare(pair_with(effect, draw(effect, number), model, number), spread);
      std::printf("%-22s %-10s %2d of %2d to the bit, worst %.1e\n", effect.name.c_str(),
                  model_names[static_cast<int>(model)], spread.bits, spread.runs, spread.worst);
    }
}

// A length, speed or frequency that stays what it was gives another answer, in some case at least.
TEST(SimilitudeOfEffects, ParametersLeftUnscaledShow) {
  for (const auto& effect : effects::all())
    for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
      if (factor_of(effect.parameters[i].unit, report_scale) == 1) continue;
      bool shows = false;
      for (std::uint64_t number = 0; number < 20 && !shows; ++number) {
        Pair pair = pair_with(effect, draw(effect, number), Model::slide, number);
        pair.small.effects[0].parameters[i] = pair.large.effects[0].parameters[i];
        const Answers both = solve(respond, pair, report_scale);
        shows = difference(both.large, both.small, pair.length()) > 1e-4;
      }
      EXPECT_TRUE(shows) << effect.name << ' ' << effect.parameters[i].name;
    }
}

TEST(SimilitudeOfEffects, ReferenceToo) {
  for (const auto& effect : effects::all()) {
    const Model model = excludes(effect, Model::slide_rock) ? Model::slide : Model::slide_rock;
    for (std::uint64_t number = 0; number < 2; ++number) {
      const Pair pair = pair_with(effect, draw(effect, number), model, number);
      Answers both = solve(respond_reference, pair, report_scale);
      EXPECT_NEAR(both.large.peak_acceleration_mps2, both.small.peak_acceleration_mps2, 1e-2) << pair.text;
      both.small.peak_acceleration_mps2 = both.large.peak_acceleration_mps2;
      EXPECT_LT(difference(both.large, both.small, pair.length()), 1e-6) << pair.text << text_of(both);
    }
  }
}

TEST(SimilitudeOfEffects, FormulasToo) {
  const auto seam =
      formula::effect("seam", "mu*(1 + a*sin(2*pi*u/l))", "-c*v - (2*pi*f)^2*u", {"a", "l_m", "c", "f_hz"});
  Spread spread;
  for (std::uint64_t number = 0; number < 20; ++number) {
    Pair pair = pair_with(seam, {0.3, 0.05, 0.4, 0.2}, Model::slide_rock, number);
    pair.small.effects[0].parameters = {0.3, 0.05 / 4, 0.4 * 2, 0.2 * 2};
    compare(pair, spread);
  }
  std::printf("%d of %d to the bit, worst %.1e\n", spread.bits, spread.runs, spread.worst);
}

}  // namespace
}  // namespace freestand::test
