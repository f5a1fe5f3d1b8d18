// How far numbers of a fit are from the measured histories, where all else that may differ is as it is likeliest: the friction of each test,
// where it scatters, and what the laboratory states, within its tolerances. See posterior.hpp. A model that leaves more than a model may
// (adequate of levels.hpp), however what is stated is off, would have deviations stand for what it lacks: of such a one all is as stated.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <optional>

#include "measurement/fit/test_pulls.hpp"

namespace freestand::measurement {

class HistoryMisfit {
 public:
  HistoryMisfit(const Bench&, const ModelFit&, const Jobs&);
  HistoryMisfit(const HistoryMisfit&) = delete;
  HistoryMisfit& operator=(const HistoryMisfit&) = delete;

  double friction_scatter() const { return scatter_; }
  double friction_freedom() const { return friction_freedom_; }  // of how far it is known by how much friction scatters
  const Dispersion& dispersion() const { return dispersion_; }
  // By derivatives, in the cube in which fits move: half the second derivatives of G, and the step from the fit to where it is least.
  const Eigen::MatrixXd& rates() const { return rates_; }
  // inverse: of the rates.
  Eigen::VectorXd step(const Eigen::MatrixXd& inverse) const;
  // G of the fit's numbers; no_fit: they give no history.
  double operator()(const Values& numbers) const;
  // The fit is likeliest near its own numbers where all is as stated, and elsewhere only where something is off by more than chance.
  bool likeliest_as_stated() const;
  // "the width is 1.2 % smaller than stated": what is off by more than its standard deviation, and by more than chance; empty: nothing is, or
  // the model leaves more than a model may.
  std::string stated_otherwise() const;

  // The model leaves more than a model may, however what is stated is off within its tolerances.
  bool leaves_too_much() const { return leaves_too_much_; }

  // The model in which what is stated is free behind the numbers of the fit; and as it may be where these are so, in the s-th draw.
  const ModelSpec& in_laboratory() const { return place_.model; }
  Values stated_beside(const Values& numbers, std::uint64_t s) const;

 private:
  // Numbers, with what is stated behind them and the friction of each test off by its shift, and what the histories there say.
  struct Look {
    Values x;
    std::vector<double> shifts;
    double G = 0;                               // where the friction of each test is likeliest
    Eigen::VectorXd against_stated = {};        // half its derivatives in what is stated
    std::vector<double> against_friction = {};  // half those of each test's misfit in its shift, at a shift of 0
  };
  struct Likeliest {
    double G;
    Values x;
  };
  void look(std::vector<Look>&) const;
  void add(Look&, std::size_t i, const Prediction&) const;
  // By the derivatives: the shift, what is stated, and the same as where to look next.
  double likeliest_shift(std::size_t i, double against_friction) const;
  Eigen::VectorXd to_likeliest(const Look& at) const { return -of_deviations_.solve(at.against_stated); }
  Look next(const Look&) const;
  Likeliest likeliest_beside(const Values& numbers) const;

  void look_from(const AsStated&, const Jobs&);
  std::vector<Pull> of_numbers() const;  // of the fit alone
  void allow(double tau, const Jobs&);   // for friction that scatters by so much
  ModelFit with_friction_of_tests() const;
  bool is_too_much(double misfit) const;
  double weight() const;
  void reduce();
  std::vector<double> beyond_chance() const;                  // deviations of what is off by more than chance, else 0
  Values changed(Values x, const Eigen::VectorXd& by) const;  // in what is stated, in the cube

  const Bench& bench_;
  const ModelFit& fit_;
  Judge judge_;
  AsStated place_;  // where the derivatives are taken
  std::optional<OwnShifts> tests_;
  std::vector<double> shifts_;  // ln of each test's friction over that of the numbers there
  std::vector<Pull> pulls_;
  double scatter_ = 0;                      // of friction
  double tau2_ = 0, friction_freedom_ = 1;  // tau2_: what G allows for, and s^2 G holds s^2 of
  Dispersion dispersion_;
  bool leaves_too_much_ = false;
  double fall_as_stated_ = 0;  // of G, from the fit by its numbers alone, all being as stated
  Eigen::MatrixXd rates_;
  Eigen::VectorXd against_, errors_;           // errors_: standard errors of the deviations
  Eigen::LLT<Eigen::MatrixXd> of_deviations_;  // half the second derivatives of G in what is stated
  // Of each test: the direction of its friction, C^-1 times those of what is stated, and the products of both.
  std::vector<Eigen::MatrixXd> friction_, stated_;
  std::vector<Eigen::VectorXd> friction_stated_;
};

}  // namespace freestand::measurement
