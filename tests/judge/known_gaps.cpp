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
      {"pressure_friction where the normal force jumps or vanishes: on a corner, at landings",
       [](const JudgedCase& c, const Judgement&) { return has(c, {"pressure_friction"}); }},
      {"legs under a block that rocks: 1e-6 m",
       [](const JudgedCase& c, const Judgement&) { return has(c, {"flexible_legs"}); }},
      {"contents in the reference: 1e-6 m",
       [](const JudgedCase& c, const Judgement&) { return has(c, {"moving_contents"}); }},
      {"walls at gap 0, in the air and in the reference",
       [](const JudgedCase& c, const Judgement&) { return has(c, {"wall_impact"}); }},
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
