// How far a model is from the measured histories when the noise of the measured floor motion is allowed for, in full:
// the residual r (as independent numbers of the sensors' noise, sensor.hpp) is judged by the covariance C = 1 + A A^T.
// The columns of A are the changes that replays of the floor's noise make, over sqrt(their count); those that the floor
// may make between its readings (between_readings.hpp); a drift of each sensor that drifts; and what one standard
// deviation of the test's own friction changes, where friction differs from test to test. Directions in which that noise
// fans the motion out say nothing; all others count. r^T C^-1 r by Woodbury's identity; its expectation is the number of
// samples.
//
// A comes from one reference model, so that rivals are judged alike.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

// [noise units] Where the floor's noise moves a history by more, replays that take the other way are as likely as not.
inline constexpr double fanned_out = 5;

// Times the power of slow noise that a sensor is said to have: as much as it may have, so that what lies between is near to a straight line.
inline constexpr double more_slow_power = 4;

inline constexpr double every_sample = 1e9;  // no limit

double total(const std::vector<double>&);

class Judge {
 public:
  // Replays of the calibration tests under the reference model with x; the bench's replays are used.
  // limit: samples that the floor's noise alone moves by more [noise units] are left out, since so far no covariance
  // describes them any more: the replays of a chaotic rocking are not on both sides of it.
  // friction_scatter: standard deviation of the logarithm of friction, from test to test.
  Judge(const Bench&, const ModelSpec& reference, const Values& x, const Jobs&, double limit = every_sample,
        double friction_scatter = 0);

  // Without replays: C = 1.
  explicit Judge(const Bench&);

  // C^-1/2 r of the i-th calibration test [noise units]; as many as samples(). G is the sum of its squares.
  std::vector<double> whitened(std::size_t i, const Prediction&) const;
  const Test& test(std::size_t i) const { return bench_.test(tests_[i]); }
  // Changes of a prediction, as independent numbers of the sensors' noise: columns for products().
  Eigen::VectorXd change(std::size_t i, const Prediction& from, const Prediction& to) const;
  // Model minus measured, likewise.
  Eigen::VectorXd residual(std::size_t i, const Prediction&) const;

  // What a refit to the i-th calibration test needs to know of it, were the model linear in these columns: their products in
  // the metric of C^-1, and what noise makes of them.
  struct Products {
    Eigen::MatrixXd gram;        // M^T C^-1 M
    Eigen::MatrixXd covariance;  // of M^T C^-1 e, e being the sensors' noise
    Eigen::MatrixXd replays;     // M^T C^-1 a, one column for each replay's change a, C being that of the others
    Eigen::MatrixXd slow;        // by how much the covariance grows with more_slow_power; empty where noise is white
  };
  Products products(std::size_t i, const Eigen::MatrixXd& columns) const;
  // C^-1 M.
  Eigen::MatrixXd weighed(std::size_t i, const Eigen::MatrixXd& columns) const;
  // M^T C^-1 r.
  Eigen::VectorXd against(std::size_t i, const Eigen::MatrixXd& columns, const Eigen::VectorXd& r) const;

  // Misfit of each calibration test, left out where the model was refitted without it; histories only.
  std::vector<double> misfit(const ModelFit&) const;
  // With the fit to all of them.
  std::vector<double> misfit_of_fit(const ModelFit&) const;
  // Number of samples of each calibration test, without those left out.
  const std::vector<double>& samples() const { return samples_; }
  // Of the reference: expected_error() of each calibration test, by the noise of sensors and floor.
  const std::vector<double>& expected() const { return expected_; }
  // Of the reference, each calibration test: the misfit that each replay shows to the covariance of the others. Near none
  // where the floor's noise bends the motion a little; where it decides which way the motion goes, a model that is right may
  // miss the measured history by the largest of them.
  const std::vector<std::vector<double>>& replay_misfits() const { return replay_misfits_; }
  std::vector<double> strays() const;  // the largest, of each test
  // Of each test: root mean square of what its floor may do to the history between its readings [noise units].
  const std::vector<double>& unread() const { return unread_; }
  // Of each test: how much of the sensors' misfit, one a sample, goes into directions that C allows for.
  const std::vector<double>& allowed() const { return allowed_; }

 private:
  struct Parts;
  // columns: of each test how many are of replays and how many of what lies between readings, then those, and what is left is of the test's own
  // friction.
  void take(const std::vector<Values>& columns, double limit);
  Eigen::MatrixXd drifts(const Test&) const;
  Eigen::MatrixXd slow(std::size_t i, const Eigen::MatrixXd& weights) const;
  std::vector<double> misfit(const ModelSpec&, const std::function<Values(std::size_t i)>& x) const;
  const Bench& bench_;
  std::vector<std::size_t> tests_;
  std::vector<double> samples_, expected_, allowed_, unread_;
  std::vector<std::vector<double>> replay_misfits_;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace freestand::measurement
