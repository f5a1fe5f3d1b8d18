// Numbers that look as if they were in another unit are told, and sound ones are not.
#include "study/doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_text.hpp"

namespace freestand::study::doubts_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string rest = fragility + samples;

TEST(Doubts, NoneOfASoundStudy) { EXPECT_THAT(doubts(parse(block + friction + motions + rest)), IsEmpty()); }

TEST(Doubts, NumbersInAnotherUnit) {
  const std::string pulse = "motions: [{pulse: B, period_s: {uniform: [300, 800]}, peak_acceleration_g: 20}]\n";
  EXPECT_THAT(
      doubts(parse("block: {width_m: 620, height_m: 2286, mass_kg: 386}\nfriction: {mu: 15}\n" + pulse + rest)),
      ElementsAre("block.width_m is 620: is it in metres?", "block.height_m is 2286: is it in metres?",
                  "friction.mu is 15: is it a friction coefficient?", "motion.period_s is 550: is it in seconds?",
                  "motion.peak_acceleration_g is 20: is it in g?"));
  EXPECT_THAT(doubts(parse("block: {width_m: 24, height_m: 72, mass_kg: 386}\n" + friction + motions + rest)),
              ElementsAre("block.width_m is 24: is it in metres?", "block.height_m is 72: is it in metres?"));
  EXPECT_THAT(doubts(parse("block: {slenderness_rad: 1.5, size_m: 1, mass_kg: 1}\n" + friction + motions + rest)),
              ElementsAre(HasSubstr("is it in radians")));
}

TEST(Doubts, CapacitiesInAnotherUnit) {
  const auto with = [](const char* capacities) {
    return doubts(parse(block + friction + motions + samples +
                        "fragility: {edp: [peak_slip_m], capacities: {peak_slip_m: " + capacities + "}}\n"));
  };
  EXPECT_THAT(with("[20, 100, 300]"), ElementsAre("fragility.capacities.peak_slip_m goes up to 300: is it in metres?"));
  EXPECT_THAT(with("[0.02, 0.1, 0.3]"), IsEmpty());
}

TEST(Doubts, DispersionsThatAreNoLogarithms) {
  const auto with = [](const char* dispersion) {
    return doubts(
        parse(block + "friction: {mu: {lognormal: {median: 0.2, dispersion: " + dispersion + "}}}\n" + motions + rest));
  };
  EXPECT_THAT(with("30"), ElementsAre(HasSubstr("friction.mu has the dispersion 30")));
  EXPECT_THAT(with("1"), IsEmpty());
}

// Whatever the distribution is called, and whatever it is of: two thirds of the values of nothing span a factor of a hundred.
TEST(Doubts, DistributionsThatSpanTooMuch) {
  const auto friction_of = [](const char* value) {
    return doubts(parse(block + "friction: {mu: " + value + "}\n" + motions + rest));
  };
  EXPECT_THAT(friction_of("{log_uniform: [1e-60, 1]}"),
              ElementsAre("two thirds of the values of friction.mu span a factor of 1e+40: are its ends right?"));
  EXPECT_THAT(friction_of("{log_uniform: [0.001, 1.0001]}"), ElementsAre(HasSubstr("span a factor of 1e+02")));
  EXPECT_THAT(friction_of("{log_uniform: [0.001, 0.999]}"), IsEmpty());
  EXPECT_THAT(friction_of("{lognormal: {median: 0.2, dispersion: 30, min: 0.1, max: 0.5}}"), IsEmpty());
  const std::string capacities =
      "fragility: {edp: [peak_slip_m], capacities: {peak_slip_m: [0.1, {lognormal: {median: 0.1, dispersion: 30}}]}}\n";
  EXPECT_THAT(doubts(parse(block + friction + motions + samples + capacities)),
              ElementsAre(HasSubstr("damage.peak_slip_m_over_capacity_1.capacity has the dispersion 30")));
}

