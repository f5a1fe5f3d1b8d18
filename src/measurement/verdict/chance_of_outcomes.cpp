#include "measurement/verdict/chance_of_outcomes.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

// Mean scores of the fits of a model to each set; and of tests left out.
VectorXf scores(const Bench& bench, const TabulatedFit& model, const MatrixXf& y) {
  return TableSearch(bench, model.table).least_squares(y) / static_cast<float>(y.rows());
}
VectorXf scores_left_out(const Bench& bench, const TabulatedFit& model, const MatrixXf& y) {
  return TableSearch(bench, model.table).left_out_squares(y) / static_cast<float>(y.rows());
}

std::function<double(std::uint64_t)> in_simulations(const VectorXf& values) {
  return [&values](std::uint64_t s) { return static_cast<double>(values[static_cast<Index>(1 + s)]); };
}

VectorXf leads(const Bench& bench, const TabulatedFit& best, const TabulatedFit& rival, const MatrixXf& y) {
  return scores(bench, rival, y) - scores(bench, best, y);
}

}  // namespace

std::vector<VectorXf> gains_of_outcomes(const Bench& bench, const TabulatedFit& base,
                                        const std::vector<const TabulatedFit*>& tried, const Jobs& jobs) {
  const MatrixXf y = outcome_sets(bench, base, 24, chance_simulations);
  const VectorXf without = scores_left_out(bench, base, y);
  const auto answers = jobs("what effects gain in outcomes from the base", tried.size(), [&](std::size_t i) {
    const VectorXf with = scores_left_out(bench, *tried[i], y);
    return Values(with.begin(), with.end());
  });
  std::vector<VectorXf> gains;
  for (const Values& with : answers)
    gains.emplace_back(without - Eigen::Map<const Eigen::VectorXd>(with.data(), without.size()).cast<float>());
  return gains;
}

Chance chance_of_gain_of_outcomes(const std::vector<VectorXf>& gains) {
  VectorXf largest = gains.front();
  for (const VectorXf& gain : gains) largest = largest.cwiseMax(gain);
  Chance chance{.question = help_question, .about = {}, .observed = largest[0]};
  weigh(chance, in_simulations(largest));
  return chance;
}

Chance chance_of_lead_of_outcomes(const Bench& bench, const TabulatedFit& best, const TabulatedFit& rival,
                                  const Jobs& jobs) {
  const auto answers = jobs("whether the lead is chance", 2, [&](std::size_t i) {
    const MatrixXf y = outcome_sets(bench, i == 0 ? rival : best, 25 + i, chance_simulations);
    const VectorXf of = leads(bench, best, rival, y);
    return Values(of.begin(), of.end());
  });
  Chance chance{.question = lead_question, .about = {}, .observed = answers[0][0]};
  weigh(chance, [&](std::uint64_t s) { return answers[0][1 + s]; });
  weigh_power(chance, [&](std::uint64_t s) { return answers[1][1 + s]; });
  return chance;
}

Chance chance_of_misfit(const OutcomeMisfit& misfit) {
  return {.question = misfit_question,
          .about = {},
          .observed = 1 - misfit.smaller(),
          .usual = 1 - misfit.reached,
          .p = misfit.p,
          .simulations = static_cast<int>(outcome_simulations)};
}

}  // namespace freestand::measurement
