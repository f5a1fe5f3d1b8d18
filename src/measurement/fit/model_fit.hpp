// Fits of whole models to the calibration tests, each with the errors of tests left out. The work is a list of jobs that
// may be spread over processes; the answer does not depend on how.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/jobs.hpp"
#include "measurement/fit/outcome_misfit.hpp"
#include "measurement/predict/score.hpp"
#include "measurement/search.hpp"

namespace freestand::measurement {

struct Effort {
  std::size_t screened_per_number = 32;  // points, times the count of free numbers
  std::size_t starts = 3;                // descents from the best of them
  std::size_t descended = 1000;          // tasks, the best by their screened points; the others stay there
  int budget = 80;                       // evaluations of each descent
  int polish = 160;                      // of one more, from the best of the descents
  int fold_budget = 60;                  // of a fit with tests left out, from the fit to all, or from each start
};

struct Interval {
  double lower = 0, upper = 0;
};

struct ModelFit {
  ModelSpec model;
  Values x = {};
  double score = 0;  // mean over the calibration tests
  int evaluations = 0;
  // What the fits with a fold left out start from (left_out.hpp). known: of each fold, numbers that other models have
  // without it, as far as they go; by_strides: found by strides, from anywhere.
  std::vector<std::vector<Values>> known = {};
  bool by_strides = false;
  bool left_out_refitted = false;           // else left_out is what the fit to all gives
  std::vector<Values> fold_x = {};          // of each fold
  std::vector<TestError> calibration = {};  // of each calibration test, with x
  std::vector<TestError> left_out = {};     // of each calibration test, with the fit that did not see it
  std::vector<Interval> intervals = {};     // 95 %, of each free number: jackknife over the folds, Student's t
  std::vector<Values> draws = {};           // outcomes: what the tests leave open (outcome_draws.hpp)
  std::optional<OutcomeMisfit> misfit = {};  // outcomes: of the fit that `draws` came from

  double mean_left_out() const;
};

// What is to be fitted: a model, points to start from beside those of the screening, and a point where nothing is
// screened but that one (a fit that goes on).
struct FitTask {
  ModelSpec model;
  std::vector<Values> starts = {};
  bool screened = true;
  std::vector<std::vector<Values>> known = {};  // as of ModelFit
};

// Folds of n calibration tests: every test alone where there are up to 12, else 10 groups. Fold of each test.
std::vector<std::size_t> fold_of(std::size_t n);

// What a fit makes least, of many points: mean_scores, or mean_stride_scores for histories.
using Measure = std::vector<double> (*)(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                        const std::vector<Values>& points);

// The measure of one point x. The model must outlive it.
Objective objective(const Bench&, const ModelSpec&, std::vector<std::size_t> tests, Measure = mean_scores);

// Screens and descends; no folds yet. In the order of the tasks; score is that of the measure.
std::vector<ModelFit> fit_models(const Bench&, const std::vector<FitTask>&, const Effort&, const Jobs&,
                                 Measure = mean_scores);

// One more descent for each, from where it stands, with a simplex of edge `step`.
void polish(const Bench&, std::vector<ModelFit*>, const Effort&, double step, const Jobs&);

// Descents with wide and narrow simplices in turn, until neither lowers a fit's score any more (bent valleys of several
// numbers hold one simplex up).
void refine(const Bench&, std::vector<ModelFit*>, const Effort&, const Jobs&);

// Fits with each fold left out; fills fold_x, left_out, intervals. refit: the fit to these of the calibration tests
// (positions among them), all but those of the fold.
using Refit = std::function<Fitted(const ModelFit& fit, std::size_t fold, const std::vector<std::size_t>& seen)>;
void leave_out(const Bench&, std::vector<ModelFit*>, const Refit&, const Jobs&);

// The same by descents from the fit to all: what each test moves, for intervals. A verdict on tests left out asks for
// more (left_out.hpp).
void leave_out(const Bench&, std::vector<ModelFit*>, const Effort&, const Jobs&);

// Errors of the calibration tests with x; left_out the same, without a refit.
void evaluate(const Bench&, std::vector<ModelFit*>, const Jobs&);

// Root mean square of the errors in noise units (histories), of the ln ratios (peaks), or mean Brier score (outcomes);
// and its standard error over the tests.
struct Pooled {
  double error = 0, standard_error = 0;
};
Pooled pooled(const Bench&, const std::vector<std::size_t>& tests, const std::vector<TestError>&);

}  // namespace freestand::measurement
