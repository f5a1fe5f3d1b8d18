#include "measurement/tell/findings_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "base/digits.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

double left(const std::vector<const TestComparison*>& tests) {
  double square = 0;
  for (const TestComparison* t : tests) square += t->explained * t->explained / static_cast<double>(tests.size());
  return std::sqrt(square);
}

}  // namespace

std::string told_with_own_friction(const std::vector<const TestComparison*>& tests, Role role) {
  const auto [least, most] =
      std::ranges::minmax(tests | std::views::transform([](const TestComparison* t) { return *t->own_friction; }));
  return fmt::format(
      "; with a friction of its own in each test, {:.3g} to {:.3g} times that of all, the model leaves {} where noise "
      "explains 1{}",
      least, most, three_digits(left(tests)),
      left(tests) < adequate      ? ": friction differs from test to test, and little else is left to explain"
      : role == Role::calibration ? ": diagnose asks what is missing"
                                  : "");
}

bool only_friction_differs(const std::vector<TestComparison>& all) {
  std::vector<const TestComparison*> tests;
  for (const TestComparison& t : all)
    if (t.own_friction && !(t.expected > drowned)) tests.push_back(&t);
  return !tests.empty() && left(tests) < adequate;
}

}  // namespace freestand::measurement
