// How peaks scatter about a model that was fitted to them. ln(measured/model) of peak k of test t, which tells n_t peaks, is
//
//   y_tk sqrt(n_t) = d_tk(s_t) + sigma (sqrt(rho) c_t + sqrt(1 - rho) e_tk),   s_t ~ N(0, tau^2),   c_t, e_tk ~ N(0, 1)
//
// d_tk(s): what friction exp(s) times the model's makes of the peak. It scatters from test to test, and a block that hardly slips hangs on
// it far more than one that slips by much: as if all tests scattered alike, weak ones would look like an effect (11 to 15 of 50 sets where
// friction scattered by 5 to 15 % and nothing else was amiss). tau, sigma and rho are those of the greatest likelihood, d_t taken
// as normal with its mean and covariance over s; tau and sigma are widened for the numbers that were fitted.
// Peaks that are 0 in both, or of what fell in both, have y = 0 and scatter in no data (score.hpp).
#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <vector>

namespace freestand::measurement {

class PeakScatter {
 public:
  // Shifts s at which d is asked for, ascending, evenly apart, 0 in the middle.
  static std::vector<double> shifts();

  // y and d/sqrt(n_t): one row a peak, test after test; a column of d for each shift. peaks: n_t. numbers: how many were fitted.
  PeakScatter(const Eigen::VectorXd& y, const Eigen::MatrixXd& d, std::vector<Eigen::Index> peaks, std::size_t numbers);

  double of_friction() const { return tau_; }       // tau
  double p_without_friction() const { return p_; }  // how likely chance is to show as large a tau where there is none
  double own() const { return sigma_; }             // sigma
  bool as_read() const { return as_read_; }         // they scatter by no more than peaks are read to

  // The s-th of y made again.
  Eigen::VectorXd draw(std::uint64_t s) const;

  // Columns of such rows in units of this scatter: what was y has then a covariance of 1.
  Eigen::MatrixXd weighed(const Eigen::MatrixXd& columns) const;

 private:
  struct Moments {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
  };
  // use(test, its first row, its rows).
  template <class Use>
  void for_each_test(Use&& use) const;
  Eigen::VectorXd by_friction(Eigen::Index first, Eigen::Index rows, double shift) const;
  Moments moments_by_friction(Eigen::Index first, Eigen::Index rows, double tau) const;
  // Of the rows of a test. What does not scatter is known as well as its own scatter would have it.
  Eigen::MatrixXd covariance(Eigen::Index first, Eigen::Index rows, const Eigen::MatrixXd& by_friction, double sigma,
                             double rho) const;
  bool peaks_can_go_together() const;
  // Sigma and rho of the greatest likelihood beside this tau, and -2 ln of that likelihood.
  struct Own {
    double sigma, rho, minus_2_ln_likelihood;
  };
  Own best_own(double tau) const;

  Eigen::VectorXd y_;
  Eigen::MatrixXd d_;
  std::vector<Eigen::Index> peaks_;
  double rho_ = 0, tau_ = 0, sigma_ = 0, p_ = 1;
  bool as_read_ = true;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> roots_;  // L L^T: the covariance of each test; empty where nothing scatters
};

}  // namespace freestand::measurement
