#include "measurement/fit/history_misfit.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>

#include "base/random.hpp"
#include "measurement/fit/importance.hpp"
#include "measurement/fit/stated_numbers.hpp"

namespace freestand::measurement {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The tests tell first by how much friction scatters and by how much they disagree, all being as it is stated; with that, where what is
// stated is likeliest; and there all once more, until they disagree by no less than before: what was off made them disagree, too.
HistoryMisfit::HistoryMisfit(const Bench& bench, const ModelFit& fit, const Jobs& jobs)
    : bench_(bench), fit_(fit), judge_(bench, fit.model, fit.x, jobs, fanned_out) {
  constexpr int most_looks = 4;
  constexpr double much_less = 0.8;  // s of some twelve degrees of freedom is known to 1/sqrt(2 nu), a fifth
  look_from(with_stated_numbers(bench, fit), jobs);
  const Pull own = sum_of(of_first(pulls_, static_cast<Index>(fit.x.size())), tau2_);
  fall_as_stated_ = own.against.dot(own.gram.completeOrthogonalDecomposition().solve(own.against));
  for (int look = 0; look < most_looks && !place_.names.empty(); ++look) {
    const double before = dispersion_.s;
    const Judge scattered = tau2_ > 0 ? Judge(bench, fit.model, fit.x, jobs, fanned_out, friction_scatter()) : judge_;
    const AsStated place = as_stated(bench, scattered, fit, jobs, {}, weight());
    look_from(leaves_too_much(place) ? AsStated{.model = fit.model, .x = fit.x, .names = {}, .is_off = {}} : place,
              jobs);
    if (dispersion_.s > much_less * before) break;
  }
  reduce();
}

bool HistoryMisfit::leaves_too_much(const AsStated& place) const {
  return !(place.misfit < adequate * adequate * total(judge_.samples()));
}

// Of the squares of the deviations beside G: s^2, but no sensor is better than it is heard to be.
double HistoryMisfit::weight() const { return std::max(1.0, dispersion_.s * dispersion_.s); }

namespace {

// s^2 d^T d, of deviations in the cube in which fits move.
void add_deviations(const AsStated& place, double s2, Pull& sum) {
  const VectorXd off = deviations(place);
  sum.against.tail(off.size()) += s2 / deviation_in_cube * off;
  sum.gram.diagonal().tail(off.size()).array() += s2 / (deviation_in_cube * deviation_in_cube);
}

}  // namespace

// G is least in what is stated where it is for the numbers: by Schur's complement.
void HistoryMisfit::reduce() {
  Pull all = sum_of(pulls_, tau2_);
  add_deviations(place_, weight(), all);
  const auto p = static_cast<Index>(fit_.x.size()), q = all.gram.rows() - p;
  of_deviations_.compute(all.gram.bottomRightCorner(q, q));
  coupling_ = all.gram.bottomLeftCorner(q, p);
  against_deviations_ = all.against.tail(q);
  rates_ = all.gram.topLeftCorner(p, p) - coupling_.transpose() * of_deviations_.solve(coupling_);
  against_ = all.against.head(p) - coupling_.transpose() * of_deviations_.solve(against_deviations_);
  const MatrixXd inverse = all.gram.completeOrthogonalDecomposition().pseudoInverse();
  errors_ = (weight() * inverse.diagonal().tail(q)).cwiseSqrt() / deviation_in_cube;
  if (tau2_ == 0 && q == 0) return;
  for (std::size_t i = 0; i < tests_->count(); ++i) {
    const MatrixXd slopes = tests_->slopes(i, shifts_[i]);
    friction_.push_back(slopes.rightCols(1));
    stated_.push_back(judge_.weighed(i, slopes.middleCols(p, q)));
    friction_stated_.push_back(pulls_[i].gram.col(p + q).segment(p, q));
  }
}

VectorXd HistoryMisfit::from_place(const Values& numbers) const {
  VectorXd moved(static_cast<Index>(numbers.size()));
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Free& free = fit_.model.free[k];
    moved[static_cast<Index>(k)] = to_unit(free, numbers[k]) - to_unit(free, place_.x[k]);
  }
  return moved;
}

VectorXd HistoryMisfit::step(const MatrixXd& inverse) const { return -from_place(fit_.x) - inverse * against_; }

Values HistoryMisfit::stated_beside(const Values& numbers, std::uint64_t s) const {
  VectorXd chance(of_deviations_.rows());
  for (Index k = 0; k < chance.size(); ++k) chance[k] = random::standard_normal(38, s, static_cast<std::uint64_t>(k));
  const VectorXd change = std::sqrt(weight()) * of_deviations_.matrixU().solve(chance) -
                          of_deviations_.solve(against_deviations_ + coupling_ * from_place(numbers));
  Values stated;
  for (Index k = 0; k < change.size(); ++k) {
    const std::size_t at = numbers.size() + static_cast<std::size_t>(k);
    const Free& free = place_.model.free[at];
    stated.push_back(from_unit(free, to_unit(free, place_.x[at]) + change[k]));
  }
  return stated;
}

