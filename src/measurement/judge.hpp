// How far a model is from the measured histories when the noise of the measured floor motion is allowed for, in full:
// the residual r (in units of the sensors' noise) is judged by the covariance C = 1 + A A^T, where the columns of A are
// the changes that replays of the floor's noise make, over sqrt(their count). Directions in which that noise fans the
// motion out say nothing; all others count. r^T C^-1 r by Woodbury's identity; its expectation is the number of samples.
//
// A comes from one reference model, so that rivals are judged alike.
#pragma once

#include <memory>
#include <vector>

#include "measurement/model_fit.hpp"

namespace freestand::measurement {

class Judge {
 public:
  // Replays of the calibration tests under the reference model with x; the bench's replays are used.
  // fanned_out: samples that the floor's noise alone moves by more [noise units] are left out, since so far no covariance
  // describes them any more: the replays of a chaotic rocking are not on both sides of it.
  Judge(const Bench&, const ModelSpec& reference, const Values& x, const Jobs&, double fanned_out = 1e9);

  // Without replays: C = 1.
  explicit Judge(const Bench&);

  // C^-1/2 r of the i-th calibration test [noise units]; as many as samples(). G is the sum of its squares.
  std::vector<double> whitened(std::size_t i, const ModelSpec&, std::span<const double> x) const;
  // Misfit of each calibration test, left out where the model was refitted without it; histories only.
  std::vector<double> misfit(const ModelFit&) const;
  // With the fit to all of them.
  std::vector<double> misfit_of_fit(const ModelFit&) const;
  // Number of samples of each calibration test, without those left out.
  const std::vector<double>& samples() const { return samples_; }
  // Of the reference: expected_error() of each calibration test.
  const std::vector<double>& expected() const { return expected_; }
  // Of the reference, each calibration test: the largest misfit that one replay shows to the covariance of the others.
  // Near none where the floor's noise bends the motion a little; where it decides which way the motion goes, a model that
  // is right may miss the measured history by that much.
  const std::vector<double>& strays() const { return strays_; }

 private:
  struct Parts;
  void take(const std::vector<Values>& columns, double fanned_out);
  double misfit(std::size_t i, const ModelFit&, const Values& x) const;
  const Bench& bench_;
  std::vector<std::size_t> tests_;
  std::vector<double> samples_, expected_, strays_;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace freestand::measurement
