// Forces along the floor that the kernels of whole blocks take (dynamics/linear_pull.hpp): their stiffness and drag, and no others.
#include "dynamics/linear_pull.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/slip_laws.hpp"

namespace freestand::dynamics {
namespace {

using Hook = Value (*)(const At&, const Parameters&);

std::optional<LinearPull> pull_of(Hook force, Hook friction = nullptr) {
  Effect effect{.name = "pull", .force = force};
  if (friction) effect.friction = friction;
  Specimen specimen;
  specimen.effects = {{&effect, {}}};
  return linear_pull(Laws(specimen));
}

TEST(LinearPull, IsStiffnessAndDrag) {
  const auto spring = pull_of([](const At& at, const Parameters&) { return -3.0 * at.u; });
  ASSERT_TRUE(spring);
  EXPECT_EQ(spring->stiffness, 3);
  EXPECT_EQ(spring->drag, 0);
  const auto both = pull_of([](const At& at, const Parameters&) { return 2.0 * (at.v - 4.0 * at.u) - 5.0 * at.v; });
  ASSERT_TRUE(both);
  EXPECT_EQ(both->stiffness, 8);
  EXPECT_EQ(both->drag, 3);
}

TEST(LinearPull, OfSeveralEffectsIsTheirSum) {
  Specimen specimen;
  specimen.effects = {{&test::pulled, {2, 0.5}}, {&test::pulled, {1, 0.25}}};
  const auto sum = linear_pull(Laws(specimen));
  ASSERT_TRUE(sum);
  EXPECT_EQ(sum->stiffness, 3);
  EXPECT_EQ(sum->drag, 0.75);
}

TEST(LinearPull, NothingElseIsOne) {
  EXPECT_FALSE(pull_of([](const At& at, const Parameters&) { return -at.u * abs(at.u); }));
  EXPECT_FALSE(pull_of([](const At& at, const Parameters&) { return -(at.v * at.v); }));
  EXPECT_FALSE(pull_of([](const At& at, const Parameters&) { return -at.u + 0.1; })) << "an offset";
  EXPECT_FALSE(pull_of([](const At& at, const Parameters&) { return 2.0 * at.u; })) << "it pushes away";
  EXPECT_FALSE(pull_of([](const At& at, const Parameters&) { return -at.theta; }));
  EXPECT_FALSE(pull_of([](const At& at, const Parameters&) { return -at.u; },
                       [](const At& at, const Parameters&) { return 1.0 - 0.1 * at.speed; }))
      << "with a friction";
  EXPECT_FALSE(linear_pull(Laws(Specimen{}))) << "no force";
}

}  // namespace
}  // namespace freestand::dynamics
