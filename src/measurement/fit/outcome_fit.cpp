#include "measurement/fit/outcome_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/random.hpp"
#include "measurement/fit/outcome_draws.hpp"
#include "measurement/fit/posterior.hpp"
#include "measurement/fit/starts.hpp"

namespace freestand::measurement {
namespace {

constexpr double usual_scatter = 0.25, wide_room = 1, room = 0.2;  // in ln(width)
constexpr double least_box = 0.03;                                 // of the range
// Rounds in which points close in on the best, while it gains a tenth: a scatter can be halved in each, since places are as far apart.
constexpr int closing_rounds = 6;
constexpr double worth_a_round = 0.1;

Values middle_of_range(const ModelSpec& model) {
  Values x;
  for (const Free& free : model.free) x.push_back(from_unit(free, 0.5));
  return x;
}

// The box of the best fifth of the points, a fifth wider.
std::vector<Free> elite_box(const ModelSpec& model, const std::vector<std::size_t>& numbers, const OutcomeTable& table,
                            const std::vector<double>& scores) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < scores.size(); ++k)
    if (std::isfinite(scores[k]) && !table.points[k].plain) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] < scores[b]; });
  order.resize(std::min(order.size(), std::max<std::size_t>(4, order.size() / 5)));
  std::vector<Free> box;
  for (const std::size_t i : numbers) {
    Free free = model.free[i];
    double low = 1e9, high = -1e9;
    for (const std::size_t k : order) {
      low = std::min(low, to_unit(free, table.points[k].x[i]));
      high = std::max(high, to_unit(free, table.points[k].x[i]));
    }
    const double half = std::max(0.6 * (high - low), least_box), middle = 0.5 * (low + high);
    const double lower = from_unit(model.free[i], middle - half), upper = from_unit(model.free[i], middle + half);
    free.low = lower;
    free.high = upper;
    free.logarithmic = free.logarithmic && lower > 0;
    box.push_back(free);
  }
  return box;
}

// With all that the tests do not rule out: where draws and fits to resampled tests come from.
std::vector<Free> grown(std::vector<Free> box, const std::vector<std::size_t>& numbers,
                        const std::vector<Interval>& open) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    box[k].low = std::min(box[k].low, open[numbers[k]].lower);
    box[k].high = std::max(box[k].high, open[numbers[k]].upper);
    box[k].logarithmic = box[k].logarithmic && box[k].low > 0;
  }
  return box;
}

std::vector<Free> range(const ModelSpec& model, const std::vector<std::size_t>& numbers) {
  std::vector<Free> box;
  for (const std::size_t i : numbers) box.push_back(model.free[i]);
  return box;
}

std::size_t points_of_round(std::size_t per_number, const std::vector<std::size_t>& numbers, std::size_t most) {
  return std::min(most, per_number * std::max<std::size_t>(numbers.size(), 1));
}

// open: of each number, what the tests do not rule out so far; may be empty. Middles stand in the inner half of the places, which so
// holds all of it.
Places fine_places(const OutcomeTable& table, const Values& x, const std::vector<Interval>& open) {
  const ModelSpec& model = table.model;
  const double middle = placement_middle(model, x), scatter = placement_scatter(model, x);
  if (scatter <= 0 && placement_number(model) < 0) return {.first = middle};
  const double step = place_step(scatter > 0 ? scatter : room / 10) * (is_slow(table) ? 2 : 1);
  const double reach = placement_number(model) < 0 ? 4 * scatter : room + 2 * scatter;  // a middle that is known stays
  double first = middle - reach, last = middle + reach;
  if (const int placed = placement_number(model); placed >= 0 && !open.empty()) {
    const Interval& known = open[static_cast<std::size_t>(placed)];
    const double low = std::log(std::max(known.lower, 1e-3 * known.upper)), high = std::log(known.upper);
    first = std::min(first, low - (high - low) / 2);
    last = std::max(last, high + (high - low) / 2);
  }
  return places_between(first, last, step);
}

