#include "measurement/fit/outcome_table.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "measurement/fit/starts.hpp"

namespace freestand::measurement {
namespace {

constexpr std::size_t part = 64;                          // tests a job
constexpr double middle_step = 0.03, scatter_step = 0.2;  // in the logarithm
constexpr int polish_budget = 40;
// Of the span of the places: room that a middle leaves to either side, and the widest scatter.
constexpr double margin = 0.25;

double span(const Places& places) { return places.step * (places.count - 1); }

// Below that the places are too far apart to tell.
double least_scatter(const Places& places) { return 1.25 * places.step; }

// Words of 64 bits travel as halves, which a double holds exactly.
void append_word(Values& values, std::uint64_t word) {
  values.push_back(static_cast<double>(word >> 32));
  values.push_back(static_cast<double>(word & 0xffffffffU));
}

std::uint64_t word_at(const Values& values, std::size_t at) {
  return static_cast<std::uint64_t>(values[2 * at]) << 32 | static_cast<std::uint64_t>(values[2 * at + 1]);
}

std::vector<double> between(double low, double high, double step) {
  const int n = std::max(0, static_cast<int>(std::ceil((high - low) / step - 1e-9)));
  std::vector<double> values;
  for (int i = 0; i <= n; ++i) values.push_back(n == 0 ? low : low + (high - low) * i / n);
  return values;
}

// Scatters that the places of a table can tell apart, within what is allowed.
std::vector<double> scatters_of(const OutcomeTable& table, const Values& x) {
  const int number = scatter_number(table.model);
  if (number < 0) return {placement_scatter(table.model, x)};
  const Free& free = table.model.free[static_cast<std::size_t>(number)];
  const double high = std::clamp(widest_scatter(table.places), free.lower, free.upper);
  std::vector<double> logs =
      between(std::log(std::clamp(least_scatter(table.places), free.lower, high)), std::log(high), scatter_step);
  for (double& value : logs) value = std::exp(value);
  return logs;
}

std::vector<double> middles_of(const OutcomeTable& table, const Values& x) {
  const int number = placement_number(table.model);
  if (number < 0) return {placement_middle(table.model, x)};
  const Free& free = table.model.free[static_cast<std::size_t>(number)];
  const double least = std::log(std::max(free.lower, 1e-9)), most = std::log(free.upper);
  const double room = margin * span(table.places), first = table.places.first + room;
  const double last = table.places.at(table.places.count - 1) - room;
  return between(std::clamp(first, least, most), std::clamp(last, least, most), middle_step);
}

// Fits of the model without the effect, to all tests and with folds left out: distinct points.
std::vector<Values> plain_points(const ModelFit& without) {
  std::vector<Values> points = {without.x};
  const auto numbers = other_numbers(without.model);
  for (const Values& x : without.fold_x) {
    const bool known = std::any_of(points.begin(), points.end(), [&](const Values& p) {
      return std::all_of(numbers.begin(), numbers.end(), [&](std::size_t i) { return p[i] == x[i]; });
    });
    if (!known) points.push_back(x);
  }
  return points;
}

}  // namespace

double widest_scatter(const Places& places) { return margin * span(places); }

void add_points(OutcomeTable& table, const std::vector<Free>& box, const std::vector<std::size_t>& numbers,
                const Values& x, std::size_t count) {
  if (numbers.empty()) {
    if (table.points.empty()) table.points.push_back({x});
    return;
  }
  table.boxes.push_back({box, numbers, count});
  for (const Values& z : sobol_starts(box, count)) {
    table.points.push_back({.x = x, .of_box = true});
    for (std::size_t i = 0; i < numbers.size(); ++i) table.points.back().x[numbers[i]] = z[i];
  }
}

void add_plain_points(OutcomeTable& table, const ModelFit& without) {
  for (const Values& x : plain_points(without)) {
    ModelFit at = without;
    at.x = x;
    table.points.push_back({.x = start_at_nothing(at, *table.model.effects.back().effect), .plain = true});
  }
}

bool is_slow(const OutcomeTable& table) {
  const auto one_by_one = [](const EffectTerm& term) { return term.effect->dynamic() || term.effect->floor; };
  return std::any_of(table.model.effects.begin(), table.model.effects.end(), one_by_one);
}

void compute(const Bench& bench, const std::vector<OutcomeTable*>& tables, const std::string& what, const Jobs& jobs) {
  struct Place {
    OutcomeTable* table;
    std::size_t point, from;
  };
  std::vector<Place> places;
  for (OutcomeTable* table : tables)
    for (std::size_t k = 0; k < table->points.size(); ++k)
      for (std::size_t from = 0; table->points[k].outcomes.empty() && from < table->tests.size(); from += part)
        places.push_back({table, k, from});
  const auto answers = jobs(what, places.size(), [&](std::size_t i) {
    const auto& [table, k, from] = places[i];
    const auto first = table->tests.begin() + static_cast<long>(from);
    const std::vector<std::size_t> tests(first, first + static_cast<long>(std::min(part, table->tests.size() - from)));
    const TablePoint& point = table->points[k];
    Values words;
    for (const std::uint64_t word :
         outcomes(bench, tests, point.plain ? table->without : table->model, point.x, table->places.all()))
      append_word(words, word);
    return words;
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto& all = places[i].table->points[places[i].point].outcomes;
    for (std::size_t t = 0; 2 * t < answers[i].size(); ++t) all.push_back(word_at(answers[i], t));
  }
}

TableSearch::TableSearch(const Bench& bench, const OutcomeTable& table, bool plain_only) : table_(table) {
  for (const std::size_t i : table.tests) overturned_.push_back(bench.test(i).peaks.overturned.value_or(false));
  for (std::size_t k = 0; k < table.points.size(); ++k) {
    const TablePoint& point = table.points[k];
    if (plain_only && !point.plain) continue;
    for (const double middle : middles_of(table, point.x))
      for (const double scatter : scatters_of(table, point.x)) {
        rows_.push_back({k, middle, scatter});
        const auto shares = place_shares(table.places, middle, scatter);
        for (const std::uint64_t word : point.outcomes)
          probability_.push_back(static_cast<float>(overturning_share(word, shares)));
      }
  }
}

Values TableSearch::placed(const Row& row) const {
  Values x = table_.points[row.point].x;
  if (const int n = placement_number(table_.model); n >= 0) x[static_cast<std::size_t>(n)] = std::exp(row.middle);
  if (const int n = scatter_number(table_.model); n >= 0) x[static_cast<std::size_t>(n)] = row.scatter;
  return x;
}

std::vector<double> TableSearch::probabilities(std::size_t point, const Values& x) const {
  const auto shares =
      place_shares(table_.places, placement_middle(table_.model, x), placement_scatter(table_.model, x));
  std::vector<double> all;
  for (const std::uint64_t word : table_.points[point].outcomes)
    all.push_back(std::clamp(overturning_share(word, shares), 0.0, 1.0));
  return all;
}

TableFit TableSearch::best(const std::vector<double>& weight) const {
  const std::size_t n = overturned_.size();
  std::vector<float> share(n, 1.0F / static_cast<float>(n)), y(overturned_.begin(), overturned_.end());
  double total = 0;
  for (const double w : weight) total += w;
  for (std::size_t t = 0; t < weight.size(); ++t) share[t] = static_cast<float>(weight[t] / total);
  std::size_t row = 0;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    float sum = 0;
    const float* p = probability_.data() + r * n;
    for (std::size_t t = 0; t < n; ++t) sum += share[t] * (p[t] - y[t]) * (p[t] - y[t]);
    if (sum < least) row = r, least = sum;
  }
  TableFit fit{.point = rows_[row].point, .x = placed(rows_[row])};
  // Middle and scatter between the rows.
  std::vector<Free> free;
  std::vector<std::size_t> number;
  const double widths[] = {2 * middle_step, 2 * scatter_step};
  const int numbers[] = {placement_number(table_.model), scatter_number(table_.model)};
  for (int i = 0; i < 2; ++i) {
    if (numbers[i] < 0) continue;
    number.push_back(static_cast<std::size_t>(numbers[i]));
    Free one = table_.model.free[number.back()];
    one.low = fit.x[number.back()] * std::exp(-widths[i]);
    one.high = fit.x[number.back()] * std::exp(widths[i]);
    one.logarithmic = true;
    if (i == 1) one.lower = std::max(one.lower, std::min(one.upper, least_scatter(table_.places)));
    free.push_back(one);
  }
  const auto at = [&](std::span<const double> z) {
    Values x = fit.x;
    for (std::size_t i = 0; i < number.size(); ++i) x[number[i]] = z[i];
    return x;
  };
  const auto score = [&](std::span<const double> z) {
    const auto p = probabilities(fit.point, at(z));
    double sum = 0;
    for (std::size_t t = 0; t < n; ++t) sum += share[t] * (p[t] - overturned_[t]) * (p[t] - overturned_[t]);
    return sum;
  };
  Values start;
  for (const std::size_t i : number) start.push_back(fit.x[i]);
  const Fitted found = simplex(free, score, start, 0.2, polish_budget);
  fit.x = at(found.x);
  fit.score = found.score;
  fit.probability = probabilities(fit.point, fit.x);
  return fit;
}

std::vector<Interval> TableSearch::seen_within_chance(const TableFit& fit) const {
  const std::size_t n = overturned_.size();
  const double chance = n > 1 ? gsl_cdf_tdist_Pinv(0.975, static_cast<double>(n - 1)) : 0;
  std::vector<Interval> range;
  for (const double x : fit.x) range.push_back({x, x});
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    double sum = 0, square = 0;
    for (std::size_t t = 0; t < n; ++t) {
      const double worse =
          std::pow(probability_[r * n + t] - overturned_[t], 2) - std::pow(fit.probability[t] - overturned_[t], 2);
      sum += worse;
      square += worse * worse;
    }
    const double mean = sum / static_cast<double>(n), variance = square / static_cast<double>(n) - mean * mean;
    if (mean > chance * std::sqrt(std::max(variance, 0.0) / static_cast<double>(std::max<std::size_t>(n, 2) - 1)))
      continue;
    const Values x = placed(rows_[r]);
    for (std::size_t i = 0; i < x.size(); ++i)
      range[i] = {std::min(range[i].lower, x[i]), std::max(range[i].upper, x[i])};
  }
  return range;
}

