// Channels whose numbers themselves look wrong: units, gains, offsets, dead, clipped and frozen sensors.
#include "measurement/laboratory/plausible.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "base/random.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/examined.hpp"

namespace freestand::measurement::plausible_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using test::examined;
using test::sliding_cabinet;

TEST(Quality, NoSlipRemainsThatWasNotReached) {
  const Dataset data = test::made_dataset(sliding_cabinet(0.2));
  const auto said = [&](double remains) {
    Dataset read = data;
    read.noise.slip_m = 1e-3;
    for (measurement::Test& one : read.tests) one.slip_m.clear(), one.peaks.peak_slip_m = 0.05;
    read.tests[1].peaks.residual_slip_m = remains;
    return doubts(Bench(read, 0));
  };
  EXPECT_THAT(said(0.049).sentences, Not(Contains(HasSubstr("residual_slip_m"))));
  EXPECT_THAT(said(-0.054).sentences,
              Not(Contains(HasSubstr("residual_slip_m"))));  // by four deviations of one reading
  for (const double remains : {0.06, -0.06}) {
    const Doubts found = said(remains);
    EXPECT_THAT(found.sentences,
                Contains("residual_slip_m of t2 is 0.01 m more than peak_slip_m, and no slip remains that was not "
                         "reached: are the two columns the right way round?"));
    EXPECT_EQ(found.spoilt_tests, 0U);  // both may be read by hand
  }
}

// What a channel of one test cannot be, whatever the friction.
TEST(Quality, AChannelOfOneTest) {
  Specimen rocks = sliding_cabinet(0.9);
  rocks.block = Block::rectangular(0.3, 1.2, 100);
  rocks.model = Model::slide_rock;
  Dataset slid = test::made_dataset(sliding_cabinet(0.2));
  const Dataset rocked = test::made_dataset(rocks);
  const auto said = [](Dataset data, auto change, const char* what) {
    EXPECT_THAT(doubts(Bench(data, 0)).sentences, Not(Contains(HasSubstr(what))));
    change(data.tests[1], data.tests[2]);
    const Doubts found = doubts(Bench(data, 0));
    EXPECT_THAT(found.sentences, Contains(HasSubstr(what)));
    EXPECT_GT(found.spoilt_tests, 0U) << what;
  };
  said(
      slid, [](measurement::Test& one, measurement::Test& other) { one.slip_m = other.slip_m; },
      "slip_m of t2, t3 is one and the same, sample by sample: one file was taken for another");
  said(
      slid,
      [](measurement::Test& one, measurement::Test&) { std::fill_n(one.slip_m.begin() + 350, 40, one.slip_m[350]); },
      "slip_m of t2 stays at one value for 0.2 s, where its sensor's noise changes it: did the recording stop?");
  said(
      slid,
      [](measurement::Test& one, measurement::Test&) {
        one.dt_s *= 1000;
        one.motion = piecewise_linear("slow", one.dt_s, motion_samples(one.motion, one.motion.horizontal_mps2), {});
      },
      "t2 is sampled every 5 s: is its time in seconds?");
  said(
      rocked,
      [](measurement::Test& one, measurement::Test&) {
        for (double& theta : one.rotation_rad) theta = -theta;
      },
      "the rotation of t2 looks mirrored: the floor turns the block the wrong way");
  for (measurement::Test& test : slid.tests) {  // what a sensor on the block reads, of 0.05 m/s2
    test.block_acceleration_mps2.assign(test.slip_m.size(), 0);
    test.block_acceleration_mps2 =
        predict(test::free_friction(), test, std::vector<double>{0.2}).block_acceleration_mps2;
    for (std::size_t k = 0; k < test.slip_m.size(); ++k)
      test.block_acceleration_mps2[k] += 0.05 * std::cos(7 * static_cast<double>(k * k));
  }
  for (const double factor : {-1.0, 1 / 9.80665, 9.80665})
    said(
        slid,
        [&](measurement::Test& one, measurement::Test&) {
          for (double& a : one.block_acceleration_mps2) a *= factor;
        },
        "times the floor's before anything moves: check its sign, and that it is in m/s2");
}

