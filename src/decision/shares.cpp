#include "decision/shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freestand::decision {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double scale = 1 << 20;
constexpr double least_of_a_class = 50;
constexpr int fewest_classes = 4;

std::int64_t fixed(double value) { return std::llround(value * scale); }

// How many neighbouring classes are joined.
int joined(const Parameter& parameter, double samples) {
  int join = 1;
  while (parameter.ordered && parameter.classes / join > fewest_classes &&
         samples * join < least_of_a_class * parameter.classes)
    join *= 2;
  return join;
}

}  // namespace

ShareTally::ShareTally(std::vector<Parameter> parameters, std::vector<Answer> answers,
                       const fragility::LeaveOutGroups& groups)
    : parameters_(std::move(parameters)), answers_(std::move(answers)), groups_(groups) {
  for (const Answer& answer : answers_) {
    of_answer_.push_back(width_);
    width_ += answer.yes_or_no ? 2 : 3;  // number, sum [, sum of squares]
  }
  std::size_t cells = 0;
  for (const Parameter& parameter : parameters_) {
    first_.push_back(cells);
    cells += static_cast<std::size_t>(parameter.classes + 1) * static_cast<std::size_t>(groups_.count());
  }
  words_.assign(cells * width_, 0);
}

std::size_t ShareTally::place(std::size_t parameter, std::size_t of_class, std::size_t group,
                              std::size_t answer) const {
  const std::size_t cell = first_[parameter] + of_class * static_cast<std::size_t>(groups_.count()) + group;
  return cell * width_ + of_answer_[answer];
}

void ShareTally::add(int group, std::span<const int> of_class, std::span<const double> value) {
  for (std::size_t a = 0; a < answers_.size(); ++a) {
    if (std::isnan(value[a])) continue;
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      std::int64_t* at = &words_[place(p, static_cast<std::size_t>(of_class[p]), static_cast<std::size_t>(group), a)];
      ++at[0];
      at[1] += answers_[a].yes_or_no ? (value[a] != 0) : fixed(value[a]);
      if (!answers_[a].yes_or_no) at[2] += fixed(value[a] * value[a]);
    }
  }
}

ShareTally::Sums ShareTally::cell(std::size_t parameter, std::size_t of_class, std::size_t group,
                                  std::size_t answer) const {
  const std::int64_t* at = &words_[place(parameter, of_class, group, answer)];
  const double n = static_cast<double>(at[0]), sum = static_cast<double>(at[1]);
  if (answers_[answer].yes_or_no) return {n, sum, sum};
  return {n, sum / scale, static_cast<double>(at[2]) / scale};
}

double ShareTally::share(const std::vector<Sums>& of_class) {
  Sums all;
  double classes = 0, within = 0;
  for (const Sums& one : of_class) {
    if (one.n == 0) continue;
    all += one;
    classes += 1;
    within += one.squares - one.sum * one.sum / one.n;
  }
  const double total = all.squares - all.sum * all.sum / std::max(all.n, 1.0);
  // Below that the values are all the same but for the rounding of the sums.
  if (all.n <= classes + 1 || !(total > 4 * all.n / (scale * scale))) return nan;
  return 1 - (all.n - 1) / (all.n - classes) * within / total;
}

std::vector<std::vector<ShareTally::Sums>> ShareTally::by_class_and_group(std::size_t p, std::size_t answer,
                                                                          double samples) const {
  const int join = joined(parameters_[p], samples), classes = parameters_[p].classes;
  std::vector<std::vector<Sums>> sums(static_cast<std::size_t>((classes + join - 1) / join + 1),
                                      std::vector<Sums>(static_cast<std::size_t>(groups_.count())));
  for (int c = 0; c <= classes; ++c) {
    auto& into = c == classes ? sums.back() : sums[static_cast<std::size_t>(c / join)];
    for (std::size_t g = 0; g < into.size(); ++g) into[g] += cell(p, static_cast<std::size_t>(c), g, answer);
  }
  return sums;
}

// Share of one parameter: of all samples, and without each group that has any.
struct ShareTally::Shares {
  double whole = nan;
  std::vector<double> without;  // [group], NaN where the group has no samples
  double classes = 0;           // that have samples
};

ShareTally::Shares ShareTally::shares(std::size_t p, std::size_t answer, const std::vector<Sums>& of_group) const {
  double samples = 0;
  for (const Sums& one : of_group) samples += one.n;
  const auto sums = by_class_and_group(p, answer, samples);
  std::vector<Sums> total(sums.size());
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (const Sums& one : sums[c]) total[c] += one;
  Shares found{share(total), std::vector<double>(of_group.size(), nan)};
  for (const Sums& one : total) found.classes += one.n > 0;
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].n == 0) continue;
    std::vector<Sums> rest(total);
    for (std::size_t c = 0; c < sums.size(); ++c) rest[c] -= sums[c][g];
    found.without[g] = share(rest);
  }
  return found;
}

std::vector<ShareTally::Sums> ShareTally::by_group(std::size_t answer) const {
  std::vector<Sums> of_group(static_cast<std::size_t>(groups_.count()));
  if (parameters_.empty()) return of_group;
  for (std::size_t g = 0; g < of_group.size(); ++g)
    for (int c = 0; c <= parameters_[0].classes; ++c) of_group[g] += cell(0, static_cast<std::size_t>(c), g, answer);
  return of_group;
}

ShareRow ShareTally::row(std::size_t answer, double confidence) const {
  const std::vector<Sums> of_group = by_group(answer);
  Sums all;
  ShareRow row;
  for (const Sums& one : of_group) {
    all += one;
    row.motions += one.n > 0;
  }
  row.samples = static_cast<std::int64_t>(all.n);
  row.mean = all.n > 0 ? all.sum / all.n : nan;
  row.variance = all.n > 0 ? all.squares / all.n - row.mean * row.mean : nan;

  const auto left_out_of = [&](const Shares& shares) {
    fragility::LeftOut left_out(2);
    for (std::size_t g = 0; g < of_group.size(); ++g)
      if (of_group[g].n > 0)
        left_out[static_cast<std::size_t>(groups_.stratum(static_cast<int>(g)))].push_back(shares.without[g]);
    return left_out;
  };
  Shares together{0, std::vector<double>(of_group.size(), 0), 0};
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    const Shares one = shares(p, answer, of_group);
    row.share.push_back(fragility::jackknife_share(one.whole, left_out_of(one), confidence, all.n / one.classes));
    together.whole += one.whole;
    for (std::size_t g = 0; g < of_group.size(); ++g) together.without[g] += one.without[g];
  }
  row.together = fragility::jackknife_share(together.whole, left_out_of(together), confidence);
  return row;
}

}  // namespace freestand::decision
