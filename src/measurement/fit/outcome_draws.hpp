// What outcomes leave open of a fit's numbers: joint draws of them, read off the table. Their density is the likelihood, the product over the
// tests of p or 1 - p, to the power of 1/D where the fit misses the tests by D times what its own probabilities make. Before, it is flat in the unit
// cube in which fits move, over all that is allowed; of placements in ln(middle), and in their scatter itself (Gelman, Bayesian Analysis 1, 2006): in
// its logarithm most of it would lie where there is next to none, and a middle would be known from few tests better than it is. A point of the
// table stands for as much of the cube as the boxes that points were drawn from (OutcomeTable::boxes) leave it: 1/sum of count/volume over the
// boxes that hold it.
#pragma once

#include "measurement/fit/outcome_table.hpp"

namespace freestand::measurement {

class OutcomeDraws {
 public:
  OutcomeDraws(const Bench&, const OutcomeTable&, const TableFit&);
  std::vector<Values> draw(std::size_t count) const;

 private:
  struct Cells {  // of ln middle and ln scatter, even
    double middle = 0, middle_step = 0, scatter = 0, scatter_step = 0;
    int middles = 1, scatters = 1;
    int count() const { return middles * scatters; }
    double middle_of(int cell) const { return middle + middle_step * (cell % middles); }
    double scatter_of(int cell) const { return scatter + scatter_step * (cell / middles); }
  };
  Cells all_cells() const;
  Cells likely_cells(const Cells&) const;
  void weigh(const Cells&);
  double ln_room(const TablePoint&) const;  // of the cube, that a point stands for

  const OutcomeTable& table_;
  std::vector<bool> fell_;
  int middle_number_, scatter_number_;
  double excess_ = 1;  // D
  Cells cells_;
  std::vector<std::size_t> points_;  // of the table
  Eigen::MatrixXf ln_likelihood_;    // [cell, point], with the room of the point
};

}  // namespace freestand::measurement