TEST(Doubts, NothingThatShakes) {
  EXPECT_THAT(doubts(parse(block + friction + "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: 0}]\n" + rest)),
              ElementsAre("motion.peak_acceleration_g is 0: nothing will shake"));
}

TEST(Doubts, RecordsInAnotherUnit) {
  Study study = parse(block + friction + motions + rest);
  MotionSource& source = study.motions[0];
  source.kind = MotionSource::Kind::records;
  source.amplitude = Quantity{.name = "motion.scale", .unit = "1", .value = sampling::Fixed{2}};
  const auto set = [](double step_s, double peak_mps2) {
    MotionSet motions;
    motions.entries = std::make_shared<const std::vector<MotionSet::Entry>>(std::vector<MotionSet::Entry>{
        {.motion =
             piecewise_linear("some.csv", step_s, {0, peak_mps2, 0, -peak_mps2, 0, -peak_mps2, 0, peak_mps2, 0}, {}),
         .peak_mps2 = peak_mps2}});
    motions.of_source = {{0}};
    return motions;
  };
  EXPECT_THAT(doubts(study, set(0.01, 9)), IsEmpty());
  EXPECT_THAT(doubts(study, set(0.01, 300)), ElementsAre(HasSubstr("the floor of some.csv reaches 61.2 g")));
  EXPECT_THAT(doubts(study, set(5, 9)), testing::Contains(HasSubstr("the time step of some.csv is 5 s")));
}

// A record in another unit is scaled by far more than any that is used.
TEST(Doubts, RecordsThatAreScaledTooFar) {
  const auto said = [](const std::string& to, double peak_mps2) {
    Study study = parse(block + friction + motions + rest);
    MotionSource& source = study.motions[0];
    source.kind = MotionSource::Kind::records;
    source.scale_to = IntensityPart{to, "", {}};
    source.amplitude = Quantity{.name = "motion." + to, .unit = "g", .value = sampling::Uniform{0.5, 1.5}};
    MotionSet set;
    set.entries = std::make_shared<const std::vector<MotionSet::Entry>>(std::vector<MotionSet::Entry>{
        {.motion =
             piecewise_linear("some.csv", 0.01, {0, peak_mps2, 0, -peak_mps2, 0, -peak_mps2, 0, peak_mps2, 0}, {}),
         .peak_mps2 = peak_mps2}});
    set.of_source = {{0}};
    return doubts(study, set);
  };
  EXPECT_THAT(said("pga_g", 9.80665e-9),
              ElementsAre("some.csv is scaled by 1e+09 to reach pga_g 1: is its unit right?"));
  EXPECT_THAT(said("pga_g", 0.0980), ElementsAre(HasSubstr("is scaled by 100 to reach pga_g 1")));
  EXPECT_THAT(said("pga_g", 0.0981), IsEmpty());
}

// A case is one sample: it takes no choice, and is told what it takes.
TEST(Doubts, OfACaseAdviseWhatACaseTakes) {
  const auto said = [](const std::string& more, double scale) {
    Case one = parse_case(block + friction + "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n" + more,
                          "one.yaml");
    MotionSource& source = one.study.motions[0];
    source.kind = MotionSource::Kind::records;
    source.records = "floor.csv";
    source.amplitude = Quantity{.name = "motion.scale", .unit = "1", .value = sampling::Fixed{scale}};
    MotionSet none;
    none.of_source = {{}};
    return doubts(one, none);
  };
  EXPECT_THAT(said("effects: [{name: wall_impact, gap_m: 0.05}]\n", 1.2),
              ElementsAre(testing::EndsWith("a negative number turns it round: simulate that too (scale: -1.2)")));
}

