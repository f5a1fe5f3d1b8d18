#include "decision/shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace freestand::decision {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double scale = 1 << 20;
constexpr int fewest_classes = 4;

std::int64_t fixed(double value) { return std::llround(value * scale); }

// How many neighbouring classes are joined.
int joined(const Parameter& parameter, double samples) {
  const bool even = parameter.design != 0;
  const double least = even ? 25 : 12;  // samples of a class
  const int most = even ? 32 : parameter.classes;
  int join = 1;
  while (parameter.ordered && parameter.classes / join > fewest_classes &&
         (parameter.classes / join > most || samples * join < least * parameter.classes))
    join *= 2;
  return join;
}

// With an error of its own beside that of the estimate, which the interval holds.
fragility::Estimate wider(fragility::Estimate estimate, double error) {
  const double se = std::hypot(estimate.se, error), times = estimate.se > 0 ? se / estimate.se : 1;
  const double lower = estimate.value - times * (estimate.value - estimate.lower),
               upper = estimate.value + times * (estimate.upper - estimate.value);
  if (!std::isnan(estimate.se)) estimate.se = se;
  estimate.lower = std::min(estimate.value, std::clamp(lower, 0.0, 1.0));
  estimate.upper = std::max(estimate.value, std::clamp(upper, 0.0, 1.0));
  return estimate;
}

}  // namespace

ShareTally::ShareTally(std::vector<Parameter> parameters, std::vector<Answer> answers,
                       const fragility::LeaveOutGroups& groups, bool one_design)
    : parameters_(std::move(parameters)), answers_(std::move(answers)), groups_(groups), one_design_(one_design) {
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

double ShareTally::jump(const std::vector<Sums>& of_class) {
  std::vector<double> within;
  Sums all;
  for (const Sums& one : of_class) {
    all += one;
    if (one.n > 0) within.push_back(one.about_mean());
  }
  double most = 0;
  for (std::size_t k = 0; k < within.size() && within.size() > 1; ++k) {
    const double before = within[k > 0 ? k - 1 : k + 1], behind = within[k + 1 < within.size() ? k + 1 : k - 1];
    most = std::max(most, within[k] - 0.5 * (before + behind));
  }
  const double total = all.about_mean();
  return total > 0 ? most / total : 0;
}

double ShareTally::share(const std::vector<Sums>& of_class, double evenness) {
  Sums all;
  double classes = 0, within = 0;
  for (const Sums& one : of_class) {
    if (one.n == 0) continue;
    all += one;
    classes += 1;
    within += one.about_mean();
  }
  const double total = all.about_mean();
  // Below that the values are all the same but for the rounding of the sums.
  if (all.n <= classes + 1 || !(total > 4 * all.n / (scale * scale))) return nan;
  const double by_chance = evenness * (classes - 1) / (all.n - 1);
  return (1 - within / total - by_chance) / (1 - by_chance);
}

// c of the means of K classes scattering by r = c (K - 1)/(N - 1).
ShareTally::Evenness ShareTally::evenness(int design, std::size_t answer, double samples) const {
  double sum = 0, squares = 0, idle = 0;
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    if (!parameters_[p].idle || parameters_[p].design != design) continue;
    std::vector<Sums> total;
    double classes = 0;
    for (const auto& of_class : by_class_and_group(p, answer, samples)) {
      total.emplace_back();
      for (const Sums& one : of_class) total.back() += one;
      classes += total.back().n > 0;
    }
    if (classes < 2) continue;
    const double one = share(total, 0) * (samples - 1) / (classes - 1);
    sum += one;
    squares += one * one;
    ++idle;
  }
  if (idle == 0) return {1, 0};
  const double c = sum / idle;
  return {std::min(1.0, c), idle > 1 ? std::sqrt(std::max(0.0, (squares - idle * c * c) / (idle - 1))) : 0};
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
  double lost = 0;              // error of what is lost inside the classes
};

// Of parts of one even design: about the whole, and closer by the root of c.
void ShareTally::draw_in(Shares& shares, double evenness) const {
  double sum = 0, count = 0;
  const auto is_part = [&](std::size_t g) {
    return groups_.stratum(static_cast<int>(g)) == 1 && !std::isnan(shares.without[g]);
  };
  for (std::size_t g = 0; g < shares.without.size(); ++g)
    if (is_part(g)) sum += shares.without[g], ++count;
  for (std::size_t g = 0; g < shares.without.size(); ++g)
    if (is_part(g))
      shares.without[g] = shares.whole + std::sqrt(std::max(evenness, 0.0)) * (shares.without[g] - sum / count);
}

ShareTally::Shares ShareTally::shares(std::size_t p, std::size_t answer, const std::vector<Sums>& of_group,
                                      double evenness) const {
  double samples = 0;
  for (const Sums& one : of_group) samples += one.n;
  const auto sums = by_class_and_group(p, answer, samples);
  std::vector<Sums> total(sums.size());
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (const Sums& one : sums[c]) total[c] += one;
  // Of classes, and of half as many.
  struct Refined {
    double value, lost;
  };
  const auto refined = [&](const std::vector<Sums>& classes, double c) -> Refined {
    const double fine = share(classes, c);
    if (!parameters_[p].ordered || classes.size() < 2 * fewest_classes + 1) return {fine, 0};
    std::vector<Sums> pairs((classes.size() - 1) / 2 + 1);
    for (std::size_t i = 0; i + 1 < classes.size(); ++i) pairs[i / 2] += classes[i];
    pairs.back() += classes.back();
    const double step = fine - share(pairs, c);
    return {fine + std::min(step, 1 - fine) * 2 / 3, std::abs(step) / 3};
  };
  const Refined whole = refined(total, evenness);
  const double lost = parameters_[p].ordered ? std::max(whole.lost, jump(total) / 2) : whole.lost;
  Shares found{whole.value, std::vector<double>(of_group.size(), nan), 0, lost};
  for (const Sums& one : total) found.classes += one.n > 0;
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].n == 0) continue;
    std::vector<Sums> rest(total);
    for (std::size_t c = 0; c < sums.size(); ++c) rest[c] -= sums[c][g];
    // Parts of an even design scatter as independent draws do.
    found.without[g] = refined(rest, one_design_ && groups_.stratum(static_cast<int>(g)) == 1 ? 1 : evenness).value;
  }
  if (one_design_) draw_in(found, evenness);
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
  Shares together{0, std::vector<double>(of_group.size(), 0)};
  double squares = 0;
  std::map<int, Evenness> of_design;
  for (const Parameter& parameter : parameters_)
    if (!of_design.contains(parameter.design))
      of_design.emplace(parameter.design, evenness(parameter.design, answer, all.n));
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    if (parameters_[p].idle) continue;
    const int design = parameters_[p].design;
    const Evenness even = of_design.at(design);
    const Shares one = shares(p, answer, of_group, even.c);
    const double between = even.scatter * std::max(one.classes - 1, 0.0) / std::max(all.n - 1, 1.0);
    const double error = std::hypot(between, one.lost);
    fragility::Estimate share =
        design == 0 ? fragility::jackknife_share(one.whole, left_out_of(one), confidence, all.n / one.classes)
                    : fragility::jackknife(one.whole, left_out_of(one), confidence);
    share.value = std::min(share.value, 1.0);
    row.share.push_back(wider(share, error));
    squares += error * error;
    together.whole += one.whole;
    for (std::size_t g = 0; g < of_group.size(); ++g) together.without[g] += one.without[g];
  }
  row.together =
      wider(fragility::jackknife_share(together.whole, left_out_of(together), confidence), std::sqrt(squares));
  return row;
}

}  // namespace freestand::decision
