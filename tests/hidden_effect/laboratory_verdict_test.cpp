// No effect is named for a fault of the laboratory: made sets with one fault each, and a small catalogue that holds what
// the fault looks like.
#include <gtest/gtest.h>

#include <algorithm>
#include <freestand/error.hpp>

#include "base/jobs.hpp"
#include "effects/effects.hpp"
#include "hidden_effect/make_set.hpp"
#include "measurement/fit/own_numbers.hpp"
#include "measurement/fit/posterior.hpp"
#include "measurement/verdict/candidates.hpp"
#include "measurement/verdict/chance.hpp"
#include "measurement/verdict/diagnose.hpp"
#include "measurement/verdict/law_search.hpp"
#include "study/law_forms.hpp"
#include "study/read_measurements.hpp"
#include "support/free_friction.hpp"
#include "support/repeats.hpp"
#include "support/scratch.hpp"

namespace freestand::test {
namespace {

using measurement::Diagnosis;
using measurement::Verdict;

// The set as its files tell it.
measurement::Dataset read_back(const MadeSet& set) {
  const Scratch scratch("laboratory");
  write_set(set, scratch.folder());
  return study::read_measurements(scratch / "dataset.yaml");
}

// changed: what befalls the set after it was measured.
using Changed = void (*)(MadeSet&);

Diagnosis diagnosed(const SetRequest& request, const std::vector<const char*>& names, Changed changed = nullptr) {
  MadeSet set = make_set(request);
  if (changed) changed(set);
  const measurement::Dataset data = read_back(set);
  measurement::Bench bench(data, 16);
  bench.estimate_sensors();
  std::vector<const dynamics::Effect*> catalogue;
  for (const char* name : names) catalogue.push_back(effects::find(name));
  return measurement::diagnose(bench, free_friction(), catalogue, {}, run_here);
}

SetRequest request(std::vector<std::string> effects, const char* fault, int tests = 5, std::uint64_t seed = 3,
                   double duration_s = 5) {
  SetRequest r{std::move(effects), seed, tests, duration_s};
  r.fault = fault;
  return r;
}

class LaboratoryVerdict : public testing::TestWithParam<const char*> {};

TEST_P(LaboratoryVerdict, NamesNoEffectWhereNothingIsHidden) {
  const Diagnosis d = diagnosed(request({}, GetParam()), {"static_friction", "rate_weakening"});
  EXPECT_TRUE(d.effects.empty()) << testing::PrintToString(d.sentences);
  EXPECT_TRUE(d.verdict == Verdict::none || d.verdict == Verdict::bad_data) << name(d.verdict);
}

INSTANTIATE_TEST_SUITE_P(Faults, LaboratoryVerdict,
                         testing::Values("drift", "gain", "friction_scatter", "understated_noise", "coloured_noise"),
                         [](const auto& info) { return std::string(info.param); });

// Under friction that differs from test to test an effect is found, though with one friction for all another one may come closer to the tests:
// seed 12005, whose friction scatters by 7 %, was answered `unknown`, wear and weakening before static friction.
TEST(LaboratoryVerdict, AnEffectIsFoundThoughFrictionScatters) {
  for (const std::uint64_t seed : {901, 12005}) {
    const Diagnosis d = diagnosed(request({"static_friction"}, "friction_scatter", seed == 901 ? 7 : 6, seed, 8),
                                  {"static_friction", "viscous_drag", "rate_weakening"});
    EXPECT_EQ(d.verdict, Verdict::missing) << seed << testing::PrintToString(d.sentences);
    EXPECT_EQ(d.effects, std::vector<std::string>{"static_friction"}) << seed;
    EXPECT_GT(d.friction_scatter, 0.01) << seed;
  }
}

// All numbers together, from a fit of one friction to all tests, which is far from the truth: each test's friction and the law's numbers come out.
TEST(LaboratoryVerdict, TheFrictionOfEachTestIsFittedBesideALaw) {
  const MadeSet set = make_set(request({"static_friction"}, "friction_scatter", 6, 12005, 8));
  const measurement::Dataset data = read_back(set);
  const measurement::Bench bench(data, 16);
  const auto model = measurement::with_effect(free_friction(), *effects::find("static_friction"), bench.reach());
  const measurement::ModelFit far{.model = model, .x = {0.22, 1.5}};
  const measurement::Judge judge(bench, model, far.x, run_here);
  const auto held = own_friction(bench, judge, far, run_here);
  const auto found = fitted_with_own_friction(bench, judge, far, held, run_here);
  const double samples = measurement::total(judge.samples());
  EXPECT_GT(held.misfit, 1.5 * samples);
  EXPECT_NEAR(found.of_tests.misfit / samples, 1, 0.1);
  double of_all = 0;
  for (const double factor : found.of_tests.of_tests) of_all += std::log(factor);
  EXPECT_NEAR(of_all, 0, 1e-9);
  const double ratio = set.drawn.truth.effects[0].parameters.at("ratio");
  EXPECT_NEAR(found.fit.x[1], ratio, 0.01 * ratio);

  // From numbers that `add` once ended at, with 52 noise units on tests held out: what the tests leave open holds the truth.
  measurement::ModelFit fit{.model = model, .x = {0.284, 1.607}, .evaluations = 1};
  const measurement::Posterior open = open_numbers(bench, fit, run_here);
  EXPECT_NEAR(fit.x[1], ratio, 0.01 * ratio);
  EXPECT_NEAR(open.friction_scatter, 0.07, 0.03);
  for (const auto& [number, truth] : {std::pair(std::size_t{0}, set.drawn.truth.mu_k), {std::size_t{1}, ratio}}) {
    const auto [lower, upper] = open.interval(number, 0.95);
    EXPECT_LT(lower, truth) << number;
    EXPECT_GT(upper, truth) << number;
    EXPECT_LT(upper - lower, 0.3 * truth) << number;
  }
}

// A drag that grows with the square of the speed, beside friction that scatters by 6 %: one in proportion to the speed is near enough with such
// frictions, and was named, with another effect.
TEST(LaboratoryVerdict, ALawOfNoCatalogueIsFoundThoughFrictionScatters) {
  const measurement::Dataset data = read_back(make_set(request({"quadratic_drag"}, "friction_scatter", 7, 13201, 8)));
  measurement::Bench bench(data, 16);
  bench.estimate_sensors();
  Diagnosis d = measurement::diagnose(bench, free_friction(), {effects::find("viscous_drag")}, {}, run_here);
  EXPECT_TRUE(d.effects.empty()) << testing::PrintToString(d.sentences);
  std::vector<const dynamics::Effect*> forms;
  for (const study::LawForm& form : study::law_forms())
    if (form.effect.name == "quadratic_drag" || form.effect.name == "law_of_path") forms.push_back(&form.effect);
  ASSERT_EQ(forms.size(), 2u);
  propose_law(bench, free_friction(), forms, {}, run_here, d);
  EXPECT_EQ(d.verdict, Verdict::unknown);
  ASSERT_TRUE(d.proposal) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.proposal->effects, std::vector<std::string>{"quadratic_drag"});
  EXPECT_NEAR(d.own_friction->scatter, 0.05, 0.03);
}

// One clock that is off beside a law: the law alone misses that test, and is named with the clock.
TEST(LaboratoryVerdict, AClockIsToldThoughAnEffectIsHidden) {
  const Diagnosis d =
      diagnosed(request({"viscous_drag"}, "one_late_clock", 6, 2704, 8), {"static_friction", "viscous_drag"});
  EXPECT_EQ(d.verdict, Verdict::bad_data) << testing::PrintToString(d.sentences);
  EXPECT_TRUE(std::ranges::any_of(d.quality.findings, [](const std::string& s) {
    return s.find(
               "the response of test t01 is stamped 0.015 s late against the floor's channel: with that viscous_drag "
               "leaves") == 0;
  })) << testing::PrintToString(d.quality.findings);
}

// A floor that was read at 50 Hz: what it did between its readings changes a history by ten times the noise, and is no law.
TEST(LaboratoryVerdict, AFloorThatIsReadSeldomIsNoEffect) {
  SetRequest seldom = request({}, "", 6, 2904, 8);
  seldom.rate_hz = 50;
  const Diagnosis d = diagnosed(seldom, {"static_friction", "directional_friction"});
  EXPECT_EQ(d.verdict, Verdict::none) << testing::PrintToString(d.sentences);
  EXPECT_TRUE(std::ranges::any_of(d.quality.findings, [](const std::string& s) {
    return s.find("the floor of test t02 was read every 0.02 s") == 0;
  })) << testing::PrintToString(d.quality.findings);
}

// Contents that swing make friction steadiest at a lag of 0.095 s in one test, and nearly as steady at others.
TEST(LaboratoryVerdict, ContentsThatSwingAreNoClock) {
  const Diagnosis d = diagnosed(request({"moving_contents"}, "coloured_noise", 6, 2701, 8), {"static_friction"});
  EXPECT_EQ(d.verdict, Verdict::unknown) << testing::PrintToString(d.quality.findings);
}

// A gain that is off by more than its tolerance lets it be is no effect, and what comes closest is told.
TEST(LaboratoryVerdict, AGainBeyondItsToleranceIsTold) {
  const Diagnosis d = diagnosed(request({}, ""), {"static_friction"}, [](MadeSet& set) {
    for (MadeTest& test : set.tests)
      for (double& a : test.measured_floor.horizontal_mps2) a *= 1.06;
  });
  EXPECT_EQ(d.verdict, Verdict::unknown);
  EXPECT_TRUE(std::ranges::any_of(d.sentences, [](const std::string& s) {
    return s.find("if the floor's accelerometer reads 3.1 % too much, which is as far as is sought") !=
           std::string::npos;
  })) << testing::PrintToString(d.sentences);
}

// A block that rocks tells its width to a ten thousandth: what one that is a percent off leaves is no second effect, and the first is named.
TEST(LaboratoryVerdict, AnEffectIsFoundThoughTheWidthIsOff) {
  const SetRequest rocking{{"impact_loss"}, 970, 6, 6};
  const Diagnosis d = diagnosed(rocking, {"impact_loss", "offset_mass"}, [](MadeSet& set) { set.stated_width = 1.01; });
  EXPECT_EQ(d.verdict, Verdict::missing) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.effects, std::vector<std::string>{"impact_loss"});
  EXPECT_TRUE(std::ranges::any_of(d.sentences, [](const std::string& s) {
    return s.find("above all as if the width is 1.") != std::string::npos;
  })) << testing::PrintToString(d.sentences);
}

