// model: bouc_wen in study files: what is read, written out in full, drawn and simulated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "study/known.hpp"
#include "study/realise.hpp"
#include "study/simulate.hpp"
#include "study_text.hpp"
#include "support/data.hpp"

namespace freestand::study::bouc_wen_test {
namespace {

using namespace test;

const std::string contact = "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 20}\n";

TEST(BoucWenStudy, DefaultsAreFilledInAndWrittenOut) {
  const Study study = parse(block + friction + motions + samples + fragility + contact);
  EXPECT_EQ(study.model.model, Model::bouc_wen);
  const std::string text = expanded(study);
  EXPECT_THAT(text,
              testing::HasSubstr(
                  "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 20, gamma: 0.5, beta: 0.5}\n"));
  EXPECT_EQ(expanded(parse(text)), text);
}

// The line of the page of all keys is a comment there, because another model is chosen.
TEST(BoucWenStudy, ThePageOfAllKeysShowsTheDefaults) {
  std::ifstream stream(freestand::test::source_dir() / "configs" / "every_key.yaml");
  std::string line, shown;
  while (std::getline(stream, line))
    if (line.rfind("# bouc_wen: ", 0) == 0) shown = line.substr(2);
  ASSERT_FALSE(shown.empty());
  const std::string sound = block + friction + motions + samples + fragility + "model: bouc_wen\n";
  EXPECT_EQ(expanded(parse(sound + shown + "\n")),
            expanded(parse(sound + "bouc_wen: {yield_displacement_m: 0.00254, exponent: 20}\n")));
}

TEST(BoucWenStudy, SamplesDrawTheContact) {
  const Study study = parse(block + friction + motions + samples + fragility +
                            "model: bouc_wen\nbouc_wen: {yield_displacement_m: {log_uniform: [1e-5, 1e-2]}, exponent: "
                            "{uniform: [2, 20]}, gamma: 0.6, beta: {uniform: [0.2, 0.4]}}\n");
  const Realiser realise(study, load_motions(study));
  std::vector<std::string> names;
  for (const auto& column : realise.draw_columns()) names.push_back(column.name);
  EXPECT_THAT(names, testing::IsSupersetOf(
                         {"bouc_wen_yield_displacement_m", "bouc_wen_exponent", "bouc_wen_gamma", "bouc_wen_beta"}));
  const Realisation one = realise(0), other = realise(1);
  EXPECT_NE(one.specimen.bouc_wen.yield_displacement_m, other.specimen.bouc_wen.yield_displacement_m);
  for (const auto& sample : {one, other}) {
    const BoucWen& law = sample.specimen.bouc_wen;
    EXPECT_TRUE(law.yield_displacement_m >= 1e-5 && law.yield_displacement_m <= 1e-2);
    EXPECT_TRUE(law.exponent >= 2 && law.exponent <= 20);
    EXPECT_EQ(law.gamma, 0.6);
    EXPECT_TRUE(law.beta >= 0.2 && law.beta <= 0.4);
  }
}

TEST(BoucWenStudy, CasesRunOnBothIntegrators) {
  const Case one = parse_case(
      block + friction + contact + "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n", "one.yaml");
  const Simulation fast = simulate(one, false), slow = simulate(one, true);
  EXPECT_EQ(fast.response.outcome, Outcome::moved);
  EXPECT_GT(fast.response.peak_slip_m, 0.02);
  EXPECT_NEAR(fast.response.peak_slip_m, slow.response.peak_slip_m, 1e-9);
  ASSERT_GT(fast.history.points.size(), 100U);
  ASSERT_GE(slow.history.points.size(), 100U);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(fast.history.points[i].slip_m, slow.history.points[i].slip_m, 1e-9) << i;
}

TEST(BoucWenStudy, EffectsThatHaveNothingToActOnAreRefused) {
  for (const std::string effect : {"static_friction, ratio: 1.2", "flexible_legs, frequency_hz: 4",
                                   "wall_impact, gap_m: 0.1", "offset_mass, eccentricity: 0.1"})
    EXPECT_THAT(
        problems(block + friction + motions + samples + fragility + contact + "effects:\n  - {name: " + effect + "}\n"),
        testing::HasSubstr("does not go with model bouc_wen"))
        << effect;
  const Study study = parse(block + friction + motions + samples + fragility + contact +
                            "effects:\n  - {name: rate_weakening, drop: 0.4, speed_mps: 0.1}\n");
  EXPECT_EQ(study.model.effects.size(), 1U);
}

TEST(BoucWenStudy, CasesTakeNoDistributions) {
  EXPECT_THAT(case_problems(block + friction +
                            "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: {uniform: [2, 3]}}\n"
                            "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n"),
              testing::HasSubstr("bouc_wen.exponent is a distribution"));
}

}  // namespace
}  // namespace freestand::study::bouc_wen_test
