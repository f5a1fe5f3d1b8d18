// The 28 measured peak slips of table 5.1 beside those of a sliding block under the pulses that the report fitted: with the
// friction of the slow pulls, with the friction that fits histories, and with the one that fits these peaks.
#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>
#include <limits>
#include <map>

#include "base/units.hpp"
#include "fragility/intervals.hpp"
#include "report/printed_table.hpp"
#include "report/table_pulses.hpp"

namespace freestand::report {
namespace {

struct Test {
  std::string specimen, motion;
  double measured_m, mu_slow_pull, mu_best_fit;
  Shaking shaking;
};

std::vector<Test> tests_of(const PrintedTable& table, TablePulses& pulses) {
  const auto specimen = table.texts("specimen"), motion = table.texts("motion"), type = table.texts("pulse_type");
  const auto period = table.numbers("pulse_period_s"), velocity = table.numbers("pulse_velocity_in_per_s"),
             slip = table.numbers("peak_slip_in");
  const auto slow = table.numbers("mu_slow_pull"), best = table.numbers("mu_best_fit");
  std::vector<Test> tests;
  for (std::size_t i = 0; i < specimen.size(); ++i)
    tests.push_back(
        {specimen[i], motion[i], slip[i] * inch_m, slow[i], best[i], pulses.shaking(type[i], period[i], velocity[i])});
  return tests;
}

double slip_m(const Test& test, double mu) {
  Specimen specimen{Block::rectangular(1, 1, 1), {mu, mu}, {}};  // a block that only slides has no size
  specimen.model = Model::slide;
  return respond(specimen, test.shaking).peak_slip_m;
}

double fitted_slip_m(const Test& test, double mu) { return std::isnan(mu) ? mu : slip_m(test, mu); }

// ln of predicted over measured; one that does not slide counts as a slip of a micrometre.
double ln_ratio(const Test& test, double mu) { return std::log(std::max(slip_m(test, mu), 1e-6) / test.measured_m); }

constexpr double least_friction = 0.02;  // that is tried; the report's lowest is 0.13

// Least squares of ln_ratio: the best of a grid, then narrowed in on between its neighbours. Not known where the least of the grid is
// best.
double fitted_friction(const std::vector<Test>& tests) {
  const auto misfit = [&](double ln_mu) {
    double sum = 0;
    for (const Test& test : tests) sum += std::pow(ln_ratio(test, std::exp(ln_mu)), 2);
    return sum;
  };
  const double least = std::log(least_friction), most = std::log(0.8), step = (most - least) / 100;
  double best = least;
  for (double at = least; at <= most; at += step)
    if (misfit(at) < misfit(best)) best = at;
  if (best == least) return std::numeric_limits<double>::quiet_NaN();
  double low = best - step, high = best + step;
  while (high - low > 1e-4) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    (misfit(left) < misfit(right) ? high : low) = misfit(left) < misfit(right) ? right : left;
  }
  return std::exp(0.5 * (low + high));
}

void add_ratio(Item& item, const std::string& id, const std::string& words, const std::vector<double>& ln_ratios) {
  double sum = 0;
  for (const double r : ln_ratios) sum += r;
  const double mean = sum / static_cast<double>(ln_ratios.size());
  item.numbers.push_back({.id = "shake_table." + id,
                          .what = "predicted over measured slip, geometric mean, " + words,
                          .ours = std::exp(mean)});
  item.numbers.push_back({.id = "shake_table." + id + "_scatter",
                          .what = "its scatter, standard deviation of ln, " + words,
                          .ours = fragility::standard_deviation(ln_ratios)});
}

Item shake_table(const Sources& sources) {
  TablePulses pulses;
  const std::vector<Test> tests = tests_of(PrintedTable(sources, "table_5_1.csv"), pulses);
  std::map<std::string, std::vector<Test>> by_specimen;
  for (const Test& test : tests) by_specimen[test.specimen].push_back(test);
  Item item;
  std::map<std::string, double> fitted;
  for (const auto& [specimen, some] : by_specimen) {
    fitted[specimen] = fitted_friction(some);
    if (std::isnan(fitted[specimen]))
      item.left_out.push_back(
          fmt::format("{}: of all frictions that are tried the lowest, {}, fits its {} peaks best, so none is told",
                      specimen, least_friction, some.size()));
    else
      item.numbers.push_back({.id = "shake_table.mu." + specimen,
                              .what = specimen + ": friction that fits its peak slips under the pulses",
                              .ours = fitted[specimen]});
  }
  Sheet sheet{"shake_table", {"motion", "measured_slip_m", "slow_pull_slip_m", "best_fit_slip_m", "fitted_slip_m"}, {}};
  std::vector<double> slow, best;
  for (const Test& test : tests) {
    slow.push_back(ln_ratio(test, test.mu_slow_pull));
    best.push_back(ln_ratio(test, test.mu_best_fit));
    sheet.rows.push_back({test.specimen, test.motion, test.measured_m, slip_m(test, test.mu_slow_pull),
                          slip_m(test, test.mu_best_fit), fitted_slip_m(test, fitted[test.specimen])});
  }
  add_ratio(item, "slow_pull", "friction of the slow pulls", slow);
  add_ratio(item, "best_fit", "friction that fits histories", best);
  item.sheets = {sheet};
  item.left_out.push_back(
      "the report's predicted histories: they follow from the motions recorded on its table, which are not published");
  return item;
}

const RegisteredItem shake_table_here{
    {.name = "shake_table",
     .order = 420,
     .chapter = 4,
     .place = "Tables 4.1 and 5.1",
     .what = "measured peak slips beside those of a sliding block under the fitted pulses",
     .compute = shake_table}};

}  // namespace
}  // namespace freestand::report