// An accelerometer that feels gravity, a channel in other units, one that holds nothing: of the channels beside the first, too, where they shake
// the block.
TEST(Doubts, OtherChannelsOfRecords) {
  const std::string shaken = "effects: [{name: vertical_shaking, scale: 1}]\n";
  const auto said = [](const std::string& more, const std::vector<double>& vertical, const std::vector<double>& cross) {
    Study study = parse(block + friction + motions + rest + more);
    MotionSource& source = study.motions[0];
    source.kind = MotionSource::Kind::records;
    source.amplitude = Quantity{.name = "motion.scale", .unit = "1", .value = sampling::Fixed{1}};
    MotionSet set;
    FloorMotion motion = piecewise_linear("some.csv", 0.01, {0, 2, 0, -2, 0, -2, 0, 2, 0}, vertical);
    if (!cross.empty()) motion.cross_mps2 = piecewise_linear("", 0.01, cross, {}).horizontal_mps2;
    set.entries = std::make_shared<const std::vector<MotionSet::Entry>>(
        std::vector<MotionSet::Entry>{{.motion = motion, .peak_mps2 = 2}});
    set.of_source = {{0}};
    return doubts_of_records(study, set);
  };
  const std::vector<double> sound{0, 1, 0, -1, 0, -1, 0, 1, 0}, gravity{9.8, 10.8, 9.8, 8.8, 9.8, 8.8, 9.8, 10.8, 9.8},
      nothing(9, 0), strong{0, 40, 0, -40, 0, -40, 0, 40, 0};
  EXPECT_THAT(said(shaken, sound, sound), IsEmpty());
  EXPECT_THAT(said(shaken, gravity, {}),
              ElementsAre(HasSubstr("the vertical channel of some.csv has an offset of 9.")));
  EXPECT_THAT(said("", gravity, {}), IsEmpty());
  EXPECT_THAT(said("", {}, gravity),
              ElementsAre(HasSubstr("the second component of the pair of some.csv has an offset of 9.")));
  EXPECT_THAT(said(shaken, nothing, {}),
              ElementsAre("the vertical channel of some.csv is zero throughout: is it the right one?"));
  EXPECT_THAT(said(shaken, {}, {}), ElementsAre(HasSubstr("no vertical channel is there of some.csv")));
  EXPECT_THAT(
      said("", {}, strong),
      ElementsAre(HasSubstr("the second component of the pair of some.csv is 20 times as strong as the first one")));
}

// A record turned round is as likely a motion, and another one for what stands on one side.
TEST(Doubts, RecordsOfOneSignBesideAWallOnOneSide) {
  const auto said = [](const std::string& more, const sampling::Distribution& scale, bool records = true) {
    Study study = parse(block + friction + motions + rest + more);
    MotionSource& source = study.motions[0];
    if (records) source.kind = MotionSource::Kind::records;
    source.records = "some/*.csv";
    source.amplitude = Quantity{.name = "motion.scale", .unit = "1", .value = scale};
    return doubts(study);
  };
  const std::string right = "effects: [{name: wall_impact, gap_m: 0.05}]\n",
                    both = "effects: [{name: wall_impact, gap_m: {uniform: [-0.05, 0.05]}}]\n",
                    on_left = "effects: [{name: wall_impact, gap_m: 0, side: -1}]\n",
                    drawn = "effects: [{name: wall_impact, gap_m: 0.05, side: {choice: [-1, 1]}}]\n",
                    with_other = "effects: [{name: wall_impact, gap_m: 0.05, other_gap_m: 0}]\n",
                    behind = "chain: {stiffness_npm: 1e4, strength_n: 2736, wall_gap_m: 0.1}\n";
  EXPECT_THAT(said(right, sampling::Fixed{1}),
              ElementsAre(HasSubstr("the wall of wall_impact is on one side, and some/*.csv")));
  EXPECT_THAT(said(behind, sampling::Fixed{1}), ElementsAre(HasSubstr("scale: {choice: [-1, 1]}")));
  EXPECT_THAT(said(right, sampling::Uniform{-1, 1}), IsEmpty());
  EXPECT_THAT(said(both, sampling::Fixed{1}), IsEmpty());
  EXPECT_THAT(said(on_left, sampling::Fixed{1}), ElementsAre(HasSubstr("the wall of wall_impact is on one side")));
  EXPECT_THAT(said(drawn, sampling::Fixed{1}), IsEmpty());
  EXPECT_THAT(said(with_other, sampling::Fixed{1}), IsEmpty());
  EXPECT_THAT(said("", sampling::Fixed{1}), IsEmpty());
  EXPECT_THAT(said(right, sampling::Fixed{1}, false), IsEmpty());
}

