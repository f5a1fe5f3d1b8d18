// The part of a friction law that packs read (dynamics/speed_law.hpp): its values, and no more operations than they take.
#include "dynamics/speed_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/speed_laws.hpp"

namespace freestand::dynamics {
namespace {

using test::exponential, test::rational;

SpeedLaw law_of(const Effect& effect, std::vector<double> values) {
  Specimen specimen;
  specimen.effects = {{&effect, std::move(values)}};
  return speed_law(Laws(specimen)).value();
}

TEST(SpeedLaw, IsTheLaw) {
  const SpeedLaw falls = law_of(exponential, {0.3, 0.2}), settles = law_of(rational, {0.3, 0.2});
  for (const double speed : {0.0, 1e-6, 0.03, 0.2, 1.7}) {
    EXPECT_NEAR(friction_factor(falls, speed), 1 - 0.3 * (1 - std::exp(-speed / 0.2)), 1e-15) << speed;
    EXPECT_NEAR(friction_factor(settles, speed), (0.2 + 0.7 * speed) / (0.2 + speed), 1e-15) << speed;
  }
}

TEST(SpeedLaw, CarriesNoOperationThatNobodyAsksFor) {
  EXPECT_EQ(law_of(exponential, {0.3, 0.2}).count, 3);  // exp(v w), between two of the form v x + s
  const SpeedLaw law = law_of(rational, {0.3, 0.2});
  std::vector<int> asked(static_cast<std::size_t>(law.count), 0);
  for (int i = 0; i < law.count; ++i)
    for (const int place : {law.nodes[i].a, law.nodes[i].b})
      if (place > 0) ++asked[static_cast<std::size_t>(place) - 1];
  for (int i = 0; i + 1 < law.count; ++i) EXPECT_GT(asked[static_cast<std::size_t>(i)], 0) << i;
}

TEST(SpeedLaw, HasAShapeOfItsOwn) {
  EXPECT_TRUE(same_shape(law_of(exponential, {0.3, 0.2}), law_of(exponential, {-0.1, 0.5})));
  EXPECT_FALSE(same_shape(law_of(exponential, {0.3, 0.2}), law_of(rational, {0.3, 0.2})));
  EXPECT_TRUE(law_of(exponential, {0.3, 0.2}).fades);
  EXPECT_FALSE(law_of(rational, {0.3, 0.2}).fades);
}

}  // namespace
}  // namespace freestand::dynamics