// All from the table: the fit, its folds, its draws. One job.
class Reading {
 public:
  // wide: the same points, at places by which draws are told.
  Reading(const Bench& bench, const OutcomeTable& table, const OutcomeTable& wide, std::size_t draws)
      : bench_(bench), table_(table), search_(bench, table), fold_(fold_of(table.tests.size())) {
    all_ = search_.best();
    add(all_);
    for (const double p : all_.probability) answer_.push_back(p);
    const std::size_t folds = fold_.empty() ? 0 : *std::max_element(fold_.begin(), fold_.end()) + 1;
    for (std::size_t f = 0; f < folds; ++f) {
      std::vector<double> weight;
      for (const std::size_t of : fold_) weight.push_back(of == f ? 0 : 1);
      add(search_.best(weight));
      const std::vector<double> probability = averaged(weight, f);
      for (std::size_t t = 0; t < fold_.size(); ++t)
        if (fold_[t] == f) answer_.push_back(probability[t]);
    }
    for (const Values& x : OutcomeDraws(bench, wide, all_).draw(draws))
      answer_.insert(answer_.end(), x.begin(), x.end());
  }
  const Values& answer() const { return answer_; }

 private:
  // What the fits to resampled tests predict in the mean (bagging): the best point jumps where one test falls that stood
  // before, and a prediction by it alone jumps with it (Breiman 1996, Machine Learning 24).
  std::vector<double> averaged(const std::vector<double>& weight, std::size_t fold) const {
    std::vector<double> mean(weight.size(), 0.0);
    for (std::size_t b = 0; b < bags; ++b) {
      const TableFit fit = search_.best(resampled(weight, fold + 2, b));
      for (std::size_t t = 0; t < mean.size(); ++t) mean[t] += fit.probability[t] / static_cast<double>(bags);
    }
    return mean;
  }

  // As many tests as have a weight, drawn from these with replacement.
  static std::vector<double> resampled(const std::vector<double>& weight, std::uint64_t stream, std::size_t b) {
    std::vector<std::size_t> from;
    for (std::size_t t = 0; t < weight.size(); ++t)
      if (weight[t] > 0) from.push_back(t);
    std::vector<double> drawn(weight.size(), 0.0);
    const auto n = static_cast<double>(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
      ++drawn[from[std::min(from.size() - 1, static_cast<std::size_t>(random::uniform(stream, b, k) * n))]];
    return drawn;
  }

  void add(const TableFit& fit) { answer_.insert(answer_.end(), fit.x.begin(), fit.x.end()); }

  static constexpr std::size_t bags = 25;

  const Bench& bench_;
  const OutcomeTable& table_;
  TableSearch search_;
  std::vector<std::size_t> fold_;
  TableFit all_;
  Values answer_;
};

ModelFit unpacked(const Bench& bench, const OutcomeTable& table, const Values& answer) {
  ModelFit fit{.model = table.model};
  const std::size_t numbers = table.model.free.size(), n = table.tests.size();
  auto at = answer.begin();
  const auto take = [&](std::size_t count) {
    const Values values(at, at + static_cast<long>(count));
    at += static_cast<long>(count);
    return values;
  };
  fit.x = take(numbers);
  const Values p = take(n);
  for (std::size_t t = 0; t < n; ++t) {
    fit.calibration.push_back(outcome_error(bench.test(table.tests[t]), p[t]));
    fit.score += fit.calibration.back().score / static_cast<double>(n);
  }
  fit.left_out = fit.calibration;
  const auto fold = fold_of(n);
  const std::size_t folds = fold.empty() ? 0 : *std::max_element(fold.begin(), fold.end()) + 1;
  for (std::size_t f = 0; f < folds; ++f) {
    fit.fold_x.push_back(take(numbers));
    for (std::size_t t = 0; t < n; ++t)
      if (fold[t] == f) fit.left_out[t] = outcome_error(bench.test(table.tests[t]), *at++);
  }
  while (at != answer.end() && numbers > 0) fit.draws.push_back(take(numbers));
  fit.evaluations = static_cast<int>(table.points.size());
  fit.left_out_refitted = true;
  Posterior open;
  open.of_mean = fit.draws;
  take_intervals(open, fit);
  return fit;
}

std::vector<OutcomeTable*> pointers(std::vector<OutcomeTable>& tables) {
  std::vector<OutcomeTable*> all;
  for (OutcomeTable& table : tables) all.push_back(&table);
  return all;
}

// Other places where what the tests leave open lies beyond them, or they may be finer. Outcomes are computed anew.
void place_again(const TableSearch& search, const TableFit& best, OutcomeTable& table) {
  const Places places = fine_places(table, best.x, search.within_chance(best)), before = table.places;
  const auto last = [](const Places& p) { return p.at(p.count - 1); };
  if (places.step >= before.step && places.first > before.first - room && last(places) < last(before) + room) return;
  table.places = places;
  for (TablePoint& point : table.points) point.outcomes.clear();
}

// Where the middle is known the places of a fit close in on its scatter, and beyond the last place nothing changes, so that all wider scatters
// look alike there. Draws go by places that tell scatters (widest_scatter()) up to four times the widest that is open, first by what coarse
// tables leave open, then by what is open there: wider ones nearly never made these outcomes. Of others the same tables.
// open: of each number of each table, by the coarse tables.
std::vector<OutcomeTable> at_wide_places(const Bench& bench, std::vector<OutcomeTable> tables,
                                         const std::vector<std::vector<Interval>>& open, const Jobs& jobs) {
  for (const bool first : {true, false}) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      OutcomeTable& table = tables[i];
      const int scatter = scatter_number(table.model);
      if (placement_number(table.model) >= 0 || scatter < 0) continue;
      const TableSearch search(bench, table);
      const TableFit best = search.best();
      const auto number = static_cast<std::size_t>(scatter);
      const double widest = first ? open[i][number].upper : search.within_chance(best)[number].upper;
      const double middle = placement_middle(table.model, best.x), reach = 8 * widest;
      table.places = places_between(middle - reach, middle + reach, place_step(widest));
      for (TablePoint& point : table.points) point.outcomes.clear();
    }
    compute(bench, pointers(tables), "outcomes at wider places", jobs);
  }
  return tables;
}