// A reading in steps larger than its noise stays at one value of its own accord.
TEST(Quality, ARoundedChannelIsNotFrozen) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  for (measurement::Test& test : data.tests)
    for (double& s : test.slip_m) s = std::round(s / 0.002) * 0.002;
  EXPECT_THAT(doubts(Bench(data, 0)).sentences, Not(Contains(HasSubstr("stays at one value"))));
}

TEST(Quality, ClippedSensorsAndStillTests) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  for (double& s : data.tests[0].slip_m) s = std::clamp(s, -0.01, 0.01);
  data.tests[1] = test::made_test("t2", sliding_cabinet(0.9), test::swings(4, 0.8), 9);
  const Quality q = examined(data);
  EXPECT_THAT(q.findings, Contains(HasSubstr("slip_m of test t1 stays at its extreme value")));
  EXPECT_THAT(q.findings, Contains(HasSubstr("test t2 shows no motion above the noise")));
}

// A test without a channel that others have, or with a dead one, bounds nothing: it may have moved.
TEST(Quality, ChannelsThatLackOrAreDead) {
  Dataset data = test::made_dataset(sliding_cabinet(0.9));
  data.tests[0].rotation_rad.clear();
  data.tests[1].slip_m.assign(data.tests[1].slip_m.size(), 0);
  auto findings = examined(data).findings;
  EXPECT_THAT(findings, Contains("test t1 lacks rotation_rad, which other tests have: errors are of the other channels "
                                 "alone, and whether t1 moved is not known"));
  EXPECT_THAT(findings, Contains(HasSubstr("slip_m of test t2 is one number throughout")));
  EXPECT_THAT(findings, Contains("tests t3, t4, t5 show no motion above the noise: they bound friction and slenderness "
                                 "from below, and say nothing else"));
  for (auto& made : data.tests) made.rotation_rad.clear();
  findings = examined(data).findings;
  EXPECT_THAT(findings, Not(Contains(HasSubstr("lack"))));
  EXPECT_THAT(findings, Contains(HasSubstr("they bound friction from below")));
}

TEST(Quality, UnitsAndDeadChannels) {
  const Dataset good = test::made_dataset(sliding_cabinet(0.2));
  const auto said = [&](auto change) {
    Dataset data = good;
    change(data);
    const Quality q = examined(data);
    EXPECT_TRUE(q.spoilt());
    return q.findings;
  };
  const auto scaled = [](FloorMotion& motion, double factor) {
    for (double& c : motion.horizontal_mps2) c *= factor;
    index_runs(motion);
  };
  EXPECT_THAT(said([&](Dataset& d) { scaled(d.tests[2].motion, 0); }),
              Contains(HasSubstr("t3 moves more than a floor that reaches 0 g can make them")));
  EXPECT_THAT(said([&](Dataset& d) { scaled(d.tests[2].motion, 1 / 9.80665); }),
              Contains(HasSubstr("t3 moves more than a floor")));
  EXPECT_THAT(said([&](Dataset& d) { scaled(d.tests[2].motion, 100); }),
              Contains(HasSubstr("is floor_acceleration_mps2 in m/s2?")));
  EXPECT_THAT(said([&](Dataset& d) {
                for (double& s : d.tests[1].slip_m) s *= 1000;
              }),
              Contains(HasSubstr("is slip_m in metres?")));
}

TEST(Quality, SizesClippedFloorAndStatedNoise) {
  const Dataset good = test::made_dataset(sliding_cabinet(0.2));
  Dataset data = good;
  for (auto& t : data.tests) t.specimen.width_m = 800;
  for (double& c : data.tests[0].motion.horizontal_mps2) c = std::clamp(c, -1.0, 1.0);
  data.noise.slip_m = 1e-5;
  const auto findings = examined(data).findings;
  EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                          [](const auto& f) { return f.find("width_m is 800") != std::string::npos; }),
            1);
  EXPECT_THAT(findings, Contains(HasSubstr("slip_m scatters by 0.0003 from sample to sample")));
  data = good;
  data.noise.slip_m = 0.3;
  EXPECT_THAT(examined(data).findings, Contains(HasSubstr("errors in noise units are too small")));
}

