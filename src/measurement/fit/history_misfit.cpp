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
  const Pull own = sum_of(of_numbers(), tau2_);
  fall_as_stated_ = own.against.dot(own.gram.completeOrthogonalDecomposition().solve(own.against));
  for (int look = 0; look < most_looks && !place_.names.empty(); ++look) {
    const double before = dispersion_.s;
    const ModelFit own = with_friction_of_tests();
    const Judge scattered = tau2_ > 0 ? Judge(bench, own.model, own.x, jobs, fanned_out, friction_scatter()) : judge_;
    AsStated place = as_stated(bench, scattered, own, jobs, {}, weight());
    place.model.friction_of_test.clear();
    leaves_too_much_ = is_too_much(place.misfit);
    look_from(leaves_too_much_ ? AsStated{.model = fit.model, .x = fit.x, .names = {}, .is_off = {}} : place, jobs);
    if (dispersion_.s > much_less * before) break;
  }
  // s^2 multiplies all of C, and friction scatters no more for what tests disagree by in other numbers.
  if (const double s = dispersion_.s; tau2_ > 0 && !leaves_too_much_ && disagree_beyond_chance(dispersion_))
    allow(scatter_ / s, jobs);
  reduce();
  if (place_.names.empty() && !leaves_too_much_) leaves_too_much_ = is_too_much((*this)(fit.x));
}

// Each as it is where the tests were looked at.
ModelFit HistoryMisfit::with_friction_of_tests() const {
  ModelFit own = fit_;
  const auto tests = tests_of(bench_.data(), Role::calibration);
  for (std::size_t i = 0; tau2_ > 0 && i < tests.size(); ++i)
    own.model.friction_of_test[bench_.test(tests[i]).id] = {.value = std::exp(shifts_[i])};
  return own;
}