// Each number at the ends of its range, where what is known beforehand often lies (an impact as Housner's, no tilt): no point within comes so
// near. They join where they are better by a round's gain.
void look_at_ends(const Bench& bench, std::vector<OutcomeTable>& tables, const Jobs& jobs) {
  std::vector<OutcomeTable> ends;
  for (const OutcomeTable& table : tables) {
    const TableFit best = TableSearch(bench, table).best();
    ends.push_back({table.model, table.without, table.tests, table.places});
    for (const std::size_t i : other_numbers(table.model))
      for (const double end : {table.model.free[i].low, table.model.free[i].high}) {
        ends.back().points.push_back({best.x});
        ends.back().points.back().x[i] = end;
      }
  }
  compute(bench, pointers(ends), "outcomes at the ends of ranges", jobs);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (ends[i].points.empty()) continue;
    const TableFit best = TableSearch(bench, ends[i]).best();
    if (best.score < (1 - worth_a_round) * TableSearch(bench, tables[i]).best().score)
      tables[i].points.push_back(ends[i].points[best.point]);
  }
}

// From coarse tables to fits.
std::vector<TabulatedFit> close_in(const Bench& bench, const std::vector<OutcomeTable*>& coarse,
                                   const ModelFit* without, const OutcomeEffort& effort, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  std::vector<OutcomeTable> fine;
  std::vector<std::vector<Interval>> open_so_far;
  for (const OutcomeTable* table : coarse) {
    const TableSearch search(bench, *table);
    const TableFit best = search.best();
    const auto numbers = other_numbers(table->model);
    const std::vector<Interval>& open = open_so_far.emplace_back(search.within_chance(best));
    fine.push_back({table->model, table->without, tests, fine_places(*table, best.x, open)});
    if (without) add_plain_points(fine.back(), *without);
    if (!table->points[best.point].plain) fine.back().points.push_back({best.x});
    const auto box = elite_box(table->model, numbers, *table, search.scores());
    const std::size_t near = points_of_round(effort.near, numbers, is_slow(*table) ? effort.most / 3 : effort.most);
    add_points(fine.back(), box, numbers, best.x, near);
    if (numbers.empty()) continue;
    add_points(fine.back(), grown(box, numbers, search.seen_within_chance(best)), numbers, best.x, near / 2);
    add_points(fine.back(), grown(box, numbers, open), numbers, best.x, near / 4);
  }
  compute(bench, pointers(fine), "outcomes near the best", jobs);
  look_at_ends(bench, fine, jobs);
  std::vector<double> least(fine.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < closing_rounds; ++round) {
    bool closer = false;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      OutcomeTable& table = fine[i];
      const TableSearch search(bench, table);
      const TableFit best = search.best();
      const bool finer_wanted = placement_scatter(table.model, best.x) < 1.3 * table.places.step;
      if (round > 0 && !(finer_wanted && best.score < least[i])) continue;
      closer = true;
      least[i] = best.score * (1 - worth_a_round);
      const auto numbers = other_numbers(table.model);
      const std::vector<double> scores = search.scores();
      place_again(search, best, table);
      if (!numbers.empty())
        add_points(table, elite_box(table.model, numbers, table, scores), numbers, best.x,
                   points_of_round(effort.nearest, numbers, is_slow(table) ? effort.most / 4 : effort.most));
    }
    if (!closer) break;
    compute(bench, pointers(fine), fmt::format("outcomes nearest to the best, round {}", round + 1), jobs);
  }
  for (OutcomeTable& table : fine) {
    const TableSearch search(bench, table);
    place_again(search, search.best(), table);
  }
  compute(bench, pointers(fine), "outcomes at finer places", jobs);
  std::vector<OutcomeTable> wide = at_wide_places(bench, fine, open_so_far, jobs);
  const auto answers = jobs("folds and draws", fine.size(),
                            [&](std::size_t i) { return Reading(bench, fine[i], wide[i], effort.draws).answer(); });
  std::vector<TabulatedFit> fits;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    ModelFit fit = unpacked(bench, fine[i], answers[i]);
    fits.push_back({std::move(fit), std::move(fine[i])});
  }
  return fits;
}

}  // namespace

