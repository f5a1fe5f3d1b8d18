// Sign and clock of a slip channel, found without a model, and what examine() says of them.
#include "measurement/laboratory/timing.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "base/random.hpp"
#include "measurement/examined.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/laboratory/units.hpp"

namespace freestand::measurement::timing_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using test::examined;
using test::sliding_cabinet;

void mirror(Test& test) {
  for (double& s : test.slip_m) s = -s;
}

void delay(Test& test, int steps) {
  const std::vector<double> before = test.slip_m;
  const int n = static_cast<int>(before.size());
  for (int i = 0; i < n; ++i)
    test.slip_m[static_cast<std::size_t>(i)] = before[static_cast<std::size_t>(std::clamp(i - steps, 0, n - 1))];
}

TEST(Timing, OfAChannelInOrder) {
  const Dataset data = test::made_dataset(sliding_cabinet(0.2));
  const Bench bench(data, 0);
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const Timing t = slip_timing(bench, i, 30);
    EXPECT_TRUE(t.judged()) << i;
    EXPECT_FALSE(t.wrong()) << i << " late " << t.late_steps << " gain " << t.gain;
  }
  EXPECT_THAT(examined(data).findings, IsEmpty());
}

TEST(Timing, FindsMirrorAndDelayWhateverTheFriction) {
  for (const double mu : {0.1, 0.25}) {
    Dataset data = test::made_dataset(sliding_cabinet(mu));
    mirror(data.tests[0]);
    delay(data.tests[1], 11);
    delay(data.tests[2], -12);
    const Bench bench(data, 0);
    EXPECT_TRUE(slip_timing(bench, 0, 30).mirrored && slip_timing(bench, 0, 30).wrong());
    EXPECT_NEAR(slip_timing(bench, 1, 30).late_steps, 11, 1);
    EXPECT_NEAR(slip_timing(bench, 2, 30).late_steps, -12, 1);
    for (const std::size_t i : {1U, 2U})
      EXPECT_TRUE(slip_timing(bench, i, 30).wrong()) << "mu " << mu << " gain " << slip_timing(bench, i, 30).gain;
  }
}

TEST(Quality, NamesTheTestThatIsWrong) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  mirror(data.tests[3]);
  const Quality q = examined(data);
  EXPECT_THAT(q.findings, Contains(HasSubstr("slip of test t4 looks mirrored")));
  EXPECT_TRUE(q.spoilt());
  EXPECT_FALSE(q.mirrored_slip);
}

// What is held out is told of, and decides nothing.
TEST(Quality, ATestThatIsHeldOutSpoilsNoVerdict) {
  const Dataset good = test::made_dataset(sliding_cabinet(0.2));
  ASSERT_EQ(good.tests[4].role, Role::holdout);
  const auto said = [&](auto change, const char* what) {
    Dataset data = good;
    change(data.tests[4]);
    const Quality q = examined(data);
    EXPECT_FALSE(q.spoilt()) << what;
    EXPECT_THAT(q.findings,
                Contains(testing::AllOf(HasSubstr(what), HasSubstr("t5 is held out, which decides nothing"))));
    data = good;
    change(data.tests[3]);
    EXPECT_TRUE(examined(data).spoilt()) << what;
    EXPECT_THAT(examined(data).findings, Not(Contains(HasSubstr("held out")))) << what;
  };
  said([](measurement::Test& t) { mirror(t); }, "looks mirrored");
  said([](measurement::Test& t) { delay(t, 12); }, "late against the floor's channel");
  const auto times = [](auto& samples, double factor) {
    for (double& s : samples) s *= factor;
  };
  said([&](measurement::Test& t) { times(t.slip_m, 1000); }, "is slip_m in metres?");
  said([&](measurement::Test& t) { times(t.motion.horizontal_mps2, 100), index_runs(t.motion); },
       "is floor_acceleration_mps2 in m/s2?");
  said(
      [](measurement::Test& t) {
        for (double& s : t.slip_m) s += 0.05;
      },
      "does not start at zero");
}

TEST(Quality, SaysOnceWhatIsWrongWithAll) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  for (auto& t : data.tests) delay(t, 12);
  const Quality q = examined(data);
  EXPECT_NEAR(q.late_s, 0.06, 0.005);
  ASSERT_EQ(q.findings.size(), 1U);
  EXPECT_THAT(q.findings[0], HasSubstr("late against the floor's channel"));
}

// Too little for a verdict from the slips alone, but the same way in every test.
TEST(Quality, TellsOfALittleDelayThatAllHave) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  for (auto& t : data.tests) delay(t, 2);
  EXPECT_THAT(examined(data).findings,
              Contains(testing::ContainsRegex("in [34] of [34] tests whose slips tell, friction is steadiest if the "
                                              "response is stamped 0.01[0-9]* s late against the floor's channel")));
}