// Friction that falls below zero somewhere that the block may never reach.
TEST(Doubts, FrictionBelowZeroWhereABlockMayCome) {
  const auto with = [](const std::string& law) {
    return doubts(parse(block + friction + motions + rest + "effects: [{name: patch, friction: \"" + law +
                        "\", parameters: {a: {uniform: [0.5, 1.5]}}}]\n"));
  };
  EXPECT_THAT(with("mu*(1 - a*exp(-u^2))/(1 + a)"), IsEmpty());
  EXPECT_THAT(
      with("mu*(1 - 2*a*u)"),
      ElementsAre("friction of effect patch is -0.25 at u = 1 m, and pushes the block on there: is it ever there? "
                  "max(0, ...) keeps it from that"));
  EXPECT_THAT(with("mu*(a - 0.2*sigma*v^2)"), IsEmpty());
  EXPECT_THAT(with("mu*(a - 0.3*speed^2)"), ElementsAre(HasSubstr("is -0.05 at v = 2 m/s,")));
  EXPECT_THAT(with("mu*(a + 0.3*v)*(a - 20*theta^2)"), IsEmpty());
  EXPECT_THAT(with("mu*(a + 11*theta)"), ElementsAre(HasSubstr("at theta = -0.1 rad,")));
  EXPECT_THAT(with("mu*(a - 0.1*t)"), ElementsAre(HasSubstr("at t = 20 s,")));
  EXPECT_THAT(with("mu*(a - 2*path)"), ElementsAre(HasSubstr("at path = 1 m,")));
}

// Springs under the edges of a block of 0.6 by 1.8 m hold it upright from sqrt(g h)/(2 pi b) = 1.58 Hz on.
TEST(Doubts, LegsThatDoNotHoldTheBlockUpright) {
  const auto on_legs = [](const std::string& frequency) {
    return parse(block + friction + motions + rest + "legs: {vertical_frequency_hz: " + frequency + "}\n");
  };
  EXPECT_THAT(doubts(on_legs("1.5")),
              ElementsAre(HasSubstr("legs of less than 1.58 Hz do not hold this block upright")));
  EXPECT_THAT(doubts(on_legs("{uniform: [1, 6]}")), ElementsAre(HasSubstr("goes down to 1.05")));
  EXPECT_THAT(doubts(on_legs("{uniform: [1.6, 6]}")), IsEmpty());
}

// A wall stands behind every chain; where nobody says how far away it is, the block is told to touch it.
TEST(Doubts, TheWallBehindAChain) {
  const auto chained = [](const std::string& more) {
    return block + friction + motions + rest + "chain: {stiffness_npm: 1e4, strength_n: 2736" + more + "}\n";
  };
  EXPECT_THAT(doubts(parse(chained(""))),
              ElementsAre(AllOf(HasSubstr("chain.wall_gap_m is not given"), HasSubstr("peak accelerations are 1 g"))));
  EXPECT_THAT(doubts(parse(chained(", wall_gap_m: 0.1"))), IsEmpty());
  const Study legs = parse(chained("") + "effects: [{name: flexible_legs, frequency_hz: 8}]\n");
  EXPECT_FALSE(legs.model.chain->wall_gap);
  EXPECT_THAT(doubts(legs), IsEmpty());
}

}  // namespace
}  // namespace freestand::study::doubts_test
