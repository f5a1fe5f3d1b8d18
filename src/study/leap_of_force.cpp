// A force that leaps where the block stops is friction by another name: whether a block stands is decided by what may push it
// either way, and of that the equations know friction alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "formula/formula.hpp"
#include "study/formula_places.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

struct Leap {
  double below, above;  // forces at v = -0 and +0 [m/s2]
  // More than round-off: half of the figures.
  bool any() const { return std::abs(above - below) > 1e-8 * (std::abs(above) + std::abs(below)); }
};

Leap leap_at(const formula::Formula& force, Place at, double mu, const std::vector<double>& numbers) {
  constexpr double slow = 1e-300;  // [m/s]: any power of it that a law may have is next to nothing
  const auto moving = [&](int way) {
    at[v] = way * slow;
    at[sigma] = way;
    at[speed] = slow;
    return force.value(at, mu, numbers);
  };
  return {moving(-1), moving(1)};
}

// With the parameters at the ends of their ranges and within.
std::optional<Leap> leap_anywhere(const formula::Formula& force, const EffectPart& part) {
  for (const double quantile : {0.5, 0.05, 0.95, 0.3}) {
    std::vector<double> numbers;
    for (const Quantity& q : part.parameters) numbers.push_back(sampling::quantile(q.value, quantile));
    for (Place at : places()) {
      at[path] = std::max(at[path], std::abs(at[u]));
      if (const Leap leap = leap_at(force, at, 0.3, numbers); leap.any()) return leap;
    }
  }
  return {};
}

}  // namespace

std::string leap_of_force(const EffectPart& part, const std::vector<std::string>& parameters) {
  if (part.force.empty()) return "";
  const std::optional<Leap> leap = leap_anywhere(formula::Formula(part.force, parameters), part);
  if (!leap) return "";
  const auto& [below, above] = *leap;
  const std::string instead = above < below
                                  ? fmt::format("write it as friction: \"mu + {:.4g}/(g*normal)\"", (below - above) / 2)
                                  : "let it pass through v = 0 without a leap";
  return fmt::format(
      "force of effect {} leaps from {:.4g} to {:.4g} m/s2 where the block stops and turns round (there only friction "
      "may, "
      "which can hold it): {}",
      part.name, below, above, instead);
}

}  // namespace freestand::study