void HistoryMisfit::look_from(const AsStated& place, const Jobs& jobs) {
  place_ = place;
  tests_.emplace(bench_, judge_, place_);
  shifts_.clear();
  for (const Values& best :
       jobs("friction of each test", tests_->count(), [&](std::size_t i) { return Values{tests_->best(i)}; }))
    shifts_.push_back(best[0]);
  pulls_ = pulls_of(*tests_, shifts_, jobs);
  const auto own = [&] { return of_first(pulls_, static_cast<Index>(fit_.x.size())); };
  const double tau = measurement::friction_scatter(own());
  if (tau == 0) {
    shifts_.assign(tests_->count(), 0);
    pulls_ = pulls_of(*tests_, shifts_, jobs);
  }
  tau2_ = tau * tau;
  dispersion_ = dispersion_of(own(), tau2_);
}

double HistoryMisfit::operator()(const Values& numbers) const {
  if (numbers.empty()) return no_fit;
  double moved = 0;  // of ln mu
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (is_friction(fit_.model.free[k])) moved = std::log(numbers[k] / place_.x[k]);
  double G = weight() * deviations(place_).squaredNorm();
  VectorXd against_stated = weight() / deviation_in_cube * deviations(place_);
  for (std::size_t i = 0; i < tests_->count(); ++i) {
    // With the test's own friction held, and from there the shift that is likeliest, along its direction. What else the numbers do
    // the test's friction makes up for, by more than its direction holds for: so from there once more.
    double shift = tau2_ > 0 ? shifts_[i] - moved : 0, of_test = 0;
    for (int turn = 0; turn < 2; ++turn) {
      const Prediction at = tests_->at(i, numbers, shift);
      if (at.failed()) return no_fit;
      const VectorXd r = judge_.residual(i, at);
      MatrixXd columns = r;
      if (tau2_ > 0) {
        columns.conservativeResize(Eigen::NoChange, 2);
        columns.col(1) = friction_[i];
      }
      const VectorXd against = judge_.against(i, columns, r);
      of_test = against[0];
      if (tau2_ == 0) {
        if (!stated_.empty()) against_stated += stated_[i].transpose() * r;
        break;
      }
      const double ff = pulls_[i].gram.bottomRightCorner<1, 1>()(0),
                   fr = against[1] - shift * ff;  // at a shift of 0
      of_test += shift * shift * ff - 2 * shift * against[1] - tau2_ * fr * fr / (1 + tau2_ * ff);
      const double likeliest = -tau2_ * fr / (1 + tau2_ * ff);
      if (turn == 1) against_stated += stated_[i].transpose() * r + (likeliest - shift) * friction_stated_[i];
      shift = likeliest;
    }
    G += of_test;
  }
  return G - against_stated.dot(of_deviations_.solve(against_stated));
}

// One of several deviations is off where Student's t at its share of the level says so.
std::vector<double> HistoryMisfit::beyond_chance() const {
  const VectorXd off = deviations(place_);
  std::vector<double> beyond(place_.names.size(), 0.0);
  if (dispersion_.freedom < 1) return beyond;
  for (std::size_t k = 0; k < beyond.size(); ++k) {
    const double tail = chance_level / (2 * static_cast<double>(beyond.size())), of = off[static_cast<Index>(k)];
    if (std::abs(of) > gsl_cdf_tdist_Qinv(tail, dispersion_.freedom) * errors_[static_cast<Index>(k)]) beyond[k] = of;
  }
  return beyond;
}

bool HistoryMisfit::likeliest_as_stated() const {
  const std::vector<double> beyond = beyond_chance();
  const bool off = std::any_of(beyond.begin(), beyond.end(), [](double of) { return of != 0; });
  return off && fall_as_stated_ < told_lead * dispersion_.s * dispersion_.s;
}

std::string HistoryMisfit::stated_otherwise() const {
  const std::vector<double> beyond = beyond_chance();
  std::size_t most = 0;
  for (std::size_t k = 0; k < beyond.size(); ++k)
    if (std::abs(beyond[k]) > std::abs(beyond[most])) most = k;
  if (beyond.empty() || std::abs(beyond[most]) < 1) return "";
  return fault_sentence(place_.names[most], place_.x[fit_.x.size() + most]);
}

}  // namespace freestand::measurement