bool HistoryMisfit::is_too_much(double misfit) const {
  return !(misfit < adequate * adequate * total(judge_.samples()));
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
  const MatrixXd coupling = all.gram.bottomLeftCorner(q, p);
  rates_ = all.gram.topLeftCorner(p, p) - coupling.transpose() * of_deviations_.solve(coupling);
  against_ = all.against.head(p) - coupling.transpose() * of_deviations_.solve(all.against.tail(q));
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

VectorXd HistoryMisfit::step(const MatrixXd& inverse) const {
  VectorXd to_place(static_cast<Index>(fit_.x.size()));
  for (std::size_t k = 0; k < fit_.x.size(); ++k) {
    const Free& free = fit_.model.free[k];
    to_place[static_cast<Index>(k)] = to_unit(free, place_.x[k]) - to_unit(free, fit_.x[k]);
  }
  return to_place - inverse * against_;
}

Values HistoryMisfit::changed(Values x, const VectorXd& by) const {
  for (Index k = 0; k < by.size(); ++k) {
    const std::size_t at = fit_.x.size() + static_cast<std::size_t>(k);
    const Free& free = place_.model.free[at];
    x[at] = from_unit(free, to_unit(free, x[at]) + by[k]);
  }
  return x;
}

Values HistoryMisfit::stated_beside(const Values& numbers, std::uint64_t s) const {
  VectorXd chance(of_deviations_.rows());
  for (Index k = 0; k < chance.size(); ++k) chance[k] = random::standard_normal(38, s, static_cast<std::uint64_t>(k));
  const Values x = changed(likeliest_beside(numbers).x, std::sqrt(weight()) * of_deviations_.matrixU().solve(chance));
  return {x.begin() + static_cast<std::ptrdiff_t>(numbers.size()), x.end()};
}

void HistoryMisfit::look_from(const AsStated& place, const Jobs& jobs) {
  place_ = place;
  tests_.emplace(bench_, judge_, place_);
  shifts_.clear();
  for (const Values& best :
       jobs("friction of each test", tests_->count(), [&](std::size_t i) { return Values{tests_->best(i)}; }))
    shifts_.push_back(best[0]);
  pulls_ = pulls_of(*tests_, shifts_, jobs);
  scatter_ = measurement::friction_scatter(of_numbers());
  allow(scatter_, jobs);
}

std::vector<Pull> HistoryMisfit::of_numbers() const { return of_first(pulls_, static_cast<Index>(fit_.x.size())); }

void HistoryMisfit::allow(double tau, const Jobs& jobs) {
  if (tau == 0) {
    shifts_.assign(tests_->count(), 0);
    pulls_ = pulls_of(*tests_, shifts_, jobs);
  }
  tau2_ = tau * tau;
  // About all numbers that were fitted: the more of them, the less tests disagree about each.
  dispersion_ = dispersion_of(place_.is_off.empty() ? of_numbers() : pulls_, tau2_);
  friction_freedom_ = std::max(1.0, freedom_of_friction_scatter(of_numbers(), tau2_));
}

double HistoryMisfit::likeliest_shift(std::size_t i, double against_friction) const {
  return tau2_ > 0 ? -tau2_ * against_friction / (1 + tau2_ * pulls_[i].gram.bottomRightCorner<1, 1>()(0)) : 0.0;
}

void HistoryMisfit::add(Look& at, std::size_t i, const Prediction& model) const {
  if (model.failed()) {
    at.G += no_fit;
    return;
  }
  const VectorXd r = judge_.residual(i, model);
  MatrixXd columns = r;
  if (tau2_ > 0) {
    columns.conservativeResize(Eigen::NoChange, 2);
    columns.col(1) = friction_[i];
  }
  const VectorXd against = judge_.against(i, columns, r);
  at.G += against[0];
  if (!stated_.empty()) at.against_stated += stated_[i].transpose() * r;
  if (tau2_ == 0) return;
  const double ff = pulls_[i].gram.bottomRightCorner<1, 1>()(0), shift = at.shifts[i],
               at_none = against[1] - shift * ff, likeliest = likeliest_shift(i, at_none);
  at.G += shift * shift * ff - 2 * shift * against[1] + likeliest * at_none;
  at.against_stated += (likeliest - shift) * friction_stated_[i];
  at.against_friction[i] = at_none;
}

void HistoryMisfit::look(std::vector<Look>& looks) const {
  const std::size_t tests = tests_->count();
  std::vector<Asked> asked;
  for (Look& at : looks) {
    const VectorXd off = deviations(place_, at.x);
    at.G = weight() * off.squaredNorm();
    at.against_stated = weight() / deviation_in_cube * off;
    at.against_friction.assign(tests, 0.0);
    for (std::size_t i = 0; i < tests; ++i) asked.push_back(tests_->asked(i, at.x, at.shifts[i]));
  }
  predict(asked, [&](std::size_t k, const Prediction& model) { add(looks[k / tests], k % tests, model); });
}

HistoryMisfit::Look HistoryMisfit::next(const Look& at) const {
  const VectorXd change = to_likeliest(at);
  Look there{.x = changed(at.x, change), .shifts = at.shifts};
  for (std::size_t i = 0; tau2_ > 0 && i < there.shifts.size(); ++i)
    there.shifts[i] = likeliest_shift(i, at.against_friction[i] + friction_stated_[i].dot(change));
  return there;
}

// What is stated bends long rocking within what it is open by, and what else the numbers do a test's friction makes up for, by more than
// its direction holds for. So from where the derivatives are taken or from where all is as stated, whichever misses less, and from where
// that is likeliest once more.
HistoryMisfit::Likeliest HistoryMisfit::likeliest_beside(const Values& numbers) const {
  Look placed{.x = numbers, .shifts = std::vector<double>(tests_->count(), 0.0)}, stated = placed;
  double moved = 0;  // of ln mu
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (is_friction(fit_.model.free[k])) moved = std::log(numbers[k] / place_.x[k]);
  for (std::size_t i = 0; tau2_ > 0 && i < shifts_.size(); ++i)
    placed.shifts[i] = stated.shifts[i] = shifts_[i] - moved;
  for (std::size_t k = numbers.size(); k < place_.x.size(); ++k) {
    placed.x.push_back(place_.x[k]);
    stated.x.push_back(from_unit(place_.model.free[k], stated_in_cube));
  }
  std::vector<Look> first = {placed};
  if (!place_.names.empty()) first.push_back(stated);
  look(first);
  const Look& from = first.back().G < first.front().G ? first.back() : first.front();
  if ((place_.names.empty() && tau2_ == 0) || from.G >= no_fit) return {from.G, from.x};
  std::vector<Look> again = {next(from)};
  look(again);
  const VectorXd change = to_likeliest(again[0]);
  const double least = again[0].G + again[0].against_stated.dot(change);
  return least < from.G ? Likeliest{least, changed(again[0].x, change)} : Likeliest{from.G, from.x};
}

double HistoryMisfit::operator()(const Values& numbers) const {
  return numbers.empty() ? no_fit : likeliest_beside(numbers).G;
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
  const std::size_t at = fit_.x.size() + most;
  return fault_sentence(place_.names[most], place_.x[at]) + at_its_limit(place_.model.free[at], place_.x[at]);
}

}  // namespace freestand::measurement
