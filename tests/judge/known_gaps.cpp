#include "judge/known_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/units.hpp"

namespace freestand::test {
namespace {

struct Gap {
  const char* name;
  std::function<bool(const JudgedCase&, const Judgement&)> holds;
};

const TruthEffect* find(const JudgedCase& c, const char* name) {
  const auto found = std::find_if(c.truth.effects.begin(), c.truth.effects.end(),
                                  [&](const TruthEffect& effect) { return effect.name == name; });
  return found == c.truth.effects.end() ? nullptr : &*found;
}

// When it last fell away before the disagreement, the floor hardly shook sideways: from where its push tips the
// block, which is where b g' = h |a|, to where g' = 0, passed no more than the stepper's finest step. A block that has begun to
// turn there hangs on a hinge, one that has not flies: which of them the stepper cannot see.
bool tips_and_flies_at_once(const JudgedCase& c, const Judgement& judgement) {
  const TruthEffect *shaking = find(c, "vertical_shaking"), *tilt = find(c, "floor_tilt");
  if (c.truth.model != TruthModel::rock || !shaking) return false;
  const double angle = tilt ? tilt->parameters.at("angle_rad") : 0, least_share_of_base = 0.5;
  const double lever = c.truth.height_m / (least_share_of_base * std::min(c.truth.left_m, c.truth.right_m));
  const double gravity = standard_gravity_mps2 * std::cos(angle), push = standard_gravity_mps2 * std::sin(angle);
  const auto& v = c.floor.vertical_mps2;
  const auto& a = c.floor.horizontal_mps2;
  bool at_once = false;
  for (std::size_t i = 0; i + 1 < v.size() && static_cast<double>(i) * c.floor.dt_s < judgement.parted_s; ++i) {
    if (!(v[i] > -gravity && v[i + 1] <= -gravity)) continue;
    const double rate = (v[i] - v[i + 1]) / c.floor.dt_s, share = (v[i] + gravity) / (v[i] - v[i + 1]);
    const double pushes = a[i] + share * (a[i + 1] - a[i]) + push;
    at_once = pushes != 0 && lever * std::abs(pushes) / rate < finest_step_s;
  }
  return at_once;
}

const std::vector<Gap>& gaps() {
  static const std::vector<Gap> all{
      {"a hinge that may not lift, on a floor that falls away: it turns first or flies first within one step",
       tips_and_flies_at_once},
  };
  return all;
}

}  // namespace

std::string known_gap(const JudgedCase& c, const Judgement& judgement) {
  if (judgement.samples == 0) return "";  // one of the integrators had no answer
  for (const Gap& gap : gaps())
    if (gap.holds(c, judgement)) return gap.name;
  return "";
}

}  // namespace freestand::test