// The same of a width 2 % off: replays of the floor's noise go by what suits the effect, or a reduced base seems to gain beside it.
TEST(LaboratoryVerdict, AWidthThatIsOffIsNoSecondEffect) {
  const Diagnosis d = diagnosed(request({"offset_mass"}, "wrong_width", 6, 8200, 8), {"offset_mass", "reduced_base"});
  EXPECT_EQ(d.effects, std::vector<std::string>{"offset_mass"}) << testing::PrintToString(d.sentences);
}

// Here the reduced base suits the tests better as the width is stated, and only a pair of both explained them.
TEST(LaboratoryVerdict, AWidthThatIsOffHidesNoEffectBehindAPair) {
  if (!long_tests()) GTEST_SKIP() << "half a minute: FREESTAND_LONG_TESTS";
  const Diagnosis d = diagnosed(request({"offset_mass"}, "wrong_width", 6, 8302, 8), {"offset_mass", "reduced_base"});
  EXPECT_EQ(d.effects, std::vector<std::string>{"offset_mass"}) << testing::PrintToString(d.sentences);
}

// As the width is stated another effect suits the tests better than the right one, and no pair explains them.
TEST(LaboratoryVerdict, AWidthThatIsOffHidesNoEffectBehindAnother) {
  const Diagnosis d =
      diagnosed(request({"floor_tilt"}, "wrong_width", 6, 8801, 8), {"rate_strengthening", "floor_tilt"});
  EXPECT_EQ(d.verdict, Verdict::missing) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.effects, std::vector<std::string>{"floor_tilt"});
}

