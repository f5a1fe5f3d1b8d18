// What a model misses because of the dimensions that it was given, against what it lacks.
#include "measurement/fit/as_stated.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "effects/effects.hpp"
#include "measurement/fit/starts.hpp"
#include "measurement/laboratory/laboratory.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/verdict/candidates.hpp"
#include "measurement/verdict/chance.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

constexpr double width_m = 0.45;

// A block that rocks and never slides, with the impacts of the report, which keep `kept` of the rate.
Specimen rocking(double kept) {
  Specimen specimen = test::cabinet();
  specimen.block = Block::rectangular(width_m, 1.5, 100);
  specimen.friction = {1.5, 1.5};
  specimen.impact.factor = kept;
  return specimen;
}

// Four tests in which it does not fall.
Dataset measured(const Specimen& specimen, std::uint64_t key) {
  Dataset data = test::made_dataset(specimen, 0);
  data.tests.clear();
  for (const auto& [peak_mps2, period_s] :
       {std::pair(4.0, 0.5), std::pair(5.0, 0.4), std::pair(6.0, 0.35), std::pair(3.5, 0.6)})
    data.tests.push_back(test::made_test(fmt::format("t{}", data.tests.size() + 1), specimen,
                                         test::swings(peak_mps2, period_s), 0, data.sampling_dt_s, 0));
  return test::with_noise(data, key);
}

ModelSpec model_of_impacts() {
  ModelSpec model = test::free_friction();
  model.mu_k = {.value = 1.5};
  model.free = {{.name = "impact.factor", .lower = 0.3, .upper = 1, .low = 0.3, .high = 1}};
  model.impact_factor = {.free = 0};
  return model;
}

struct Judged {
  Chance plain, as_it_may_be;
  AsStated stated;
};
Judged judged(Dataset data, double width) {
  for (measurement::Test& t : data.tests) t.specimen.width_m = width_m * width;
  const Bench bench(data, 0);
  const Judge judge(bench);
  const ModelFit fit = test::fitted(bench, model_of_impacts(), {0.8});
  const double misfit = total(judge.misfit_of_fit(fit));
  AsStated stated = as_stated(bench, judge, fit, run_here);
  return {chance_of_misfit(bench, judge, fit, misfit), chance_of_misfit(bench, judge, fit, stated.misfit),
          std::move(stated)};
}

TEST(AsStated, AWidthThatIsHalfAPercentOffIsFound) {
  const Judged found = judged(measured(rocking(0.8), 4), 1.005);
  EXPECT_FALSE(found.plain.chance());
  EXPECT_TRUE(found.as_it_may_be.chance()) << found.as_it_may_be.p;
  ASSERT_THAT(found.stated.names, testing::Contains(width_fault));
  EXPECT_EQ(found.stated.names[0], width_fault);
  EXPECT_NEAR(found.stated.x[0], 0.8, 0.001);
}

// From 1.4 % on this rocking falls out of step, and no way leads downhill to the width; a fit in which it is free does.
TEST(AsStated, AWidthThatIsTwoPercentOffIsFoundFromAFitInWhichItIsFree) {
  Dataset data = measured(rocking(0.8), 4);
  for (measurement::Test& t : data.tests) t.specimen.width_m = width_m * 1.02;
  const Bench bench(data, 0);
  const Judge judge(bench);
  const ModelFit fit = test::fitted(bench, model_of_impacts(), {0.8});
  const auto is_chance = [&](const AsStated& s) { return chance_of_misfit(bench, judge, fit, s.misfit).chance(); };
  EXPECT_FALSE(is_chance(as_stated(bench, judge, fit, run_here)));

  std::vector<FitTask> tasks;
  for (LaboratoryFault& fault : laboratory_faults(bench, fit.model, fit.x)) {
    tasks.push_back({.model = std::move(fault.model), .screened = false});
    tasks.back().starts = starts_from({fit.x}, tasks.back().model, 24);
  }
  const AsStated found = as_stated(bench, judge, fit, run_here, fit_models(bench, tasks, {}, run_here));
  EXPECT_TRUE(is_chance(found)) << found.misfit;
  EXPECT_NEAR(found.x[0], 0.8, 0.001);
  EXPECT_NEAR(found.x[1], 1 / 1.02, 0.001);
  EXPECT_THAT(most_off(found), testing::HasSubstr("% smaller than stated"));
}

// Near where they are stated dimensions refuse a right model no more often than chance does.
TEST(AsStated, HasTheSizeOfChanceWhateverTheDimensionsAre) {
  const int sets = test::dear_repeats(40);
  int rejected = 0, plainly = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    const Judged found = judged(measured(rocking(0.8), key), 1 + 0.006 * random::standard_normal(77, key, 0));
    rejected += !found.as_it_may_be.chance();
    plainly += !found.plain.chance();
  }
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
  EXPECT_GT(plainly, sets / 2);
}

// Nor do they make effects: what chance adds to them gains as rarely as it should.
TEST(AsStated, GainsOfEffectsHaveTheSizeOfChance) {
  const int sets = test::dear_repeats(40);
  int helped = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    Dataset data = measured(rocking(0.8), 100 + key);
    for (measurement::Test& t : data.tests)
      t.specimen.width_m = width_m * (1 + 0.006 * random::standard_normal(78, key, 0));
    const Bench bench(data, 0);
    const Judge judge(bench);
    const ModelFit base = test::fitted(bench, model_of_impacts(), {0.8});
    ModelFit off_centre{.model = with_effect(base.model, *effects::find("offset_mass"), bench.reach()),
                        .x = {base.x[0], 0.01}},
        reduced{.model = with_effect(base.model, *effects::find("reduced_base"), bench.reach()),
                .x = {base.x[0], 0.01}};
    const AsStated stated = as_stated(bench, judge, base, run_here);
    helped += !chance_of_gain(bench, judge, base, {&off_centre, &reduced}, run_here, &stated).chance();
  }
  EXPECT_LE(helped, test::likely_counts(sets, 0.05).most);
}

// A little of an effect that the width imitates is no effect; what no dimension does is one all the same.
TEST(AsStated, NoEffectIsAddedForAWidth) {
  const auto help = [](Dataset data, double width, const char* effect, double number, bool allowed) {
    for (measurement::Test& t : data.tests) t.specimen.width_m = width_m * width;
    const Bench bench(data, 0);
    const Judge judge(bench);
    const ModelFit base = test::fitted(bench, model_of_impacts(), {0.8});
    ModelFit with{.model = with_effect(base.model, *effects::find(effect), bench.reach()), .x = {base.x[0], number}};
    const AsStated stated = as_stated(bench, judge, base, run_here);
    return chance_of_gain(bench, judge, base, {&with}, run_here, allowed ? &stated : nullptr).p;
  };
  const Dataset plain = measured(rocking(0.8), 6);
  EXPECT_LT(help(plain, 1.003, "reduced_base", 0.003, false), 0.001);
  EXPECT_GT(help(plain, 1.003, "reduced_base", 0.003, true), 0.05);
  Specimen off_centre = rocking(0.8);
  off_centre.effects.push_back({effects::find("offset_mass"), {0.02}});
  EXPECT_LT(help(measured(off_centre, 6), 1.003, "offset_mass", 0.02, true), 0.001);
}

}  // namespace
}  // namespace freestand::measurement
