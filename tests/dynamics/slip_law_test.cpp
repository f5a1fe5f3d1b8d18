// The part of a friction law that packs read (dynamics/slip_law.hpp): its values, and no more operations than they take.
#include "dynamics/slip_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random_cases.hpp"
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

const Effect itself{.name = "itself", .friction = [](const At& at, const auto&) { return at.path; }};
const Effect nothing{.name = "nothing", .friction = [](const At& at, const auto&) { return at.path / at.path; }};
const Effect steep_to_the_left{.name = "steep_to_the_left", .friction = [](const At& at, const auto& p) {
                                 return 0.5 + 0.5 * exp(-at.speed * (1.0 - 0.98 * at.sigma) / p[0]);
                               }};

TEST(SlipLaw, IsNoneWithoutAnOperation) {
  Specimen specimen;
  specimen.effects = {{&itself, {}}};
  EXPECT_FALSE(slip_law(Laws(specimen)));
}

TEST(SlipLaw, IsAsSteepAsInItsSteeperDirection) {
  const SlipLaw law = law_of(steep_to_the_left, {0.01});
  EXPECT_NEAR(steepest_exponent(law, 0.1, 0.01), 0.1 * 1.98 / 0.01, 1e-9);
}

// Friction that is no number is an outcome, in packs as alone.
TEST(SlipLaw, ThatIsNoNumberIsNotFinite) {
  test::RandomCase one = test::random_case({.one_model = 0}, 3);
  one.specimen.model = Model::slide_rock;
  one.specimen.impact.law = ImpactLaw::housner;
  one.specimen.effects = {{&nothing, {}}};
  Response packed;
  respond_batch({&one.specimen, 1}, {&one.shaking, 1}, {}, {&packed, 1});
  EXPECT_EQ(packed.outcome, respond(one.specimen, one.shaking).outcome);
  EXPECT_EQ(packed.outcome, Outcome::not_finite);
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
