// The friction that the laws of a model amount to, against what is recovered from histories of a block that has them.
#include "measurement/predict/sliding_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/tell/recover.hpp"

namespace freestand::measurement {
namespace {

using dynamics::At;
using dynamics::Effect;
using dynamics::Parameters;

struct Case {
  const Effect* effect;
  Parameters parameters;
  std::vector<const char*> follows;  // the variables over which its law is to be drawn
};

Specimen cabinet(const Case& c) {
  Specimen s;
  s.block = Block::rectangular(0.9, 0.5, 100);
  s.friction = {0.2, 0.2};
  s.model = Model::slide;
  s.effects = {{c.effect, c.parameters}};
  return s;
}

// With a vertical channel, so that all variables vary.
Dataset measured(const Specimen& specimen) {
  Dataset data = test::made_dataset(specimen);
  std::uint64_t seed = 0;
  for (Test& t : data.tests) {
    std::vector<double> horizontal, vertical;
    for (std::size_t i = 0; i <= 800; ++i) {
      const double time = 0.005 * static_cast<double>(i);
      horizontal.push_back(horizontal_acceleration(t.shaking(), time));
      vertical.push_back(2.5 * std::sin(7 * time));
    }
    t.motion = piecewise_linear("both", 0.005, horizontal, vertical);
    t.slip_m = test::made_test(t.id, specimen, t.motion, ++seed).slip_m;
  }
  return data;
}

ModelSpec model(const Case& c) {
  ModelSpec m;
  m.mu_k.value = 0.2;
  EffectTerm term{.effect = c.effect, .parameters = {}};
  for (const double p : c.parameters) term.parameters.push_back({.value = p});
  m.effects = {term};
  return m;
}

// Of no catalogue: the law must come from the declaration alone.
const Effect& ripples() {
  static const Effect effect = [] {
    Effect e;
    e.name = "ripples";
    e.parameters = {{"height", "1", "", 0, 1}, {"length_m", "m", "", 0, 1}};
    e.friction = [](const At& at, const Parameters& p) { return 1.0 + p[0] * sin(at.u / p[1]); };
    return e;
  }();
  return effect;
}

std::vector<Case> cases() {
  const auto find = [](const char* name) { return effects::find(name); };
  return {{find("rate_weakening"), {0.5, 0.15}, {"speed_mps"}},
          {find("rate_strengthening"), {0.6, 0.3}, {"speed_mps"}},
          {find("viscous_drag"), {1.5}, {"speed_mps"}},
          {find("friction_wear"), {0.5, 0.1}, {"path_m"}},
          {find("directional_friction"), {0.25}, {"direction"}},
          {find("floor_tilt"), {0.03}, {"direction"}},
          {find("centering_spring"), {0.8}, {"position_m", "direction"}},
          {find("slack_tether"), {-0.02, 1.0, 0.2}, {"position_m"}},
          {find("vertical_shaking"), {1.0}, {}},
          {find("static_friction"), {1.4}, {}},
          {&ripples(), {0.4, 0.02}, {"position_m"}}};
}

// The mean of what is recovered in a bin has its band of 95 %; in none of so many bins may it be twice as far off, plus
// what smoothing takes off a law that bends within a window.
TEST(SlidingLaw, IsWhatIsRecoveredFromABlockThatHasIt) {
  for (const Case& c : cases()) {
    const Dataset data = measured(cabinet(c));
    const Recovered r = recover(Bench(data, 0), 0.2, model(c), {});
    ASSERT_EQ(r.tables.size(), 6U) << c.effect->name;
    for (const RecoveredTable& t : r.tables)
      for (std::size_t b = 0; b < t.mu.size(); ++b) {
        if (t.count[b] < 5) continue;
        const double half = 0.5 * (t.mu_upper[b] - t.mu_lower[b]);
        EXPECT_NEAR(t.law[b], t.mu[b], 2 * half + 0.008)
            << c.effect->name << " over " << t.variable << " at " << t.centre[b];
      }
  }
}

TEST(SlidingLaw, FollowsTheVariablesThatItsEffectLooksAt) {
  for (const Case& c : cases()) {
    const Dataset data = measured(cabinet(c));
    const Recovered r = recover(Bench(data, 0), 0.2, model(c), {});
    for (const char* wanted : c.follows)
      for (const RecoveredTable& t : r.tables)
        if (t.variable == wanted) {
          EXPECT_TRUE(t.law_follows) << c.effect->name << " over " << wanted;
        }
    for (const RecoveredTable& t : r.tables)
      if (t.variable == "time_s" || c.follows.empty()) {
        EXPECT_FALSE(t.law_follows) << c.effect->name << " over " << t.variable;
      }
  }
}

// What moves inside, and legs, push the block by more than a history of its base shows.
TEST(SlidingLaw, IsNotKnownOfStatesAndLegs) {
  for (const auto& [name, parameters] :
       {std::pair<const char*, Parameters>{"moving_contents", {0.3, 1.0, 0.05}}, {"flexible_legs", {3.0, 0.05}}}) {
    Specimen s = cabinet({effects::find(name), parameters, {}});
    EXPECT_TRUE(std::isnan(SlidingLaw(s).friction({.speed_mps = 0.2}))) << name;
  }
}

}  // namespace
}  // namespace freestand::measurement
