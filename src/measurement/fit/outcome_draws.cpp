#include "measurement/fit/outcome_draws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;

constexpr int middle_cells = 48, scatter_cells = 24;  // over all, and again over what is likely
constexpr float negligible = 12;  // in ln(likelihood): what lies below the most by more holds none of a thousand draws

// Density of the points of a box in a number, over that of the cube in which fits move.
double density_at(const Free& box, const Free& number, double x) {
  if (x < box.low || x > box.high) return 0;
  const double of_box = box.logarithmic ? 1 / (x * std::log(box.high / box.low)) : 1 / (box.high - box.low);
  const double of_cube =
      number.logarithmic ? 1 / (x * std::log(number.high / number.low)) : 1 / (number.high - number.low);
  return of_box / of_cube;
}

}  // namespace

OutcomeDraws::OutcomeDraws(const Bench& bench, const OutcomeTable& table, const TableFit& fit)
    : table_(table), middle_number_(placement_number(table.model)), scatter_number_(scatter_number(table.model)) {
  double missed = 0, expected = 0;
  for (std::size_t t = 0; t < table.tests.size(); ++t) {
    fell_.push_back(fell(bench.test(table.tests[t])));
    const double p = fit.probability[t], y = fell_.back() ? 1 : 0;
    missed += (p - y) * (p - y), expected += p * (1 - p);
  }
  if (expected > 0) excess_ = std::max(1.0, missed / expected);
  for (std::size_t k = 0; k < table.points.size(); ++k)
    if (std::isfinite(ln_room(table.points[k]))) points_.push_back(k);
  if (points_.empty()) points_.push_back(fit.point);
  weigh(all_cells());
  if (cells_.count() > 1) weigh(likely_cells(cells_));
}

double OutcomeDraws::ln_room(const TablePoint& point) const {
  if (table_.boxes.empty()) return point.plain ? -std::numeric_limits<double>::infinity() : 0;
  if (!point.of_box) return -std::numeric_limits<double>::infinity();
  double all = 0;
  for (const auto& box : table_.boxes) {
    double density = static_cast<double>(box.count);
    for (std::size_t i = 0; i < box.numbers.size(); ++i)
      density *= density_at(box.range[i], table_.model.free[box.numbers[i]], point.x[box.numbers[i]]);
    all += density;
  }
  return -std::log(all);
}

OutcomeDraws::Cells OutcomeDraws::all_cells() const {
  Cells cells;
  const auto spread = [](double low, double high, int count, double& first, double& step) {
    step = (high - low) / count;
    first = low + step / 2;
  };
  if (middle_number_ >= 0) {
    const Free& free = table_.model.free[static_cast<std::size_t>(middle_number_)];
    const double least = std::log(std::max(free.lower, 1e-9)), most = std::log(free.upper);
    cells.middles = middle_cells;
    spread(std::clamp(table_.places.first, least, most),
           std::clamp(table_.places.at(table_.places.count - 1), least, most), middle_cells, cells.middle,
           cells.middle_step);
  }
  if (scatter_number_ >= 0) {
    const Free& free = table_.model.free[static_cast<std::size_t>(scatter_number_)];
    cells.scatters = scatter_cells;
    const double widest = middle_number_ < 0 ? std::min(widest_scatter(table_.places), free.upper) : free.upper;
    spread(std::log(std::max(free.lower, 1e-4)), std::log(widest), scatter_cells, cells.scatter, cells.scatter_step);
  }
  return cells;
}