std::vector<Interval> TableSearch::within_chance(const TableFit& fit) const {
  std::vector<Interval> range = seen_within_chance(fit);
  // first, last: is it open where the table ends? out: the ends if not.
  const auto widen = [&](std::size_t i, bool first, bool last, const Interval& out) {
    const Free& free = table_.model.free[i];
    const Interval open = range[i];
    range[i] = {std::clamp(first ? free.lower : out.lower, free.lower, std::max(free.lower, open.lower)),
                std::clamp(last ? free.upper : out.upper, std::min(free.upper, open.upper), free.upper)};
    range[i] = {std::min(fit.x[i], range[i].lower), std::max(fit.x[i], range[i].upper)};
  };
  const auto to_next_row = [&](int number, double first, double last, double step) {
    if (number < 0) return;
    constexpr double at_end = 1e-6;
    const auto i = static_cast<std::size_t>(number);
    const Interval open = range[i];
    widen(i, open.lower <= first * (1 + at_end), open.upper >= last * (1 - at_end),
          {open.lower * std::exp(-step), open.upper * std::exp(step)});
  };
  const auto [least_middle, most_middle] =
      std::minmax_element(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.middle < b.middle; });
  const auto [least_scatter, most_scatter] =
      std::minmax_element(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.scatter < b.scatter; });
  to_next_row(placement_number(table_.model), std::exp(least_middle->middle), std::exp(most_middle->middle),
              middle_step);
  to_next_row(scatter_number(table_.model), least_scatter->scatter, most_scatter->scatter, scatter_step);
  const std::vector<std::size_t> others = other_numbers(table_.model);
  if (others.empty()) return range;
  const double points = static_cast<double>(table_.points.size()), numbers = static_cast<double>(others.size());
  const auto further = static_cast<std::size_t>(std::ceil(std::pow(points, 1 - 1 / numbers)));
  for (const std::size_t i : others) {
    std::vector<double> below, above;
    for (const TablePoint& point : table_.points) {
      if (point.x[i] < range[i].lower) below.push_back(point.x[i]);
      if (point.x[i] > range[i].upper) above.push_back(point.x[i]);
    }
    std::sort(below.begin(), below.end(), std::greater<>());
    std::sort(above.begin(), above.end());
    const bool first = below.size() < further, last = above.size() < further;
    widen(i, first, last, {first ? 0 : below[further - 1], last ? 0 : above[further - 1]});
  }
  return range;
}

std::vector<double> TableSearch::scores() const {
  const std::size_t n = overturned_.size();
  std::vector<double> least(table_.points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    double sum = 0;
    for (std::size_t t = 0; t < n; ++t)
      sum += std::pow(probability_[r * n + t] - overturned_[t], 2) / static_cast<double>(n);
    least[rows_[r].point] = std::min(least[rows_[r].point], sum);
  }
  return least;
}

}  // namespace freestand::measurement
