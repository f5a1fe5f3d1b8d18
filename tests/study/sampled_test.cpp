// The classes of sampled parameters are those of the draws, and a parameter that is drawn again changes nothing else.
#include "study/sampled.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "study/realise.hpp"
#include "study_text.hpp"

namespace freestand::study::sampled_test {
namespace {

using namespace test;

const char* const text = R"(
seed: 3
samples: 4096
block: {width_m: {choice: [0.9, 0.6]}, height_m: 2, mass_kg: {normal: {mean: 300, standard_deviation: 30, min: 100}}}
friction: {mu_k: {lognormal: {median: 0.25, dispersion: 0.4}}}
motions:
  - {pulse: [A, B], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {uniform: [0.1, 2]}, weight: 3}
  - {pulse: C1, period_s: 0.8, peak_velocity_mps: {uniform: [0.1, 1]}}
fragility: {edp: [overturned]}
)";

std::vector<std::string> names(const std::vector<Sampled>& all) {
  std::vector<std::string> found;
  for (const Sampled& one : all) found.push_back(one.parameter.name);
  return found;
}

double draw(const Realiser& realise, std::uint64_t sample, const std::string& column) {
  return realise(sample).draws.at(column_index(realise.draw_columns(), column));
}

TEST(Sampled, IsEveryNumberThatIsNoFixedOne) {
  const Study study = parse(text);
  const std::vector<Sampled> all = sampled(study, 3);
  EXPECT_THAT(names(all), testing::ElementsAre("block.width_m", "block.mass_kg", "friction.mu_k", "motion.amplitude",
                                               "motion.period_s", "motion"));
  EXPECT_EQ(all[0].parameter.classes, 2);
  EXPECT_FALSE(all[0].parameter.ordered);
  EXPECT_EQ(all[2].parameter.classes, 64);
  EXPECT_EQ(all[1].parameter.unit, "kg");
  EXPECT_THAT(all[3].streams, testing::ElementsAre("motion.peak_acceleration_g", "motion.peak_velocity_mps"));
  EXPECT_THAT(names(sampled(study, 1)), testing::Not(testing::Contains("motion")));
}

// Classes follow the values that the sweep draws: equal shares of them, in their order; a choice by its values.
TEST(Sampled, ClassesAreThoseOfTheDraws) {
  const Study study = parse(text);
  const Realiser realise(study, load_motions(study));
  const std::vector<Sampled> all = sampled(study, 3);
  std::vector<double> lowest(64, 1e9), highest(64, 0);
  std::vector<int> count(64, 0);
  for (std::uint64_t i = 0; i < 4096; ++i) {
    const Realisation sample = realise(i);
    EXPECT_EQ(all[0].class_of(i, sample.motion), draw(realise, i, "block_width_m") == 0.9 ? 0 : 1);
    const auto of = static_cast<std::size_t>(all[2].class_of(i, sample.motion));
    const double mu = draw(realise, i, "friction_mu_k");
    lowest[of] = std::min(lowest[of], mu);
    highest[of] = std::max(highest[of], mu);
    ++count[of];
    EXPECT_EQ(all[4].class_of(i, sample.motion) == 64, sample.motion == 2) << "only the first entry draws a period";
    EXPECT_EQ(all[5].class_of(i, sample.motion), static_cast<int>(sample.motion));
  }
  EXPECT_THAT(count, testing::Each(64));
  for (std::size_t c = 0; c + 1 < 64; ++c) EXPECT_LT(highest[c], lowest[c + 1]);
}

// Motions that are scaled to an intensity draw it as any amplitude is drawn, whatever it is called.
TEST(Sampled, ClassesOfAnIntensityThatMotionsAreScaledTo) {
  for (const std::string im : {"pta_g", "pga_g", "pgv_mps"}) {
    std::string scaled = text;
    scaled.replace(scaled.find("  - {pulse: [A, B]"), std::string::npos,
                   "  - {pulse: [A, B], period_s: {uniform: [0.3, 1.5]}, scale_to: {" + im +
                       ": {log_uniform: [0.1, 2]}}}\nfragility: {edp: [overturned]}\n");
    const Study study = parse(scaled);
    Study changed = study;
    const std::vector<Sampled> all = sampled(study, 2);
    ASSERT_EQ(all[3].parameter.name, "motion." + im);
    const Realiser realise(study, load_motions(study));
    changed.redrawn = all[3].streams;
    const Realiser again(changed, realise.motions());
    std::vector<std::vector<double>> scale_of_class(64);
    int kept = 0;
    for (std::uint64_t i = 0; i < 1024; ++i) {
      const Realisation sample = realise(i);
      // Of one pulse type the factor is the intensity over a function of the period: PTA and PGA leave it out.
      if (im != "pgv_mps")
        scale_of_class[static_cast<std::size_t>(all[3].class_of(i, sample.motion))].push_back(sample.pta_g);
      kept += again(i).pta_g == sample.pta_g;
    }
    EXPECT_LT(kept, 5) << im;
    for (std::size_t c = 0; im != "pgv_mps" && c + 1 < 64; ++c)
      EXPECT_LT(*std::max_element(scale_of_class[c].begin(), scale_of_class[c].end()),
                *std::min_element(scale_of_class[c + 1].begin(), scale_of_class[c + 1].end()))
          << im;
  }
}

TEST(Sampled, OneThatIsDrawnAgainIsAnotherAndAllElseTheSame) {
  const Study study = parse(text);
  const Realiser before(study, load_motions(study));
  Study changed = study;
  changed.redrawn = {"friction.mu_k"};
  const Realiser after(changed, before.motions());
  double covariance = 0, first = 0, second = 0, n = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const std::vector<double> a = before(i).draws, b = after(i).draws;
    for (std::size_t column = 0; column < a.size(); ++column) {
      const std::string& name = before.draw_columns()[column].name;
      if (name.starts_with("friction_mu") || std::isnan(a[column])) continue;
      EXPECT_EQ(a[column], b[column]) << name;
    }
    const double x = draw(before, i, "friction_mu_k"), y = draw(after, i, "friction_mu_k");
    EXPECT_NE(x, y);
    covariance += x * y;
    first += x;
    second += y;
    n += 1;
  }
  // Independent: a correlation of 2000 pairs scatters by 0.022; the dispersion of 0.4 makes the variance 0.17 of the squared mean.
  EXPECT_NEAR((covariance / n - first / n * second / n) / (first / n * second / n * 0.17), 0, 0.09);
}

}  // namespace
}  // namespace freestand::study::sampled_test
