// Which sampled parameter makes a demand scatter: first-order shares of its variance, from samples that are there.
//
//   share of X in Y = Var(E[Y | X]) / Var(Y)           I. M. Sobol, Mathematical Modelling and Computational Experiments 1, 1993
//
// the part of the variance that would go if X were known. The samples are parted by X into K classes of equal probability (64, or so
// few that each holds 12 samples, of an even design 32 and 25; the values of a choice, the motions and the rows of a table of joint draws
// are classes by themselves), and
//
//   share = (r - q)/(1 - q),   r = 1 - sum_k SS_k / SS,   q = c (K - 1)/(N - 1)
//
// with SS the sum of squares about the mean, SS_k that of a class about its own: q takes away what K class means scatter by chance. Of
// independent draws, and of the permutations of a latin hypercube, c = 1 (T. L. Kelley, Proc. Natl. Acad. Sci. 21, 1935). The means of an
// even design scatter less, and how much less is measured: parameters that the answer cannot depend on (`idle`, other dimensions of the
// same design) are parted into classes too, and c is the mean of their r (N - 1)/(K - 1); how that differs among them goes into the error.
// What is lost inside the classes is 1/K^2 of the share of a straight line over a uniform parameter, and 1/(6K) of a step's on the average
// over where it may lie: from K/2 to K classes it falls by three times what is left, or by once that. So two thirds of that step are added,
// no more than of what is missing to 1, and a third of it goes into the error (L. F. Richardson, 1911), or half of what a step may lose in
// its class, if that is more. Of an even design the ratio of variances has no known distribution, and the interval is laid about the share
// itself. Samples that share a motion are not independent: motions are left out in turn (jackknife.hpp), for the error and against the bias
// of few motions. Groups that are parts of one even design err less than they differ: without scrambles their part of the variance is taken
// times c, which is still too much rather than too little, since c is of class means and the design as even throughout. A share that is
// zero comes out as zero on the average, so now and then below it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fragility/jackknife.hpp"
#include "fragility/leave_out_groups.hpp"

namespace freestand::decision {

// A sampled parameter and how many classes its samples come in.
struct Parameter {
  std::string name, unit = "1";
  int classes = 64;
  bool ordered = true;  // neighbouring classes may be joined
  // The design that its draws are even in: 0 none, independent draws. Of each other one there are idle parameters behind the others.
  int design = 0;
  bool idle = false;
};

// What scatters: ln of a demand, over those that moved and stood; or whether something happens, the demand above a capacity, say.
struct Answer {
  std::string edp, unit = "1";
  double capacity = 0;  // NaN for ln of the demand, and where the demand itself is yes or no
  bool yes_or_no = false;
};

struct ShareRow {
  std::vector<fragility::Estimate> share;  // [parameter], idle ones left out
  // Of each alone, summed; what is missing to 1 is due to parameters that act together, as long as they are independent (among what moved and
  // stood they are not, and the sum may exceed 1).
  fragility::Estimate together;
  std::int64_t samples = 0;  // with this answer
  int motions = 0;           // groups of motions that these have (at most 64 of records and 64 of others)
  double mean = 0, variance = 0;
};

// Counts and sums by class and group. Sums are of multiples of 2^-20, as integers: the same in any order, and words of
// tallies of the same shape may be added element by element. |values| < 2^10, up to 2^30 samples.
class ShareTally {
 public:
  // one_design: the groups that are no records are parts of one even design, no designs of their own.
  ShareTally(std::vector<Parameter> parameters, std::vector<Answer> answers, const fragility::LeaveOutGroups& groups,
             bool one_design = false);

  // of_class: [parameter], 0 ... classes - 1, or `classes` where a sample has none (the period of a record). value: [answer], NaN:
  // not known for this sample, as the slip of what overturned.
  void add(int group, std::span<const int> of_class, std::span<const double> value);

  std::vector<std::int64_t>& words() { return words_; }
  ShareRow row(std::size_t answer, double confidence) const;

 private:
  struct Sums {
    double n = 0, sum = 0, squares = 0;
    double about_mean() const { return squares - sum * sum / (n > 1 ? n : 1); }
    void operator+=(const Sums& other) { *this = {n + other.n, sum + other.sum, squares + other.squares}; }
    void operator-=(const Sums& other) { *this = {n - other.n, sum - other.sum, squares - other.squares}; }
  };
  struct Shares;
  Sums cell(std::size_t parameter, std::size_t of_class, std::size_t group, std::size_t answer) const;
  std::size_t place(std::size_t parameter, std::size_t of_class, std::size_t group, std::size_t answer) const;
  // By classes, with c.
  static double share(const std::vector<Sums>& of_class, double evenness);
  // What a step of the answer may lose in the class that it lies in: by how much more a class scatters than its neighbours, of all.
  static double jump(const std::vector<Sums>& of_class);
  struct Evenness {
    double c, scatter;  // from one idle parameter to the next
  };
  Evenness evenness(int design, std::size_t answer, double samples) const;
  void draw_in(Shares&, double evenness) const;
  std::vector<Sums> by_group(std::size_t answer) const;
  std::vector<std::vector<Sums>> by_class_and_group(std::size_t parameter, std::size_t answer, double samples) const;
  Shares shares(std::size_t parameter, std::size_t answer, const std::vector<Sums>& of_group, double evenness) const;

  std::vector<Parameter> parameters_;
  std::vector<Answer> answers_;
  fragility::LeaveOutGroups groups_;
  bool one_design_;
  std::size_t width_ = 0;               // words of a cell
  std::vector<std::size_t> of_answer_;  // offset in a cell
  std::vector<std::size_t> first_;      // cell of class 0 and group 0 of each parameter
  std::vector<std::int64_t> words_;
};

}  // namespace freestand::decision
