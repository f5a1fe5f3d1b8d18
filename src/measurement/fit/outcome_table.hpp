// Outcomes of a model at many points of its numbers, for all places of the specimen (placements.hpp). From such a table a
// fit to any choice of tests is read off without computing an outcome again: the least Brier score over the points, and
// over middle and scatter of the placements, in which it is smooth. So folds and resampled tests cost nothing.
#pragma once

#include <Eigen/Core>
#include <array>

#include "measurement/fit/model_fit.hpp"
#include "measurement/predict/placements.hpp"

namespace freestand::measurement {

struct TablePoint {
  Values x;                                  // of the free numbers; those of the placements are of no account
  bool plain = false;                        // of the model without its last effect
  std::vector<std::uint64_t> outcomes = {};  // of the tests of the table; empty: not yet computed
  bool of_box = false;                       // one of those of OutcomeTable::boxes
};

// From which so many points were drawn, evenly: the ranges of these numbers.
struct PointBox {
  std::vector<Free> range;
  std::vector<std::size_t> numbers;
  std::size_t count = 0;
};

struct OutcomeTable {
  ModelSpec model, without;  // without: the last effect; the same numbers in front
  std::vector<std::size_t> tests;
  Places places = {};
  std::vector<TablePoint> points = {};
  std::vector<PointBox> boxes = {};
};

// Adds points of the fit without the effect, to all tests and with folds left out, with the effect at nothing: with it no
// fit is worse than without.
void add_plain_points(OutcomeTable&, const ModelFit& without);

// Adds Sobol points of those numbers in the box, the rest as in x. No numbers: x alone, once.
void add_points(OutcomeTable&, const std::vector<Free>& box, const std::vector<std::size_t>& numbers, const Values& x,
                std::size_t count);

// Does an effect go sample by sample, some tens of times slower than in packs? Then points are fewer, and places twice as
// far apart.
bool is_slow(const OutcomeTable&);

// That such places tell from a narrower one: of wider ones too many placements lie beyond the last place.
double widest_scatter(const Places&);

// Fills what is not yet computed, in jobs of one point and a part of the tests.
void compute(const Bench&, const std::vector<OutcomeTable*>&, const std::string& what, const Jobs&);

struct TableFit {
  std::size_t point = 0;
  Values x;  // with middle and scatter of the placements
  double score = 0;
  std::vector<double> probability = {};  // of each test of the table
};

class TableSearch {
 public:
  // Of all points, or of the plain ones alone. Keeps a reference to the table.
  TableSearch(const Bench&, const OutcomeTable&, bool plain_only = false);

  // Least mean score with these weights of the tests; all alike where empty.
  TableFit best(const std::vector<double>& weight = {}) const;
  // Of each set of outcomes (a column, 0 or 1 of each test): the least sum of squares of the rows, and that of tests left out in turn (fold_of),
  // by the rows that are least in the others.
  Eigen::VectorXf least_squares(const Eigen::MatrixXf& outcomes) const;
  Eigen::VectorXf left_out_squares(const Eigen::MatrixXf& outcomes) const;
  // The same rows of least squares, and how many tests they expect to overturn.
  struct SetFits {
    Eigen::VectorXf squares, expected;
  };
  SetFits fits_to(const Eigen::MatrixXf& outcomes) const;
  // Least score of each point of the table over middle and scatter, all tests alike; infinite where it was left out.
  std::vector<double> scores() const;
  // Of each number, from all points whose scores are worse than those of the fit by no more than chance: by their paired
  // difference over the tests and its standard error, at 95 %.
  std::vector<Interval> seen_within_chance(const TableFit&) const;
  // Out to what is certainly worse. Middle and scatter: to the next row.
  // The n points of the table spread over d other numbers, so that a slab that they are sure to have seen from all sides holds
  // n^(1-1/d) of them: as many points further. What is open where the table ends is open to the end of its range.
  std::vector<Interval> within_chance(const TableFit&) const;
  // Of each test, at a point with the middle and scatter of x.
  std::vector<double> probabilities(std::size_t point, const Values& x) const;

 private:
  struct Row {
    std::size_t point;
    double middle, scatter;
  };
  Values placed(const Row&) const;
  // Sums of squares [row, set] of the next rows_at_once rows, over these tests; and how many rows that are.
  Eigen::MatrixXf squares(Eigen::Index first, const Eigen::MatrixXf& outcomes,
                          const std::vector<Eigen::Index>& tests) const;
  Eigen::Index rows_from(Eigen::Index first) const;
  const OutcomeTable& table_;
  std::vector<double> overturned_;  // 0 or 1, of each test
  std::vector<Row> rows_;
  std::vector<float> probability_;  // [row][test]
};

}  // namespace freestand::measurement