// The right effect does not even lower the error as the width is stated, and is found beside the width.
TEST(LaboratoryVerdict, AWidthThatIsOffHidesNoEffectThatGainsNothing) {
  if (!long_tests()) GTEST_SKIP() << "a minute: FREESTAND_LONG_TESTS";
  const Diagnosis d =
      diagnosed(request({"pressure_friction"}, "wrong_width", 6, 8808, 8), {"reduced_base", "pressure_friction"});
  EXPECT_EQ(d.verdict, Verdict::missing) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.effects, std::vector<std::string>{"pressure_friction"});
  ASSERT_TRUE(d.best.has_value());
  const measurement::Candidate& named = d.candidates[*d.best];
  EXPECT_EQ(named.fit.model.free.back().name, "laboratory.width_as_stated");
  EXPECT_NEAR(named.fit.x.back(), 0.3691 / 0.3765, 0.001);
  EXPECT_LT(named.fit.mean_left_out(), d.base.fit.mean_left_out() - 1);
}

// Test t04 rocks so long that the truth itself misses it by 63 noise units, and friction that is 0.0002 off meets it.
TEST(LaboratoryVerdict, AHistoryThatAHairOfFrictionTurnsNamesNoEffect) {
  if (!long_tests()) GTEST_SKIP() << "half a minute: FREESTAND_LONG_TESTS";
  const Diagnosis d = diagnosed(request({"pressure_friction"}, "", 6, 8100, 8), {"friction_wear"});
  EXPECT_EQ(d.verdict, Verdict::unknown) << testing::PrintToString(d.sentences);
  EXPECT_TRUE(d.effects.empty()) << testing::PrintToString(d.effects);
}

