#include "judge/known_gaps.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace freestand::test {
namespace {

struct Gap {
  const char* name;
  std::function<bool(const JudgedCase&, const Judgement&)> holds;
};

bool has(const JudgedCase& c, std::initializer_list<const char*> names) {
  return std::any_of(c.truth.effects.begin(), c.truth.effects.end(), [&](const TruthEffect& effect) {
    return std::find(names.begin(), names.end(), effect.name) != names.end();
  });
}

const std::vector<Gap>& gaps() {
  static const std::vector<Gap> all{
      {"walls: the upper edge, flight, gap 0, both sides",
       [](const JudgedCase& c, const Judgement&) { return has(c, {"wall_impact"}); }},
      {"legs under friction that follows the speed: the speed of the block instead of the foot's",
       [](const JudgedCase& c, const Judgement&) {
         return has(c, {"flexible_legs"}) && has(c, {"rate_weakening", "rate_strengthening"});
       }},
      {"laws in flight and at its landing",
       [](const JudgedCase& c, const Judgement& j) {
         return (j.deeds & flew) && has(c, {"moving_contents", "rate_weakening", "rate_strengthening", "flexible_legs",
                                            "pressure_friction", "slack_tether", "chain"});
       }},
      {"pressure_friction where the normal force vanishes",
       [](const JudgedCase& c, const Judgement&) {
         return has(c, {"pressure_friction"}) && has(c, {"vertical_shaking"});
       }},
      {"landings that tip",
       [](const JudgedCase& c, const Judgement& j) {
         return (j.deeds & flew) && c.truth.mu_s * c.truth.height_m > 0.8 * std::min(c.truth.left_m, c.truth.right_m);
       }},
  };
  return all;
}

}  // namespace

std::string known_gap(const JudgedCase& c, const Judgement& judgement) {
  for (const Gap& gap : gaps())
    if (gap.holds(c, judgement)) return gap.name;
  return "";
}

}  // namespace freestand::test
