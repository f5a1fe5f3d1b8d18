#include "measurement/fit/outcome_misfit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Sums of the same terms in another order; no two scores or counts of other sets lie so near.
constexpr double same_score = 2e-6, same_count = 1e-3;

// Of each set the share of all that have as much.
VectorXd shares_with_as_much(const VectorXd& values, double same) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return values.unaryExpr([&](double value) {
    const auto less = std::lower_bound(sorted.begin(), sorted.end(), value - same) - sorted.begin();
    return 1 - static_cast<double>(less) / static_cast<double>(sorted.size());
  });
}

double scatter_about(const VectorXd& values, double about) {
  return std::sqrt((values.array() - about).square().mean());
}

}  // namespace

OutcomeMisfit weigh_outcomes(const VectorXd& scores, const VectorXd& beside, double fell) {
  const VectorXd of_score = shares_with_as_much(scores, same_score),
                 of_count = shares_with_as_much(beside.cwiseAbs(), same_count);
  const VectorXd smaller = of_score.cwiseMin(of_count);
  const VectorXd made = scores.tail(scores.size() - 1), made_beside = beside.tail(beside.size() - 1);
  std::vector<double> sorted(smaller.begin() + 1, smaller.end());
  const auto twentieth = sorted.begin() + static_cast<long>(chance_level * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), twentieth, sorted.end());
  constexpr double rounding = 1e-9;
  return {.p = static_cast<double>((smaller.array() <= smaller[0] + rounding).count()) /
               static_cast<double>(smaller.size()),
          .of_score = of_score[0],
          .of_count = of_count[0],
          .reached = *twentieth,
          .score = scores[0],
          .usual_score = made.mean(),
          .score_scatter = scatter_about(made, made.mean()),
          .fell = fell,
          .expected = fell - beside[0],
          .count_scatter = scatter_about(made_beside, 0)};
}

OutcomeMisfit outcome_misfit(const Values& probability, const std::vector<bool>& fell,
                             const std::vector<Values>& by_draw) {
  constexpr std::uint64_t stream = 61;
  VectorXd scores = VectorXd::Zero(1 + outcome_simulations), beside = scores;
  const auto n = static_cast<double>(std::max<std::size_t>(fell.size(), 1));
  for (std::size_t t = 0; t < fell.size(); ++t) {
    const double p = probability[t];
    const auto add = [&](std::uint64_t set, double y) {
      scores[static_cast<Index>(set)] += (p - y) * (p - y) / n;
      beside[static_cast<Index>(set)] += y - p;
    };
    add(0, fell[t] ? 1 : 0);
    for (std::uint64_t s = 0; s < outcome_simulations; ++s)
      add(1 + s, random::uniform(stream, s, t) < (by_draw.empty() ? p : by_draw[s % by_draw.size()][t]) ? 1 : 0);
  }
  return weigh_outcomes(scores, beside, static_cast<double>(std::count(fell.begin(), fell.end(), true)));
}

std::string what_chance_leaves(const OutcomeMisfit& misfit) {
  std::string said;
  if (misfit.surer())
    said = fmt::format(
        "it is surer than it may be: its Brier score is {:.4f} where chance alone would make {:.4f} +- {:.4f}",
        misfit.score, misfit.usual_score, misfit.score_scatter);
  if (misfit.other_count())
    said += fmt::format("{}it is too {}: {:.0f} tests overturned where it expects {:.1f} +- {:.1f}",
                        said.empty() ? "" : ", and ", misfit.expected > misfit.fell ? "unstable" : "stable",
                        misfit.fell, misfit.expected, misfit.count_scatter);
  return said;
}

}  // namespace freestand::measurement