// Replays of the floor's noise turn this model's rocking elsewhere, one of them as no other. What chance gains on data from it is no more than
// what these miss it by. (It seemed to be twice that, with all effects forty times, and a tilt that took all tests to the noise no better than chance.)
TEST(LaboratoryVerdict, ChanceGainsNoMoreThanItsDataMiss) {
  const measurement::Dataset data = read_back(make_set(request({"floor_tilt"}, "", 6, 8801, 8)));
  measurement::Bench bench(data, 32);
  bench.estimate_sensors();
  const measurement::ModelFit base{.model = free_friction(), .x = {0.504}};
  std::vector<measurement::ModelFit> fits;
  std::vector<const measurement::ModelFit*> tried;
  for (const char* name : {"floor_tilt", "offset_mass", "rate_strengthening", "reduced_base"}) {
    fits.push_back({.model = measurement::with_effect(base.model, *effects::find(name), bench.reach()), .x = base.x});
    for (std::size_t i = 1; i < fits.back().model.free.size(); ++i)
      fits.back().x.push_back(fits.back().model.free[i].low);
  }
  for (const measurement::ModelFit& fit : fits) tried.push_back(&fit);
  const measurement::Judge judge(bench, base.model, base.x, run_here);
  const double gained = measurement::chance_of_gain(bench, judge, base, tried, run_here).usual;
  EXPECT_LT(gained, 1.2 * measurement::chance_of_misfit(bench, judge, base, 0).usual);
}

// Two dimensions that are off within their tolerances, and nothing hidden: neither alone explains it, and no effect is named for both.
TEST(LaboratoryVerdict, NoEffectIsNamedForTwoDimensions) {
  SetRequest rocking{{}, 970, 1, 1};  // what the block is goes by the seed alone
  while (make_set(rocking).drawn.habit != Habit::rocks) ++rocking.seed;
  rocking.tests = rocking.duration_s = 6;
  const Diagnosis d = diagnosed(rocking, {"impact_loss", "reduced_base", "offset_mass"}, [](MadeSet& set) {
    set.stated_width = 1.01;
    set.drawn.height_m *= 1.01;
  });
  EXPECT_TRUE(d.effects.empty()) << testing::PrintToString(d.effects) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.verdict, Verdict::none) << testing::PrintToString(d.sentences);
  EXPECT_NE(d.enough_if.find("smaller than stated"), std::string::npos) << d.enough_if;
}

// mu_k 0.237, mu_s/mu_k 1.51, slips that are read to 0.23 mm and floors to 0.009 m/s2, tests of 12 to 30 s that peak at 1.2 to 3 mu g: a friction
// that falls with speed comes close, and is not named.
void read_well(MadeSet& set) {
  DrawnTruth& drawn = set.drawn;
  const double friction = 0.237 / drawn.truth.mu_k;
  drawn.truth.mu_k = drawn.truth.mu_s = 0.237;
  drawn.truth.effects[0].parameters["ratio"] = 1.51;
  set.slip_noise_m = 0.00023;
  set.floor_noise_mps2 = 0.009;
  for (std::size_t i = 0; i < set.tests.size(); ++i) {
    MadeTest& test = set.tests[i];
    KeyedRandom random(237, i);
    for (double& a : test.floor.horizontal_mps2) a *= friction;
    test.measured_floor.horizontal_mps2 = test.floor.horizontal_mps2;
    for (double& a : test.measured_floor.horizontal_mps2) a += set.floor_noise_mps2 * random.normal();
    test.truth = simulate(drawn.truth, test.floor, 2.5e-5);
    test.slip_m = test.truth.slip_m;
    for (double& slip : test.slip_m) slip += set.slip_noise_m * random.normal();
  }
}

TEST(LaboratoryVerdict, NamesNoFrictionThatFallsWithSpeedForOneThatHolds) {
  SetRequest r = request({"static_friction"}, "", 8, 237, 20);
  r.unpicked = true;
  const Diagnosis d = diagnosed(r, {"static_friction", "rate_weakening"}, read_well);
  EXPECT_EQ(d.verdict, Verdict::missing) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.effects, std::vector<std::string>{"static_friction"});
}

// What the block did comes a third of a second before its floor: said at once, without a search.
TEST(LaboratoryVerdict, AResponseThatBeginsBeforeItsFloorIsBadData) {
  const Diagnosis d = diagnosed(request({"static_friction"}, ""), {"static_friction"}, [](MadeSet& set) {
    for (MadeTest& test : set.tests) {
      const auto early = static_cast<std::ptrdiff_t>(0.3 / test.floor.dt_s);
      test.slip_m.erase(test.slip_m.begin(), test.slip_m.begin() + early);
      test.slip_m.insert(test.slip_m.end(), static_cast<std::size_t>(early), test.slip_m.back());
    }
  });
  EXPECT_EQ(d.verdict, Verdict::bad_data);
  EXPECT_TRUE(d.candidates.empty());
}

TEST(LaboratoryVerdict, TwoTestsAreTooFew) {
  EXPECT_THROW(diagnosed(request({"static_friction"}, "", 3), {"static_friction"}), Error);  // one of three is held out
}

}  // namespace
}  // namespace freestand::test
