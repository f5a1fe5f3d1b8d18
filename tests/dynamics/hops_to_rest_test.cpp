// A block rocks itself to rest while the floor's push grows towards what tips it. A hop of 1e-9 rad has a rate of some 5e-5 rad/s, which the
// floor makes a motion of where it tips the block before the row of hops is over: put to rest too early the block is off by a
// hundred times what a step may be. The demands at the default tolerance are those of one ten thousand times smaller.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <freestand/simulate.hpp>
#include <vector>

#include "base/units.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

// Offset of the centre of mass, in half widths.
Block slender_block(double offset) {
  Block block = Block::rectangular(0.6, 1.8, 150);
  block.left_m = 0.3 * (1 + offset);
  block.right_m = 0.3 * (1 - offset);
  return block;
}

// A jolt that makes the block rock, and after `wait_s` a push that grows to a fifth over what tips the block, and falls.
FloorMotion jolt_and_ramp(const Block& block, double wait_s) {
  constexpr double step_s = 0.005, jolt_s = 0.05, grows_s = 0.3;
  const double most = std::max(block.left_m, block.right_m) / block.height_m * standard_gravity_mps2;
  const double tips = std::min(block.left_m, block.right_m) / block.height_m * standard_gravity_mps2;
  std::vector<double> a;
  for (double t = 0; t < wait_s + 3 * grows_s; t += step_s) {
    const double since = t - wait_s, ramp = since < grows_s ? since / grows_s : std::max(2 - since / grows_s, 0.0);
    a.push_back(t < jolt_s ? -1.3 * most * std::sin(pi * t / jolt_s) : since > 0 ? 1.2 * tips * ramp : 0.0);
  }
  return piecewise_linear("jolt and ramp", step_s, a);
}

struct Family {
  const char* name;
  Model model;
  ImpactLaw law;
  double offset;
};
std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

class HopsToRest : public testing::TestWithParam<Family> {
 protected:
  static constexpr int samples = 3000;
  std::vector<FloorMotion> floors_;
  std::vector<Specimen> specimens_;
  std::vector<Shaking> shakings_;

  void SetUp() override {
    Specimen specimen;
    specimen.block = slender_block(GetParam().offset);
    specimen.friction = {1.2, 1.2};
    specimen.impact = {GetParam().law, 1};
    specimen.model = GetParam().model;
    for (int i = 0; i < samples; ++i) floors_.push_back(jolt_and_ramp(specimen.block, 0.0 + 0.00004 * i));
    for (const FloorMotion& floor : floors_) {
      specimens_.push_back(specimen);
      shakings_.push_back({&floor});
    }
  }
  static double apart(const Response& a, const Response& b) {
    return std::abs(a.peak_rotation_rad - b.peak_rotation_rad);
  }
  // By less than a step may err.
  static void expect_small(std::vector<double> differences, const char* which) {
    std::ranges::sort(differences);
    std::printf("%s, %s: median %.1e, largest %.1e rad\n", GetParam().name, which, differences[samples / 2],
                differences.back());
    EXPECT_LT(differences.back(), 1e-9) << which;
  }
};

TEST_P(HopsToRest, AtTheDefaultToleranceIsThatOfATighterOne) {
  std::vector<double> alone, packed;
  std::vector<Response> usual(samples), tight(samples);
  respond_batch(specimens_, shakings_, {}, usual);
  respond_batch(specimens_, shakings_, {.tolerance = 1e-13}, tight);
  for (int i = 0; i < samples; ++i) {
    packed.push_back(apart(usual[i], tight[i]));
    alone.push_back(
        apart(respond(specimens_[i], shakings_[i]), respond(specimens_[i], shakings_[i], {.tolerance = 1e-13})));
  }
  EXPECT_GT(
      std::ranges::count_if(tight, [](const Response& r) { return r.outcome == Outcome::moved && r.events > 10; }),
      samples / 2);
  expect_small(packed, "in packs");
  expect_small(alone, "alone");
}

INSTANTIATE_TEST_SUITE_P(Blocks, HopsToRest,
                         testing::Values(Family{"rocking", Model::rock, ImpactLaw::housner, 0},
                                         Family{"rocking off centre", Model::rock, ImpactLaw::housner, -0.1},
                                         Family{"slide-rock off centre", Model::slide_rock, ImpactLaw::housner, -0.1},
                                         Family{"slide-rock, Coulomb's impacts", Model::slide_rock, ImpactLaw::coulomb,
                                                0.1}));

// On a still floor the hops of a row from so small a rotation fall with the weight alone: each lasts 2 rate/alpha, and the whole endless row is
// a geometric series on either corner. How many of its hops are gone through is a matter of the tolerance, its end is not.
FREESTAND_ON_BOTH_SOLVERS(EndOfHops);

TEST_P(EndOfHops, IsThatOfTheEndlessRow) {
  const FloorMotion still = piecewise_linear("still", 0.001, std::vector<double>(2, 0.0));
  for (const double offset : {0.0, 0.3, -0.6}) {
    Specimen specimen;
    specimen.block = slender_block(offset);
    specimen.friction = {1.2, 1.2};
    specimen.model = Model::rock;
    specimen.start.rotation_rad = 2e-5;  // on the right corner
    const Block& block = specimen.block;
    const double size = block.gyration2_m2 + block.height_m * block.height_m, here = block.right_m,
                 there = block.left_m;
    const double falls = standard_gravity_mps2 * here / (size + here * here),
                 falls_there = standard_gravity_mps2 * there / (size + there * there);
    const double kept = (size - here * there) / (size + there * there),
                 kept_there = (size - here * there) / (size + here * here);
    const double rate = std::sqrt(2 * falls * specimen.start.rotation_rad);
    const double row = 2 * kept * rate * (1 / falls_there + kept_there / falls) / (1 - kept * kept_there);
    for (const double tolerance : {1e-8, 1e-12}) {
      const Response response = GetParam()(specimen, {&still}, {.tolerance = tolerance});
      EXPECT_EQ(response.outcome, Outcome::moved);
      EXPECT_NEAR(response.end_time_s, rate / falls + row, 2e-4 * row)
          << "offset " << offset << ", tolerance " << tolerance;
    }
  }
}

}  // namespace
}  // namespace freestand::test