bool outcomes_only(const Dataset& data) {
  const auto tests = tests_of(data, Role::calibration);
  return !tests.empty() &&
         std::all_of(tests.begin(), tests.end(), [&](std::size_t i) { return kind(data.tests[i]) == Kind::outcome; });
}

ModelFit fit_outcomes(const Bench& bench, const ModelSpec& model, const Values& start, const OutcomeEffort& effort,
                      const Jobs& jobs) {
  TabulatedFit found = tabulate_outcomes(bench, model, start, effort, jobs);
  const Values m = jobs("whether the model is enough", 1, [&](std::size_t) {
                     const OutcomeMisfit of = outcome_misfit(bench, found);
                     return Values{of.p,           of.of_score,      of.of_count, of.reached,  of.score,
                                   of.usual_score, of.score_scatter, of.fell,     of.expected, of.count_scatter};
                   }).front();
  found.fit.misfit = {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9]};
  return std::move(found.fit);
}

TabulatedFit tabulate_outcomes(const Bench& bench, const ModelSpec& model, const Values& start,
                               const OutcomeEffort& effort, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto numbers = other_numbers(model);
  const Values x = start.empty() ? middle_of_range(model) : start;
  OutcomeTable coarse{model, model, tests};
  const int placed = placement_number(model);
  const double scatter =
      model.placement_scatter && model.placement_scatter->free < 0 ? model.placement_scatter->value : usual_scatter;
  if (placed < 0) {
    const double middle = placement_middle(model, x);
    coarse.places = scatter > 0 ? places_between(middle - wide_room, middle + wide_room, place_step(scatter))
                                : Places{.first = middle};
  } else {
    const Free& free = model.free[static_cast<std::size_t>(placed)];
    coarse.places =
        places_between(std::log(std::max(free.lower, 1e-3 * free.upper)) - wide_room, std::log(free.upper) + wide_room,
                       4 * place_step(scatter > 0 ? scatter : usual_scatter));
  }
  if (!start.empty()) coarse.points.push_back({start});
  add_points(coarse, range(model, numbers), numbers, x, points_of_round(effort.wide, numbers, effort.most));
  compute(bench, {&coarse}, "outcomes over the whole range", jobs);
  return close_in(bench, {&coarse}, nullptr, effort, jobs).front();
}

std::vector<TabulatedFit> tabulate_outcomes(const Bench& bench, const ModelFit& without,
                                            const std::vector<OutcomeTable*>& coarse, const OutcomeEffort& effort,
                                            const Jobs& jobs) {
  return close_in(bench, coarse, &without, effort, jobs);
}

std::vector<ModelFit> read_outcomes(const Bench& bench, const std::vector<OutcomeTable*>& coarse, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  std::vector<OutcomeTable> fine;
  for (const OutcomeTable* table : coarse) {
    const TableFit best = TableSearch(bench, *table).best();
    fine.push_back({table->model, table->without, tests, fine_places(*table, best.x, {})});
    fine.back().points.push_back({best.x, table->points[best.point].plain});
  }
  compute(bench, pointers(fine), "outcomes of the others", jobs);
  std::vector<ModelFit> fits;
  for (const OutcomeTable& table : fine) {
    const TableFit best = TableSearch(bench, table).best();
    fits.push_back({.model = table.model, .x = best.x, .score = best.score, .evaluations = 1});
    for (std::size_t t = 0; t < tests.size(); ++t)
      fits.back().calibration.push_back(outcome_error(bench.test(tests[t]), best.probability[t]));
    fits.back().left_out.assign(tests.size(), {std::nan(""), std::nan(""), std::nan(""), std::nan("")});
  }
  return fits;
}

}  // namespace freestand::measurement
