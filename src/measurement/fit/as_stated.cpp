#include "measurement/fit/as_stated.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>

#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/slopes.hpp"
#include "measurement/fit/stated_numbers.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index count(const AsStated& s) { return static_cast<Index>(s.names.size()); }

double misfit(const Judge& judge, const AsStated& s) {
  double sum = s.weight * deviations(s).squaredNorm();
  for (const double of_test : misfits(judge, all_of(judge), s.model, s.x)) sum += of_test;
  return sum;
}

struct Equations {
  MatrixXd gram;
  VectorXd against;
};

Equations equations(const Bench& bench, const Judge& judge, const AsStated& s, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto q = static_cast<Index>(s.x.size());
  const auto answers = jobs("what is stated", tests.size(), [&](std::size_t i) {
    const Test& test = bench.test(tests[i]);
    const Prediction at = predict(s.model, test, s.x);
    const MatrixXd columns = slopes_as_stated(s, judge, test, i, at);
    const MatrixXd gram = judge.products(i, columns).gram;
    const VectorXd against = judge.against(i, columns, -judge.residual(i, at));
    Values all(gram.data(), gram.data() + gram.size());
    all.insert(all.end(), against.data(), against.data() + against.size());
    return all;
  });
  Equations sum{with_tolerance(MatrixXd::Zero(q, q), s), VectorXd::Zero(q)};
  sum.against.tail(count(s)) = -s.weight * deviations(s);
  for (const Values& all : answers) {
    sum.gram += Eigen::Map<const MatrixXd>(all.data(), q, q);
    sum.against += Eigen::Map<const VectorXd>(all.data() + q * q, q);
  }
  return sum;
}

AsStated moved(const AsStated& s, const VectorXd& change) {
  AsStated next = s;
  const Index own = static_cast<Index>(s.x.size()) - count(s);
  for (Index k = 0; k < change.size(); ++k) {
    const auto place = static_cast<std::size_t>(k);
    const Free& free = s.model.free[place];
    next.x[place] = from_unit(free, to_unit(free, s.x[place]) + change[k] * (k < own ? 1 : deviation_in_cube));
  }
  return next;
}

// The same, at the numbers of a fit in which one of them was free.
AsStated moved_to(AsStated s, const ModelFit& other) {
  for (std::size_t i = 0; i < s.x.size(); ++i)
    for (std::size_t k = 0; k < other.x.size(); ++k)
      if (s.model.free[i].name == other.model.free[k].name) s.x[i] = other.x[k];
  return s;
}

// By steps of Gauss and Newton, halved where one goes too far.
AsStated downhill(const Bench& bench, const Judge& judge, AsStated best, const Jobs& jobs) {
  constexpr int most_steps = 12;
  constexpr double worth_a_step = 0.01;  // of a misfit: moves no p value
  best.misfit = misfit(judge, best);
  double length = 1;
  VectorXd variance;
  for (int step = 0; step < most_steps && count(best) > 0; ++step) {
    const auto [gram, against] = equations(bench, judge, best, jobs);
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(gram);
    variance = solver.pseudoInverse().diagonal();
    const VectorXd change = solver.solve(against);
    AsStated next = moved(best, length * change);
    double there = misfit(judge, next);
    for (; !(there < best.misfit) && length > 0.05; there = misfit(judge, next))
      length /= 2, next = moved(best, length * change);
    if (!(there < best.misfit - worth_a_step)) break;
    best = std::move(next);
    best.misfit = there, length = std::min(1.0, 2 * length);
  }
  const VectorXd off = deviations(best);
  for (Index d = 0; d < off.size(); ++d)
    best.is_off.push_back(off[d] * off[d] >
                          gsl_cdf_chisq_Pinv(1 - chance_level, 1) * best.weight * variance.tail(off.size())[d]);
  return best;
}

}  // namespace

MatrixXd slopes_as_stated(const AsStated& s, const Judge& judge, const Test& test, std::size_t i,
                          const Prediction& at) {
  MatrixXd columns = slopes_of(judge, test, i, s.model, s.x, at);
  columns.rightCols(count(s)) *= deviation_in_cube;
  return columns;
}

VectorXd deviations(const AsStated& s) { return deviations(s, s.x); }

VectorXd deviations(const AsStated& s, const Values& x) {
  VectorXd off(count(s));
  for (Index d = 0; d < off.size(); ++d) {
    const std::size_t place = x.size() - s.names.size() + static_cast<std::size_t>(d);
    off[d] = (to_unit(s.model.free[place], x[place]) - stated_in_cube) / deviation_in_cube;
  }
  return off;
}

MatrixXd with_tolerance(MatrixXd gram, const AsStated& s) {
  gram.diagonal().tail(count(s)).array() += s.weight;
  return gram;
}

std::string most_off(const AsStated& s) {
  const VectorXd off = deviations(s).cwiseAbs();
  std::string most;
  double largest = 0;
  for (Index d = 0; d < off.size(); ++d) {
    const auto k = static_cast<std::size_t>(d);
    if (!s.is_off[k] || off[d] <= largest) continue;
    largest = off[d];
    most = fault_sentence(s.names[k], s.x[s.x.size() - s.names.size() + k]);
  }
  return most;
}

bool within_tolerances(const AsStated& s) {
  return s.names.empty() ||
         gsl_cdf_chisq_Q(deviations(s).squaredNorm(), static_cast<double>(s.names.size())) > chance_level;
}

std::pair<ModelSpec, Values> moved_alike(const AsStated& s, const ModelFit& fit, const ModelSpec& other, Values x) {
  ModelSpec model = other;
  const std::size_t own = fit.x.size();
  for (std::size_t i = 0; i < own; ++i) {
    const Free& free = model.free[i];
    x[i] = from_unit(free, to_unit(free, x[i]) + to_unit(free, s.x[i]) - to_unit(free, fit.x[i]));
  }
  for (Number ModelSpec::*number :
       {&ModelSpec::width_factor, &ModelSpec::centre_height_factor, &ModelSpec::floor_gain, &ModelSpec::clock_behind})
    if (const int place = (s.model.*number).free; place >= static_cast<int>(own))
      model.*number = {.value = s.x[static_cast<std::size_t>(place)]};
  return {std::move(model), std::move(x)};
}

AsStated with_stated_numbers(const Bench& bench, const ModelFit& fit) {
  AsStated s{.model = fit.model, .x = fit.x, .names = {}, .is_off = {}};
  for (const StatedNumber& number : stated_numbers(bench.data().tolerance, fit.model)) {
    s.x.push_back((fit.model.*number.number).value);
    s.names.emplace_back(number.name);
    let_free(s.model, number);
  }
  return s;
}

AsStated as_stated(const Bench& bench, const Judge& judge, const ModelFit& fit, const Jobs& jobs,
                   const std::vector<ModelFit>& elsewhere, double weight) {
  AsStated stated_so = with_stated_numbers(bench, fit);
  stated_so.weight = weight;
  AsStated best = downhill(bench, judge, stated_so, jobs);
  for (const ModelFit& other : elsewhere)
    if (AsStated there = downhill(bench, judge, moved_to(stated_so, other), jobs); there.misfit < best.misfit)
      best = std::move(there);
  return best;
}

}  // namespace freestand::measurement
