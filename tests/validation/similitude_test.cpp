// Similitude of the base models: a run at quarter scale against the run in full size (support/similitude.hpp). The fast
// integrator is held to the same bits, and so are the packs that slide. Model bouc_wen, whose step length is a root that
// rounds, and the packs that rock, which neglect terms below 3e-11 rad/s and slips below 1e-10 m, are held to 1e-9 of
// the size (of u_y), rad and g; the reference to its tolerance. Lengths / 3 with times / sqrt(3) are not exact: there the
// stated tolerance is 1e-7, and samples that a change of the shaking by 1e-10 moves by more are counted, not compared.
#include "support/similitude.hpp"

#include <vector>

#include "dynamics/chain.hpp"
#include "support/bouc_wen_cases.hpp"
#include "support/floor_motions.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

const Scale third_scale{1.0 / 3, 1 / std::sqrt(3.0)};

struct Base {
  const char* name;
  Model model;
  ImpactLaw law;
  bool chain;
  double tolerance = 0, in_packs = 0;  // 0: the same bits
};
constexpr Base bases[] = {{"Slide", Model::slide, ImpactLaw::housner, false},
                          {"RockHousner", Model::rock, ImpactLaw::housner, false, 0, 1e-9},
                          {"RockCoulomb", Model::rock, ImpactLaw::coulomb, false},
                          {"SlideRockHousner", Model::slide_rock, ImpactLaw::housner, false, 0, 1e-9},
                          {"SlideRockCoulomb", Model::slide_rock, ImpactLaw::coulomb, false},
                          {"BoucWen", Model::bouc_wen, ImpactLaw::housner, false, 1e-9, 1e-9},
                          {"SlideOnAChain", Model::slide, ImpactLaw::housner, true},
                          {"SlideRockOnAChain", Model::slide_rock, ImpactLaw::coulomb, true}};

dynamics::Chain scaled(dynamics::Chain chain, const Scale& scale) {
  chain.slack_m *= scale.length;
  chain.height_m *= scale.length;
  chain.stiffness_npm *= scale.mass() / (scale.time * scale.time);
  chain.strength_n *= scale.mass() * scale.length / (scale.time * scale.time);
  return chain;
}

dynamics::Chain random_chain(KeyedRandom& random, const Block& block) {
  const double weight = block.mass_kg * standard_gravity_mps2;
  return {.slack_m = block.half_base_m() * random.uniform(0, 0.1),
          .stiffness_npm = weight / (block.half_base_m() * random.log_uniform(0.003, 0.1)),
          .strength_n = weight * random.log_uniform(0.3, 5),
          .height_m = block.height_m * random.uniform(1, 2),
          .side = random.chance(0.5) ? 1 : -1};
}

Pair random_pair(const Base& base, std::uint64_t number, const Scale& scale) {
  if (base.model == Model::bouc_wen) {
    const RandomCase c = random_bouc_wen_case({.seed = 70, .longest_s = 2}, number);
    return pair_of(text(c.specimen.bouc_wen) + c.text(), c.specimen, c.motion, c.shaking, scale);
  }
  CaseFamily family;
  family.seed = 71;
  family.alpha_high = 0.8;
  family.duration_low_s = 3;
  family.duration_high_s = 6;
  RandomCase c = random_case(family, number);
  c.specimen.model = base.model;
  c.specimen.impact = {base.law, base.law == ImpactLaw::coulomb ? 1 : c.specimen.impact.factor};
  Pair pair = pair_of(c, scale);
  if (!base.chain) return pair;
  KeyedRandom random(72, number);
  const dynamics::Chain chain = random_chain(random, pair.large.block);
  pair.large.effects = {dynamics::use(chain, pair.large.block)};
  pair.small.effects = {dynamics::use(scaled(chain, scale), pair.small.block)};
  return pair;
}

class Similitude : public testing::TestWithParam<Base> {};

TEST_P(Similitude, QuarterScaleGivesTheSameAnswer) {
  const int count = cases(GetParam().chain ? 50 : 150);
  int moved = 0, overturned = 0, failed = 0, bits = 0;
  double worst = 0;
  for (std::uint64_t number = 0; number < static_cast<std::uint64_t>(count); ++number) {
    const Pair pair = random_pair(GetParam(), number, report_scale);
    const Answers both = solve(respond, pair, report_scale);
    const double off = difference(both.large, both.small, pair.length());
    worst = std::max(worst, off);
    bits += same_bits(both);
    EXPECT_TRUE(same_bits(both) || off < GetParam().tolerance) << number << ' ' << pair.text << text_of(both);
    EXPECT_NE(both.large.outcome, Outcome::step_limit) << number << ' ' << pair.text;
    moved += both.large.outcome == Outcome::moved;
    overturned += both.large.outcome == Outcome::overturned;
    failed += both.large.connection_failed;
  }
  std::printf("%d moved, %d overturned, %d connections failed; %d to the bit, worst %.1e\n", moved, overturned, failed,
              bits, worst);
  EXPECT_GT(moved + overturned, count / 3);
}