// A friction that falls with the speed is steadiest some milliseconds late, in all tests: no clock is told off by less than it is known to.
TEST(Quality, FrictionThatFollowsTheSpeedIsNoDelay) {
  constexpr double dt_s = 0.001;
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  data.sampling_dt_s = dt_s;
  data.tests.clear();
  for (const auto& [peak_mps2, period_s] :
       {std::pair(6.0, 0.5), std::pair(4.0, 0.8), std::pair(8.0, 0.35), std::pair(5.0, 1.1)})
    data.tests.push_back(test::made_test("t", test::cabinet("rate_weakening", {0.35, 0.1}),
                                         test::swings(peak_mps2, period_s, dt_s), data.tests.size(), dt_s));
  EXPECT_THAT(examined(data).findings, Not(Contains(HasSubstr("friction is steadiest"))));
  data.tolerance.clock_s = 1e-3;
  EXPECT_THAT(examined(data).findings, Contains(HasSubstr("friction is steadiest")));
}

// Responses exchanged between two tests, and the floor of one written over that of another.
TEST(Quality, ExchangedResponsesAndCopiedFloors) {
  const Dataset sound = test::made_dataset(sliding_cabinet(0.2));
  EXPECT_THAT(examined(sound).findings, Not(Contains(HasSubstr("exchanged"))));
  Dataset exchanged = sound;
  std::swap(exchanged.tests[0].slip_m, exchanged.tests[2].slip_m);
  std::swap(exchanged.tests[0].rotation_rad, exchanged.tests[2].rotation_rad);
  const Quality found = examined(exchanged);
  EXPECT_THAT(found.findings, Contains(HasSubstr("the slip of test t1 fits the floor of t3 better than its own")));
  EXPECT_THAT(found.findings, Contains(HasSubstr("the slip of test t3 fits the floor of t1 better than its own")));
  EXPECT_EQ(found.doubtful, 2U);
  Dataset copied = sound;
  copied.tests[1].motion = copied.tests[3].motion;
  copied.noise.floor_acceleration_mps2 = 0.01;
  EXPECT_THAT(doubts(Bench(copied, 0)).sentences,
              Contains(HasSubstr("the floor of t2, t4 is one and the same, sample by sample")));
  EXPECT_THAT(doubts(Bench(sound, 0)).sentences, Not(Contains(HasSubstr("one and the same"))));
}

// All of them: no clock, sign or file is at fault.
TEST(Quality, AllTestsInAnotherUnit) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2), 0.1);
  for (measurement::Test& t : data.tests)
    for (double& s : t.slip_m) s *= 0.1;
  data.noise.slip_m *= 0.1;
  const Quality found = examined(data);
  EXPECT_THAT(found.findings, Contains(HasSubstr("goes with the floor if it is 10")));
  EXPECT_THAT(found.findings, Not(Contains(testing::ContainsRegex("clock|sign|exchanged"))));
}

// Blocks that were pushed, on a floor that stands: its channel holds noise alone, and any factor that makes nothing of the slip suits it.
TEST(Quality, AFloorThatStandsTellsOfNoUnit) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Dataset data = test::made_dataset(sliding_cabinet(0.2));
    data.noise.floor_acceleration_mps2 = 0.03;
    for (std::size_t i = 0; i < data.tests.size(); ++i) {
      Specimen pushed = sliding_cabinet(0.2);
      pushed.start.slip_velocity_mps = 0.6 + 0.3 * static_cast<double>(i);
      std::vector<double> still(801);
      for (std::size_t k = 0; k < still.size(); ++k) still[k] = 0.03 * random::standard_normal(1000 + seed, k, i);
      data.tests[i] = test::made_test(data.tests[i].id, pushed, piecewise_linear("still", 0.005, std::move(still), {}),
                                      90 + 7 * seed + i);
      data.tests[i].start = pushed.start;
    }
    const Bench bench(data, 0);
    for (std::size_t i = 0; i < bench.size(); ++i) EXPECT_FALSE(slip_scale(bench, i).is_a_unit()) << seed << " " << i;
  }
}

// Contents that move pull with the slip's own acceleration, other ones in each test: 0.41, 0.58, 0.65, 0.79 and 0.83 times a slip went better with
// the floor than what was measured, and the first was taken for inches read as centimetres. A test in inches stands among others that are right.
TEST(Quality, WhatDiffersInEachTestIsNoUnit) {
  Dataset sound = test::made_dataset(sliding_cabinet(0.2), 0.1);
  sound.noise.slip_m *= 0.1;
  const auto told = [&](const std::vector<double>& factors) {
    Dataset data = sound;
    for (std::size_t i = 0; i < factors.size(); ++i)
      for (double& s : data.tests[i].slip_m) s /= factors[i];
    const std::vector<std::string> findings = examined(data).findings;
    return std::any_of(findings.begin(), findings.end(), [](const std::string& f) {
      return f.find("goes with the floor if it is") != std::string::npos;
    });
  };
  EXPECT_FALSE(told({1.6, 1.7, 1.9, 2.54, 1.35}));
  EXPECT_TRUE(told({1, 1, 1, 2.54, 1}));
  EXPECT_TRUE(told({2.54, 2.54, 2.54, 2.54, 2.54}));
}

