// How much of the scatter of a demand a parameter has a part in, alone and together with others: total shares.
//
//   total share of X in Y = E[Var(Y | all but X)] / Var(Y) = E[(Y - Y')^2] / (2 Var(Y))
//
// with Y' from the same sample but for X, which is drawn again: M. J. W. Jansen, Computer Physics Communications 117 (1999), eq. 11.
// ln of a demand: over the pairs of which both moved and stood. Among these the parameters are not independent, as they were drawn (what
// moves under weak motions has little friction): a share alone (shares.hpp) then holds what goes with X, and may exceed the total one,
// in which all others stay as they are. Errors by leaving out motions (jackknife.hpp); where the motion itself
// is drawn again, a pair goes with either of its two.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decision/shares.hpp"
#include "fragility/jackknife.hpp"
#include "fragility/leave_out_groups.hpp"

namespace freestand::decision {

struct TotalShare {
  fragility::Estimate share;
  std::int64_t pairs = 0;
};

// Sums as in ShareTally: integers, any order.
class TotalTally {
 public:
  TotalTally(std::size_t parameters, std::vector<Answer> answers, const fragility::LeaveOutGroups& groups);

  // The answers of a sample, and those with `parameter` drawn again; NaN in either: no pair.
  void add(std::size_t parameter, int group, int group_again, std::span<const double> value,
           std::span<const double> again);

  std::vector<std::int64_t>& words() { return words_; }
  TotalShare share(std::size_t parameter, std::size_t answer, double confidence) const;
  // Of an answer of yes or no: in so many of the samples of the pairs it is the rarer one, the half of both sides.
  double rarer(std::size_t parameter, std::size_t answer) const;

 private:
  // Pairs, and their sums of (y - y')^2, y + y', y^2 + y'^2.
  struct Sums {
    double n = 0, differences = 0, sum = 0, squares = 0;
  };
  Sums read(std::size_t place) const;
  Sums all(std::size_t parameter, std::size_t answer) const;
  std::size_t place(std::size_t parameter, std::size_t answer, std::size_t group, std::size_t side) const;

  std::vector<Answer> answers_;
  fragility::LeaveOutGroups groups_;
  std::vector<std::int64_t> words_;
};

}  // namespace freestand::decision