TEST(Quality, OffsetsOfSensors) {
  const Dataset good = test::made_dataset(sliding_cabinet(0.2));
  const auto shifted = [](std::vector<double>& samples, double by) {
    for (double& s : samples) s += by;
  };
  const auto floor = [](Dataset& data, double by) {
    for (auto& t : data.tests) {
      for (std::size_t i = 0; i < t.motion.horizontal_mps2.size(); i += 2) t.motion.horizontal_mps2[i] += by;
      index_runs(t.motion);
    }
  };
  Dataset data = good;
  shifted(data.tests[1].slip_m, 2 * test::slip_noise_m);
  shifted(data.tests[2].rotation_rad, -0.05);
  Quality q = examined(data);
  EXPECT_THAT(q.findings, Contains(HasSubstr("the slip of t2 does not start at zero (up to 0.00055 m): subtract")));
  EXPECT_THAT(q.findings, Contains(HasSubstr("the rotation of t3 does not start at zero (up to 0.05 rad)")));
  EXPECT_EQ(q.wrong_numbers, 1);  // an offset of twice the noise does little harm
  data = good;
  shifted(data.tests[1].slip_m, 0.3 * test::slip_noise_m);
  EXPECT_THAT(examined(data).findings, IsEmpty());
  floor(data, -0.28);
  q = examined(data);
  EXPECT_THAT(q.findings, Contains(HasSubstr("the floor of t1, t2, t3, t4, t5 is off zero before and after the shaking "
                                             "(0.28 m/s2)")));
  EXPECT_TRUE(q.spoilt());
}

// Less than a percent of what the floor reaches, and no more than the noise of one sample, is told by the mean of many; half a second of sliding
// under it makes more than a sensor of slips can miss.
TEST(Quality, AnOffsetOfTheFloorIsJudgedByItsOwnError) {
  constexpr double floor_noise = 0.04, offset = 0.04;
  for (const double by : {0.0, offset}) {
    Dataset data = test::made_dataset(sliding_cabinet(0.2));
    data.noise.floor_acceleration_mps2 = floor_noise;
    for (std::size_t t = 0; t < data.tests.size(); ++t) {
      std::vector<double> a = motion_samples(data.tests[t].motion, data.tests[t].motion.horizontal_mps2);
      for (std::size_t k = 0; k < a.size(); ++k) a[k] += by + floor_noise * random::standard_normal(31, k, t);
      data.tests[t].motion = piecewise_linear("noisy", data.tests[t].motion.knot_s[1], a, {});
    }
    const Quality q = examined(data);
    EXPECT_EQ(q.spoilt(), by > 0);
    const auto told = Contains(HasSubstr("is off zero before and after the shaking (0.04"));
    if (by > 0)
      EXPECT_THAT(q.findings, told);
    else
      EXPECT_THAT(q.findings, Not(told));
  }
}

// A sensor at its end says nothing of what goes on beyond: no effect is named by it.
TEST(Quality, ACutOffChannelSpoilsTheSet) {
  for (const bool floor : {false, true}) {
    Dataset data = test::made_dataset(sliding_cabinet(0.2));
    const auto cut = [](std::vector<double>& samples) {
      const double most = greatest(samples);
      for (double& s : samples) s = std::clamp(s, -0.6 * most, 0.6 * most);
    };
    std::vector<double> a = motion_samples(data.tests[1].motion, data.tests[1].motion.horizontal_mps2);
    for (std::size_t k = 0; k < a.size(); ++k) a[k] += 0.02 * random::standard_normal(32, k, 0);
    cut(floor ? a : data.tests[1].slip_m);
    data.tests[1].motion = piecewise_linear("cut", data.tests[1].motion.knot_s[1], a, {});
    const Quality q = examined(data);
    EXPECT_THAT(q.findings, Contains(HasSubstr("the sensor looks clipped"))) << floor;
    EXPECT_TRUE(q.spoilt()) << floor;
  }
}

// A dead floor and a noise that is understated make no offset.
TEST(Quality, WhatIsNoOffset) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  data.noise.slip_m /= 100;
  data.noise.rotation_rad /= 100;
  for (double& c : data.tests[0].motion.horizontal_mps2) c = 0;
  index_runs(data.tests[0].motion);
  EXPECT_THAT(examined(data).findings, Not(Contains(HasSubstr("does not start at zero"))));
}