// Slips 2.54 times the model's were taken for inches read as centimetres, where a little less friction makes them as well.
TEST(Quality, AFrictionOfItsOwnIsNoUnit) {
  const auto made = [](double friction) {
    return test::made_dataset(sliding_cabinet(0.35), 1, {1, friction, 1, 1, 1});
  };
  const ModelFit fit{.model = test::free_friction(), .x = {0.35}};
  const auto times_the_model = [&](const Dataset& data) {
    const Values given = predict(fit.model, data.tests[1], fit.x).slip_m, &seen = data.tests[1].slip_m;
    return std::inner_product(seen.begin(), seen.end(), given.begin(), 0.0) /
           std::inner_product(given.begin(), given.end(), given.begin(), 0.0);
  };
  double less = 0.5, more = 1;
  while (more - less > 1e-6) {
    const double middle = 0.5 * (less + more);
    (times_the_model(made(middle)) > 2.54 ? less : more) = middle;
  }
  const Dataset slippery = made(less);
  EXPECT_NEAR(times_the_model(slippery), 2.54, 0.02);
  const std::vector<bool> told(slippery.tests.size(), false);
  EXPECT_THAT(other_units(Bench(slippery, 0), fit, told), IsEmpty());
  Dataset inches = made(1);
  for (double& s : inches.tests[1].slip_m) s *= 2.54;
  EXPECT_EQ(other_units(Bench(inches, 0), fit, told).size(), 1U);
}

// One test in centimetres taken for metres, or in tenths: its own, not a friction that differs.
TEST(Quality, ATestInAnotherUnit) {
  for (const double factor : {0.1, 100.0, 0.0254}) {
    Dataset data = test::made_dataset(sliding_cabinet(0.2));
    for (double& s : data.tests[2].slip_m) s *= factor;
    const Quality found = examined(data);
    EXPECT_THAT(found.findings, Contains(testing::ContainsRegex("slip_m of (test )?t3 (is|goes with)"))) << factor;
    EXPECT_GT(found.wrong_numbers, 0U);
    for (const char* id : {"t1", "t2", "t4"}) EXPECT_THAT(found.findings, Not(Contains(HasSubstr(id)))) << factor;
  }
}

// A floor that repeats itself suits the slip as well one period later; and the best of lags that end too early is at their end.
TEST(Timing, KnowsWhereAnotherLagWouldDoAsWell) {
  std::vector<double> a;
  for (int i = 0; i <= 800; ++i) a.push_back(i > 100 && i < 700 ? 4 * std::sin(0.09 * i) : 0);
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  data.tests[0] = test::made_test("t1", sliding_cabinet(0.2), piecewise_linear("hum", 0.005, a, {}), 5);
  delay(data.tests[0], 20);
  delay(data.tests[1], 40);
  const Bench bench(data, 0);
  EXPECT_TRUE(slip_timing(bench, 0, 100, true).wrong());
  EXPECT_FALSE(slip_timing(bench, 0, 100, true).known());
  EXPECT_NEAR(slip_timing(bench, 1, 60, true).late_steps, 40, 1);
  EXPECT_TRUE(slip_timing(bench, 1, 60, true).known());
  EXPECT_FALSE(slip_timing(bench, 1, 30, true).known());
}

// Recorders started apart by hand.
TEST(Quality, AClockThatIsOffByMoreThanASwing) {
  for (const int late : {-60, 60, 110}) {
    Dataset data = test::made_dataset(sliding_cabinet(0.2));
    measurement::Test& test = data.tests[1];
    for (auto* samples : {&test.slip_m, &test.rotation_rad}) {
      const std::vector<double> before = *samples;
      const auto n = static_cast<int>(before.size());
      for (int i = 0; i < n; ++i)
        (*samples)[static_cast<std::size_t>(i)] = before[static_cast<std::size_t>(std::clamp(i - late, 0, n - 1))];
    }
    const std::string begins = "the slip of test t2 is stamped ";
    double told_s = 0;
    for (const std::string& said : examined(data).findings)
      if (said.starts_with(begins))
        told_s = std::stod(said.substr(begins.size())) * (said.find("late") != std::string::npos ? 1 : -1);
    EXPECT_NEAR(told_s, 0.005 * late, 0.01);
  }
}

}  // namespace
}  // namespace freestand::measurement::timing_test
