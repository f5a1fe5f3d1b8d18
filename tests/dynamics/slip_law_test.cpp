// The part of a friction law that packs read (dynamics/slip_law.hpp): its values, and no more operations than they take.
#include "dynamics/slip_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/slip_laws.hpp"

namespace freestand::dynamics {
namespace {

using test::exponential, test::rational, test::worn, test::one_sided, test::of_all;

SlipLaw law_of(const Effect& effect, std::vector<double> values) {
  Specimen specimen;
  specimen.effects = {{&effect, std::move(values)}};
  return slip_law(Laws(specimen)).value();
}

TEST(SlipLaw, IsTheLaw) {
  const SlipLaw falls = law_of(exponential, {0.3, 0.2}), settles = law_of(rational, {0.3, 0.2});
  for (const double speed : {0.0, 1e-6, 0.03, 0.2, 1.7}) {
    EXPECT_NEAR(friction_factor(falls, {speed, 0.3, 1}), 1 - 0.3 * (1 - std::exp(-speed / 0.2)), 1e-15) << speed;
    EXPECT_NEAR(friction_factor(settles, {speed, 0.3, 1}), (0.2 + 0.7 * speed) / (0.2 + speed), 1e-15) << speed;
  }
}

TEST(SlipLaw, SeesPathAndDirection) {
  const SlipLaw wears = law_of(worn, {0.6, 0.2}), sided = law_of(one_sided, {0.3}), all = law_of(of_all, {0.3, 0.1});
  EXPECT_TRUE(wears.sees_path && !wears.sees_direction && !sided.sees_path && sided.sees_direction);
  EXPECT_TRUE(all.sees_path && all.sees_direction);
  for (const int direction : {-1, 1})
    for (const double path : {0.0, 0.01, 2.0}) {
      const Slip slip{0.07, path, direction};
      EXPECT_NEAR(friction_factor(wears, slip), 0.6 + 0.4 * std::exp(-path / 0.2), 1e-15);
      EXPECT_NEAR(friction_factor(sided, slip), 1 + 0.3 * direction, 1e-15);
      EXPECT_NEAR(friction_factor(all, slip), (1 + 0.3 * direction) * (0.7 + 0.3 * std::exp(-0.7)) / (1 + 0.5 * path),
                  1e-15);
    }
}

TEST(SlipLaw, CarriesNoOperationThatNobodyAsksFor) {
  EXPECT_EQ(law_of(exponential, {0.3, 0.2}).count, 3);  // exp(v w), between two of the form v x + s
  const SlipLaw law = law_of(rational, {0.3, 0.2});
  std::vector<int> asked(static_cast<std::size_t>(law.count), 0);
  for (int i = 0; i < law.count; ++i)
    for (const int place : {law.nodes[i].a, law.nodes[i].b})
      if (place >= slip_places) ++asked[static_cast<std::size_t>(place - slip_places)];
  for (int i = 0; i + 1 < law.count; ++i) EXPECT_GT(asked[static_cast<std::size_t>(i)], 0) << i;
}

TEST(SlipLaw, HasAShapeOfItsOwn) {
  EXPECT_TRUE(same_shape(law_of(exponential, {0.3, 0.2}), law_of(exponential, {-0.1, 0.5})));
  EXPECT_FALSE(same_shape(law_of(exponential, {0.3, 0.2}), law_of(rational, {0.3, 0.2})));
  EXPECT_TRUE(law_of(exponential, {0.3, 0.2}).fades);
  EXPECT_FALSE(law_of(rational, {0.3, 0.2}).fades);
  EXPECT_FALSE(law_of(worn, {0.3, 0.2}).fades);
  EXPECT_FALSE(same_shape(law_of(exponential, {0.3, 0.2}), law_of(worn, {0.3, 0.2})));
}

}  // namespace
}  // namespace freestand::dynamics
