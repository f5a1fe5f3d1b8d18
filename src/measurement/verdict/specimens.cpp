#include "measurement/verdict/specimens.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "measurement/fit/odd_one.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

struct OneSpecimen {
  Dimensions dimensions;
  std::vector<std::string> tests;
  double sum = 0, squares = 0;  // of the logarithms
  double n() const { return static_cast<double>(tests.size()); }
  double mean() const { return sum / n(); }
};

// ln: of the calibration tests, in their order.
std::vector<OneSpecimen> specimens_of(const Bench& bench, const std::vector<double>& ln) {
  std::vector<OneSpecimen> all;
  const auto tests = tests_of(bench.data(), Role::calibration);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const Test& test = bench.test(tests[k]);
    auto at = std::find_if(all.begin(), all.end(), [&](const OneSpecimen& s) { return s.dimensions == test.specimen; });
    if (at == all.end()) at = all.insert(at, {.dimensions = test.specimen, .tests = {}});
    at->tests.push_back(test.id);
    at->sum += ln[k];
    at->squares += ln[k] * ln[k];
  }
  return all;
}

}  // namespace

std::string several_specimens(const Bench& bench) {
  const auto all = specimens_of(bench, std::vector<double>(bench.size(), 0));
  if (all.size() < 2) return {};
  std::vector<std::string> told;
  for (const OneSpecimen& s : all) told.push_back(fmt::format("{}", fmt::join(s.tests, ", ")));
  return fmt::format(
      "the tests are of {} specimens ({}), of which one may have an effect that another has not: hold the model "
      "against one "
      "specimen at a time",
      all.size(), fmt::join(told, "; "));
}

std::string friction_of_specimens(const Bench& bench, const OwnNumbers& friction) {
  std::vector<double> ln;
  double sum = 0;
  for (const double factor : friction.of_tests) sum += ln.emplace_back(std::log(factor));
  const std::vector<OneSpecimen> all = specimens_of(bench, ln);
  const auto n = static_cast<double>(ln.size()), groups = static_cast<double>(all.size());
  if (groups < 2 || n <= groups) return {};
  double between = 0, within = 0;
  for (const OneSpecimen& s : all) {
    between += s.n() * std::pow(s.mean() - sum / n, 2);
    within += s.squares - s.n() * std::pow(s.mean(), 2);
  }
  between /= groups - 1;
  within = std::max(within, 0.0) / (n - groups);
  if (within > 0 && gsl_cdf_fdist_Q(between / within, groups - 1, n - groups) > chance_level) return {};
  std::vector<std::string> told;
  for (const OneSpecimen& s : all)
    told.push_back(fmt::format("{:.3g} in {}", std::exp(s.mean() - all[0].mean()), fmt::join(s.tests, ", ")));
  return fmt::format(
      "it differs between the specimens, whose dimensions are not the same ({}, over that of the first), and within "
      "them by {:.2g} %: "
      "hold the model against one specimen at a time",
      fmt::join(told, "; "), 100 * std::sqrt(within));
}

std::optional<TestOfOtherFriction> test_of_other_friction(const Bench& bench, const OwnNumbers& friction) {
  std::vector<double> ln;
  for (const double factor : friction.of_tests) ln.push_back(std::log(factor));
  const auto odd = odd_one(ln);
  if (!odd) return {};
  return TestOfOtherFriction{.id = bench.test(tests_of(bench.data(), Role::calibration)[odd->which]).id,
                             .times_the_others = std::exp(odd->off),
                             .scatter_of_others = odd->scatter_of_others,
                             .p = odd->p,
                             .tests = ln.size()};
}

std::string told(const TestOfOtherFriction& odd) {
  return fmt::format(
      "the friction of {} is {:.2g} times that of the others, which differ by {:.2g} %, further off than chance puts "
      "one "
      "of {} (p {:.2g}): is it of another object, or on another floor?",
      odd.id, odd.times_the_others, 100 * odd.scatter_of_others, odd.tests, odd.p);
}

}  // namespace freestand::measurement