// Cut out of the middle of a slip, a test begins off zero.
TEST(Quality, RecordsThatBeginLate) {
  Dataset data = test::made_dataset(sliding_cabinet(0.2));
  auto& cut = data.tests[0];
  const std::size_t from = 150;
  std::vector<double> floor;
  for (std::size_t i = 2 * from; i < cut.motion.horizontal_mps2.size(); i += 2)
    floor.push_back(cut.motion.horizontal_mps2[i]);
  cut.motion = piecewise_linear("cut", 0.005, floor, {});
  for (auto* samples : {&cut.slip_m, &cut.rotation_rad}) samples->erase(samples->begin(), samples->begin() + from);
  ASSERT_GT(std::abs(cut.slip_m[0]), 0.01);
  EXPECT_THAT(examined(data).findings, Contains(HasSubstr("the slip of t1 does not start at zero")));
}

// The floor shakes from 0.5 s on; a response that is 0.3 s ahead of it cannot be its answer, slip or rotation.
TEST(Quality, AResponseThatBeginsBeforeItsFloor) {
  Specimen rocks = sliding_cabinet(0.9);
  rocks.block = Block::rectangular(0.3, 1.2, 100);
  rocks.model = Model::slide_rock;
  for (const Specimen& s : {sliding_cabinet(0.2), rocks}) {
    Dataset data = test::made_dataset(s);
    EXPECT_THAT(doubts(Bench(data, 0)).sentences, Not(Contains(HasSubstr("before its floor"))));
    if (s.model == Model::slide_rock) data.tests[1].slip_m.clear();
    for (auto* samples : {&data.tests[1].slip_m, &data.tests[1].rotation_rad})
      for (std::size_t i = 0; i + 60 < samples->size(); ++i) (*samples)[i] = (*samples)[i + 60];
    const Doubts found = doubts(Bench(data, 0));
    EXPECT_THAT(found.sentences,
                Contains("the block of t2 moves before its floor does, or farther: check the clocks of the channels"));
    EXPECT_GT(found.spoilt_tests, 0U);
  }
}

TEST(Quality, ACutOffPeakIsNoRoundedOne) {
  std::vector<double> rounded, cut;
  for (int i = 0; i < 400; ++i) {
    const double y = 3 * std::sin(i * 0.02);
    rounded.push_back(std::round(y * 100) / 100);
    cut.push_back(std::clamp(std::round(y * 100) / 100, -1.5, 1.5));
  }
  EXPECT_TRUE(clipped(rounded, 0.01));
  EXPECT_FALSE(cut_off(rounded, 0.01));
  EXPECT_TRUE(cut_off(cut, 0.01));
}

// The block's accelerometer, in all tests together: while nothing moves it shows the floor.
TEST(Quality, TheGainOfTheBlocksAccelerometer) {
  for (const double factor : {1.0, 1.1, 0.9}) {
    Dataset data = test::made_dataset(sliding_cabinet(0.2));
    for (measurement::Test& test : data.tests) {
      test.block_acceleration_mps2.assign(test.slip_m.size(), 0);  // asked for
      test.block_acceleration_mps2 =
          predict(test::free_friction(), test, std::vector<double>{0.2}).block_acceleration_mps2;
      for (std::size_t k = 0; k < test.block_acceleration_mps2.size(); ++k)
        test.block_acceleration_mps2[k] =
            factor * test.block_acceleration_mps2[k] + 0.01 * std::cos(7 * static_cast<double>(k * k));
    }
    const auto told =
        Contains(testing::ContainsRegex("is (1.1|0.9)[0-9]* times the floor's before .*: check its gain"));
    const Doubts found = doubts(Bench(data, 0));
    if (factor == 1)
      EXPECT_THAT(found.sentences, IsEmpty());
    else
      EXPECT_THAT(found.sentences, told);
    EXPECT_EQ(found.spoilt_tests, 0U);
  }
}

}  // namespace
}  // namespace freestand::measurement::plausible_test
