// What each calibration test says of a fit's numbers, and of what the laboratory states, by derivatives: see posterior.hpp.
#pragma once

#include <Eigen/Core>

#include "measurement/fit/as_stated.hpp"

namespace freestand::measurement {

inline constexpr double no_fit = 1e12;  // misfit of numbers that give no history

inline bool is_friction(const Free& free) { return free.name.rfind("friction.mu", 0) == 0; }

// Of one test, in the columns of the numbers, those stated among them, and, last, of ln mu.
struct Pull {
  Eigen::MatrixXd gram;     // M^T C^-1 M
  Eigen::VectorXd against;  // M^T C^-1 r
};

// The calibration tests, each with a friction of its own, exp(shift) times that of the numbers. What is stated is as it is there.
class OwnShifts {
 public:
  OwnShifts(const Bench&, const Judge&, const AsStated&);
  std::size_t count() const { return tests_.size(); }
  // numbers: of the fit; what is stated is added.
  Prediction at(std::size_t i, Values numbers, double shift) const;
  Asked asked(std::size_t i, Values numbers, double shift) const;
  // Derivatives in the numbers and, last, in the shift. Where the numbers hold friction it is theirs, to the bit: the two are
  // told apart by what the tests have in common alone.
  Eigen::MatrixXd slopes(std::size_t i, double shift) const;
  // What the i-th test says where its friction is about that far off: linear there, told of a shift of zero.
  Pull pull(std::size_t i, double shift) const;
  // The shift of least misfit, by Gauss and Newton's steps.
  double best(std::size_t i) const;

 private:
  struct Shift {
    double ln, G;
  };
  Shift best_from(std::size_t i, double start) const;

  const Bench& bench_;
  const Judge& judge_;
  const AsStated& place_;
  ModelSpec model_;
  std::vector<std::size_t> tests_;
};

std::vector<Pull> pulls_of(const OwnShifts&, const std::vector<double>& shifts, const Jobs&);
// In the first numbers alone, the others being as they are.
std::vector<Pull> of_first(const std::vector<Pull>&, Eigen::Index count);

// Of all tests, in the numbers alone, where the friction of each is off by a number of variance tau2.
Pull sum_of(const std::vector<Pull>&, double tau2);

// Standard deviation tau of ln mu from test to test, where the tests show one; else 0.
double friction_scatter(const std::vector<Pull>&);
// Degrees of freedom of tau2 beside it: twice its information in the restricted likelihood, tau2^2 tr(P F P F), F the sum of the tests'
// f f^T of their frictions' derivatives, P the inverse of their covariance less what the numbers take. n - 1 of n tests that all tell well
// of their friction, n where it is no number of the fit; one that stands still adds none, whatever it tells of other numbers.
double freedom_of_friction_scatter(const std::vector<Pull>&, double tau2);

// s, and nu.
struct Dispersion {
  double s = 1, freedom = 0;
};
Dispersion dispersion_of(const std::vector<Pull>&, double tau2);
// nu s^2 is chi-square of nu degrees of freedom where noise is all that tests disagree by.
bool disagree_beyond_chance(const Dispersion&);

}  // namespace freestand::measurement