// In packs where they cover the sample. The chain goes one by one.
TEST_P(Similitude, QuarterScaleGivesTheSameAnswerInPacks) {
  std::vector<Pair> pairs;
  std::vector<Specimen> large, small;
  std::vector<Shaking> large_shakings, small_shakings;
  for (std::uint64_t number = 0; number < static_cast<std::uint64_t>(cases(GetParam().chain ? 20 : 100)); ++number) {
    pairs.push_back(random_pair(GetParam(), number, report_scale));
    Pair& pair = pairs.back();
    pair.large_shaking.vertical_scale = pair.small_shaking.vertical_scale = 0;
    large.push_back(pair.large);
    small.push_back(pair.small);
    large_shakings.push_back(pair.large_shaking);
    small_shakings.push_back(pair.small_shaking);
  }
  std::vector<Response> expected(pairs.size()), found(pairs.size());
  respond_batch(large, large_shakings, {}, expected);
  respond_batch(small, small_shakings, scaled(Settings{}, report_scale), found);
  double worst = 0;
  int bits = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Answers both{expected[i], enlarged(found[i], report_scale)};
    const double off = difference(both.large, both.small, pairs[i].length());
    worst = std::max(worst, off);
    bits += same_bits(both);
    EXPECT_TRUE(same_bits(both) || off < GetParam().in_packs) << i << ' ' << pairs[i].text << text_of(both);
  }
  std::printf("%d of %zu to the bit, worst %.1e\n", bits, pairs.size(), worst);
}

// It looks at accelerations only at the ends of its steps, whose lengths differ.
TEST_P(Similitude, ReferenceAtQuarterScaleIsTheSameToItsTolerance) {
  int bits = 0;
  double worst = 0, worst_acceleration = 0;
  for (std::uint64_t number = 0; number < static_cast<std::uint64_t>(cases(15)); ++number) {
    const Pair pair = random_pair(GetParam(), number, report_scale);
    Answers both = solve(respond_reference, pair, report_scale);
    bits += same_bits(both);
    const double acceleration =
        std::abs(both.large.peak_acceleration_mps2 - both.small.peak_acceleration_mps2) / standard_gravity_mps2;
    EXPECT_LT(acceleration, 1e-3) << number << ' ' << pair.text << text_of(both);
    both.small.peak_acceleration_mps2 = both.large.peak_acceleration_mps2;
    const double off = difference(both.large, both.small, pair.length());
    EXPECT_LT(off, 1e-6) << number << ' ' << pair.text << text_of(both);
    worst = std::max(worst, off);
    worst_acceleration = std::max(worst_acceleration, acceleration);
  }
  std::printf("%d of %d to the bit, worst %.1e, acceleration %.1e g\n", bits, cases(15), worst, worst_acceleration);
}

// Does a ten thousand millionth of the shaking move the answer as far as that?
bool sensitive(const Pair& pair, const Response& answer, double as_far_as) {
  for (const double factor : {1 + 1e-10, 1 - 1e-10}) {
    Shaking changed = pair.large_shaking;
    changed.scale *= factor;
    if (!(difference(answer, respond(pair.large, changed, {.tolerance = 1e-12}), pair.length()) < as_far_as))
      return true;
  }
  return false;
}

TEST_P(Similitude, ThirdScaleGivesTheSameAnswerToTheTolerance) {
  const int count = cases(GetParam().chain ? 25 : 60);
  int compared = 0, chaotic = 0;
  double worst = 0;
  for (std::uint64_t number = 0; number < static_cast<std::uint64_t>(count); ++number) {
    const Pair pair = random_pair(GetParam(), number, third_scale);
    const Answers both = solve(respond, pair, third_scale, {.tolerance = 1e-12});
    const double off = difference(both.large, both.small, pair.length());
    ASSERT_FALSE(std::isnan(off)) << number;
    if (!(off < 1e-7) && sensitive(pair, both.large, off)) {
      ++chaotic;
      continue;
    }
    EXPECT_LT(off, 1e-7) << number << ' ' << pair.text << text_of(both);
    worst = std::max(worst, off);
    ++compared;
  }
  std::printf("%d compared, %d sensitive, worst %.1e\n", compared, chaotic, worst);
  EXPECT_LE(chaotic, 0.05 * count + 1);
}

INSTANTIATE_TEST_SUITE_P(Models, Similitude, testing::ValuesIn(bases),
                         [](const auto& info) { return std::string(info.param.name); });

// Pulses: the period is halved.
TEST(SimilitudeOfPulses, HalfThePeriodGivesTheSameBits) {
  const auto sine = std::make_shared<FloorMotion>(one_sine());
  int moved = 0;
  for (std::uint64_t number = 0; number < 100; ++number) {
    KeyedRandom random(73, number);
    RandomCase c = random_case({.seed = 74, .alpha_high = 0.8}, number);
    c.shaking = {sine.get(), standard_gravity_mps2 * random.uniform(0.2, 1.5), random.log_uniform(0.3, 2)};
    Pair pair{c.text(), c.specimen, scaled(c.specimen, report_scale), sine, sine, c.shaking, c.shaking};
    pair.small_shaking.stretch *= report_scale.time;
    const Answers both = solve(respond, pair, report_scale);
    EXPECT_TRUE(same_bits(both)) << number << ' ' << pair.text << text_of(both);
    moved += both.large.outcome != Outcome::at_rest;
  }
  EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace freestand::test
