#include "measurement/verdict/outcome_screen.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "measurement/fit/starts.hpp"

namespace freestand::measurement {
namespace {

constexpr double screen_room = 0.35;  // in ln(width)
constexpr double rounding = 0.01;     // share of outcomes that two ways of computing may tell differently
constexpr std::size_t looks = 3;      // points of the effect's range beside its ends

std::vector<std::size_t> unsure_tests(const Bench& bench, const ModelFit& fit, std::size_t count) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  std::vector<std::size_t> order(tests.size());
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
  const auto doubt = [&](std::size_t t) {
    const double p = fit.calibration[t].probability;
    return p * (1 - p);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return doubt(a) > doubt(b); });
  order.resize(std::min(order.size(), count));
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> chosen;
  for (const std::size_t t : order) chosen.push_back(tests[t]);
  return chosen;
}

Places coarse_places(const ModelFit& fit) {
  const double middle = placement_middle(fit.model, fit.x), scatter = placement_scatter(fit.model, fit.x);
  if (scatter <= 0 && placement_number(fit.model) < 0) return {.first = middle};
  const double reach = screen_room + 2 * scatter;
  return places_between(middle - reach, middle + reach, 2 * place_step(scatter > 0 ? scatter : screen_room / 5));
}

// A table of so many tests, with the points of the model without the effect.
OutcomeTable coarse_table(const Bench& bench, const ModelFit& without, const dynamics::Effect& effect,
                          std::size_t tests) {
  OutcomeTable table{with_effect(without.model, effect, bench.reach()), without.model,
                     unsure_tests(bench, without, tests), coarse_places(without)};
  add_plain_points(table, without);
  return table;
}

// The effect at both ends of its range, the rest as fitted.
void add_looks(OutcomeTable& table, const ModelFit& without) {
  for (const bool high : {false, true}) {
    table.points.push_back({without.x});
    for (std::size_t i = without.x.size(); i < table.model.free.size(); ++i)
      table.points.back().x.push_back(high ? table.model.free[i].high : table.model.free[i].low);
  }
}

// The plain points of all tables are the same.
void compute_all(const Bench& bench, const std::vector<OutcomeTable*>& tables, const std::string& what,
                 const Jobs& jobs) {
  if (tables.empty()) return;
  OutcomeTable plain = *tables.front();
  std::erase_if(plain.points, [](const TablePoint& point) { return !point.plain; });
  compute(bench, {&plain}, what, jobs);
  for (OutcomeTable* table : tables)
    for (std::size_t k = 0; k < plain.points.size(); ++k) table->points[k].outcomes = plain.points[k].outcomes;
  compute(bench, tables, what, jobs);
}

// The numbers of the model without about where they were fitted, and all of the effect's range.
std::vector<Free> box_of(const ModelSpec& model, const ModelFit& without, const std::vector<std::size_t>& numbers) {
  std::vector<Free> box;
  for (const std::size_t i : numbers) {
    Free free = model.free[i];
    if (i < without.x.size()) {
      const double z = to_unit(free, without.x[i]);
      const double half = free.logarithmic ? std::log(1.8) / std::log(free.high / free.low) : 0.2;
      const double low = from_unit(free, z - half), high = from_unit(free, z + half);
      free.low = low;
      free.high = high;
    }
    box.push_back(free);
  }
  return box;
}

// Share of the outcomes that differ from those without the effect, at the most; points of add_looks follow the plain ones.
double most_changed(const OutcomeTable& table, std::size_t plain) {
  double most = 0;
  const auto& without = table.points.front().outcomes;
  for (std::size_t k = plain; k < table.points.size(); ++k) {
    int differ = 0;
    for (std::size_t t = 0; t < without.size(); ++t) differ += std::popcount(without[t] ^ table.points[k].outcomes[t]);
    most = std::max(most, differ / static_cast<double>(without.size() * static_cast<std::size_t>(table.places.count)));
  }
  return most;
}

void weigh(const Bench& bench, Screened& s) {
  const TableFit with = TableSearch(bench, s.table).best(), without = TableSearch(bench, s.table, true).best();
  const auto n = static_cast<double>(s.table.tests.size());
  std::vector<double> gains;
  for (std::size_t t = 0; t < s.table.tests.size(); ++t) {
    const Test& test = bench.test(s.table.tests[t]);
    gains.push_back(outcome_error(test, without.probability[t]).score - outcome_error(test, with.probability[t]).score);
    s.gain += gains.back() / n;
  }
  for (const double gain : gains) s.gain_se += (gain - s.gain) * (gain - s.gain) / (n * std::max(n - 1, 1.0));
  s.gain_se = std::sqrt(s.gain_se);
}

}  // namespace

bool Screened::visible() const { return changed > rounding; }
bool Screened::promising() const {
  const auto numbers = static_cast<double>(table.model.free.size() - table.without.free.size());
  return visible() && (!is_slow(table) || gain > std::sqrt(numbers) * gain_se);
}

std::vector<Screened> screen_outcomes(const Bench& bench, const ModelFit& without,
                                      const std::vector<const dynamics::Effect*>& effects, const OutcomeEffort& effort,
                                      const Jobs& jobs) {
  std::vector<Screened> all;
  std::vector<OutcomeTable*> tables;
  for (const auto* effect : effects) all.push_back({coarse_table(bench, without, *effect, effort.seen_tests)});
  for (Screened& s : all) tables.push_back(&s.table);
  for (OutcomeTable* table : tables) add_looks(*table, without);
  compute_all(bench, tables, "which effects the tests can see", jobs);
  tables.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Screened& s = all[i];
    const std::size_t plain = s.table.points.size() - 2;
    s.changed = most_changed(s.table, plain);
    if (!s.visible()) continue;
    s.table = coarse_table(bench, without, *effects[i], effort.screened_tests);
    const auto numbers = other_numbers(s.table.model);
    Values x = without.x;
    x.resize(s.table.model.free.size(), 0.0);
    add_points(s.table, box_of(s.table.model, without, numbers), numbers, x,
               std::min(is_slow(s.table) ? effort.most / 3 : effort.most, effort.wide * numbers.size()));
    tables.push_back(&s.table);
  }
  compute_all(bench, tables, "effects on the tests that are least sure", jobs);
  for (Screened& s : all)
    if (s.visible()) weigh(bench, s);
  return all;
}

}  // namespace freestand::measurement
