// How likely chance is to do what an effect is said to do: data are made from a fitted model and noise, thousands of times,
// and every model is fitted to them again as if it were linear in its numbers near where it stands. Noise is that of the
// sensors as estimated (sensor.hpp), and of the floor a replay drawn for each test, judged by the covariance of the others.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "measurement/fit/as_stated.hpp"
#include "measurement/fit/judge.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {

inline constexpr const char *help_question = "does an effect help", *lead_question = "is the lead chance",
                            *misfit_question = "is it enough", *another_question = "does one more help",
                            *steady_question = "is its gain luck";

struct Chance {
  std::string question, about;  // one of these, and which effects
  double observed = 0;          // what is asked about, in misfit G; of peaks a share of their squared error
  double usual = 0;             // what chance reaches in one set of twenty
  double p = 1;
  int simulations = 0;
  std::size_t tries = 1;  // what is asked about is the best of so many: p is so many times the share of simulations
  // Leads: in which share of data from the best it would exceed what chance reaches, so that the two were told apart.
  double told_apart = std::numeric_limits<double>::quiet_NaN();
  bool within_tolerances = false;  // chance only if what the laboratory states is off within its tolerances
  double level() const { return question == another_question ? further_level : chance_level; }
  // Of two models that imitate each other entirely the share is the level itself (0.05 +- 0.005, of 2000 sets), whatever fits leave of a
  // lead: it tells nothing below twice that.
  bool apart() const { return !(told_apart < 2 * chance_level); }
  bool chance() const { return p > level() || !apart(); }
};

inline constexpr std::uint64_t chance_simulations =
    2000;  // a p value of 0.05 is known to 0.005 (one standard deviation)

// Of data made again and again, draw(s) saying what is asked of the s-th: p, and the value that chance reaches in one of twenty; of
// Chance::tries one may (Bonferroni).
void weigh(Chance&, const std::function<double(std::uint64_t s)>& draw);
// Of a lead that was weighed: draw(s) saying what the best leads by in data from itself.
void weigh_power(Chance&, const std::function<double(std::uint64_t s)>& draw);

// The models tried, each as it was fitted and at twelve strengths for each number of its effects, the base's numbers as they stand.
struct Tried {
  const ModelSpec* model;
  Values x;
};
std::vector<Tried> at_strengths(const ModelFit& base, const std::vector<const ModelFit*>& tried);

// Does any effect help? The largest gain over the base among all effects tried, against the largest gain in data from the
// base. A gain is that of a direction: the change of all histories that an effect makes at one of many strengths, or as it
// was fitted, as far as the base's own numbers cannot make it. judge: of the base. tried: models that hold the base's
// numbers first.
// stated: of the base; then the gain is that beyond what deviations from what is stated make, in the data and in those from the base.
Chance chance_of_gain(const Bench&, const Judge&, const ModelFit& base, const std::vector<const ModelFit*>& tried,
                      const Jobs&, const AsStated* stated = nullptr, std::size_t tries = 1);

// Does an effect, the best of so many tries, help where its own history does not hang on the floor's noise? A rocking that noise turns
// elsewhere is met by some of the many numbers that fits try, whatever the effect: the gain by the readings that replays of the effect's own
// model do not fan out.
Chance chance_of_steady_gain(const Bench&, const ModelFit& base, const ModelFit& with, std::size_t tries, const Jobs&,
                             double friction_scatter);

// Can the best be told from a rival? The lead of the best, G of the rival less G of the best, against the lead that it has
// in data from the rival. judge: of the best.
Chance chance_of_lead(const Bench&, const Judge&, const ModelFit& best, const ModelFit& rival, const Jobs&);

// Is a model enough? Its misfit G of the fit, against the misfit of data from itself. judge: of the model.
Chance chance_of_misfit(const Bench&, const Judge&, const ModelFit&, double misfit_of_fit);

}  // namespace freestand::measurement
