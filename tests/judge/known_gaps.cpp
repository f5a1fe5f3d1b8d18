#include "judge/known_gaps.hpp"

#include <algorithm>
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

bool falls_away(const JudgedCase& c) {
  return find(c, "vertical_shaking") &&
         *std::min_element(c.floor.vertical_mps2.begin(), c.floor.vertical_mps2.end()) < -standard_gravity_mps2;
}

const std::vector<Gap>& gaps() {
  static const std::vector<Gap> all{
      {"friction that grows as the pressure falls: a corner that is let go may stick, slip or leave the floor",
       [](const JudgedCase& c, const Judgement&) {
         const TruthEffect* pressure = find(c, "pressure_friction");
         return pressure && pressure->parameters.at("exponent") < 0 && falls_away(c);
       }},
      {"a wall at gap 0: a block that comes down beside it strikes floor and wall at one instant, in whatever order",
       [](const JudgedCase& c, const Judgement&) {
         const TruthEffect* wall = find(c, "wall_impact");
         return wall && wall->parameters.at("gap_m") == 0 && c.truth.model != TruthModel::slide;
       }},
      {"a foot under legs in a row of hops: after dozens of blows the stepper's doubt is smaller than its error",
       [](const JudgedCase& c, const Judgement&) {
         return find(c, "flexible_legs") && c.truth.model == TruthModel::slide_rock;
       }},
      {"a hinge that may not lift, on a floor that falls away: it turns first or flies first within one step",
       [](const JudgedCase& c, const Judgement&) { return c.truth.model == TruthModel::rock && falls_away(c); }},
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