OutcomeDraws::Cells OutcomeDraws::likely_cells(const Cells& all) const {
  const float most = ln_likelihood_.maxCoeff();
  int first_middle = all.middles, last_middle = -1, first_scatter = all.scatters, last_scatter = -1;
  for (int cell = 0; cell < all.count(); ++cell)
    if (ln_likelihood_.row(cell).maxCoeff() > most - negligible) {
      const int m = cell % all.middles, s = cell / all.middles;
      first_middle = std::min(first_middle, m), last_middle = std::max(last_middle, m);
      first_scatter = std::min(first_scatter, s), last_scatter = std::max(last_scatter, s);
    }
  Cells cells = all;
  const auto within = [](int first, int last, int count, double& at, double& step) {
    if (count < 2) return;
    const double low = at + step * (std::max(first - 1, 0) - 0.5),
                 high = at + step * (std::min(last + 1, count - 1) + 0.5);
    step = (high - low) / count;
    at = low + step / 2;
  };
  within(first_middle, last_middle, cells.middles, cells.middle, cells.middle_step);
  within(first_scatter, last_scatter, cells.scatters, cells.scatter, cells.scatter_step);
  return cells;
}

void OutcomeDraws::weigh(const Cells& cells) {
  cells_ = cells;
  const auto places = static_cast<Index>(table_.places.count), tests = static_cast<Index>(table_.tests.size());
  const float least = 0.5F / static_cast<float>(places);  // half a place
  ln_likelihood_.resize(cells.count(), static_cast<Index>(points_.size()));
  MatrixXf shares(places, cells.count());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const TablePoint& point = table_.points[points_[k]];
    for (int cell = 0; cell < cells.count() && (k == 0 || middle_number_ < 0 || scatter_number_ < 0); ++cell) {
      const auto of = place_shares(
          table_.places, middle_number_ < 0 ? placement_middle(table_.model, point.x) : cells.middle_of(cell),
          std::max(scatter_number_ < 0 ? placement_scatter(table_.model, point.x) : std::exp(cells.scatter_of(cell)),
                   1e-9));
      for (Index i = 0; i < places; ++i) shares(i, cell) = static_cast<float>(of[static_cast<std::size_t>(i)]);
    }
    MatrixXf falls(tests, places);
    for (Index t = 0; t < tests; ++t)
      for (Index i = 0; i < places; ++i)
        falls(t, i) = static_cast<float>(point.outcomes[static_cast<std::size_t>(t)] >> i & 1);
    MatrixXf p = falls * shares;
    for (Index t = 0; t < tests; ++t)
      if (!fell_[static_cast<std::size_t>(t)]) p.row(t) = 1 - p.row(t).array();
    auto column = ln_likelihood_.col(static_cast<Index>(k));
    column = (p.cwiseMax(least).cwiseMin(1 - least).array().log().colwise().sum() / static_cast<float>(excess_)).transpose();
    column.array() += static_cast<float>(points_.size() > 1 ? ln_room(point) : 0);
    for (int cell = 0; cell < cells.count() && scatter_number_ >= 0; ++cell)
      column[cell] += static_cast<float>(cells.scatter_of(cell));
  }
}

std::vector<Values> OutcomeDraws::draw(std::size_t count) const {
  constexpr std::uint64_t stream = 1000;
  const float most = ln_likelihood_.maxCoeff();
  const Eigen::ArrayXXd weight = (ln_likelihood_.array() - most).exp().cast<double>();
  const double total = weight.sum();
  std::vector<Values> all;
  double passed = 0;
  for (Index k = 0; k < weight.cols(); ++k)
    for (Index cell = 0; cell < weight.rows(); ++cell) {
      passed += weight(cell, k) / total * static_cast<double>(count);
      // Systematic: each as often as its weight says, to one.
      while (all.size() < count && static_cast<double>(all.size()) + 0.5 < passed) {
        Values& x = all.emplace_back(table_.points[points_[static_cast<std::size_t>(k)]].x);
        const auto within = [&](int number, double at, double step, std::uint64_t which) {
          if (number < 0) return;
          const auto i = static_cast<std::size_t>(number);
          const Free& free = table_.model.free[i];
          x[i] = std::clamp(std::exp(at + step * (random::uniform(stream, all.size(), which) - 0.5)), free.lower,
                            free.upper);
        };
        within(middle_number_, cells_.middle_of(static_cast<int>(cell)), cells_.middle_step, 0);
        within(scatter_number_, cells_.scatter_of(static_cast<int>(cell)), cells_.scatter_step, 1);
      }
    }
  return all;
}

}  // namespace freestand::measurement
