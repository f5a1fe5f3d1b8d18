#include "report/printed_line.hpp"

#include <cmath>

#include "fragility/goodness.hpp"

namespace freestand::report {

const PrintedLine best_fit{.name = "best_fit",
                           .words = "friction that fits the histories best",
                           .table = "table_5_1.csv",
                           .mu_column = "mu_best_fit",
                           .slope = 0.67,
                           .r2 = 0.19,
                           .ks = 0.144,
                           .sd_slope = 0.41};
const PrintedLine slow_pull{.name = "slow_pull",
                            .words = "friction of the slow pulls",
                            .table = "table_5_1.csv",
                            .mu_column = "mu_slow_pull",
                            .slope = 1.31,
                            .r2 = 0.25,
                            .ks = 0.133,
                            .sd_slope = 0.76};
const PrintedLine rare_motions{.name = "rare_motions",
                               .words = "motions of 2 % in 50 years, friction that fits best",
                               .table = "table_8_1.csv",
                               .mu_column = "mu_best_fit",
                               .slope = 0.38,
                               .r2 = 0.32,
                               .ks = 0.185,
                               .sd_slope = 0.17};

namespace {

const std::string of_its_table =
    "from the printed table itself, whatever its rounding took away: it is not the print's";

// A figure of the line, while PTA and demand go through all that round to what is printed.
Range reach_of_table(const PrintedTable& table, const PrintedLine& line, double fragility::LinearDemand::*figure) {
  std::vector<Rounded> inputs = table.rounded("pta_g");
  const std::vector<Rounded> demands = table.rounded("edp_printed");
  inputs.insert(inputs.end(), demands.begin(), demands.end());
  const std::vector<double> mu = table.numbers(line.mu_column);
  return reach(inputs, [&](std::span<const double> values) {
    std::vector<double> im;
    for (std::size_t i = 0; i < mu.size(); ++i) im.push_back(intensity(values[i], mu[i]));
    return fragility::fit_linear_demand(im, values.subspan(mu.size())).*figure;
  });
}

double ks_of(double slope, double sd_slope, std::span<const double> im, std::span<const double> delta) {
  return fragility::ks_statistic(fragility::linear_demand_transform({slope, sd_slope, 0}, im, delta));
}

// S of the printed slope, while slope, sigma, PTA and demand go through all that round to what is printed.
Range reach_of_ks(const PrintedTable& table, const PrintedLine& line) {
  std::vector<Rounded> inputs{{line.slope, slope_unit}, {line.sd_slope, slope_unit}};
  for (const char* column : {"pta_g", "edp_printed"})
    for (const Rounded& one : table.rounded(column)) inputs.push_back(one);
  const std::vector<double> mu = table.numbers(line.mu_column);
  return reach(inputs, [&](std::span<const double> values) {
    std::vector<double> im;
    for (std::size_t i = 0; i < mu.size(); ++i) im.push_back(intensity(values[2 + i], mu[i]));
    return ks_of(values[0], values[1], im, values.subspan(2 + mu.size()));
  });
}

}  // namespace

Peaks printed_peaks(const PrintedTable& table, const std::string& mu_column) {
  const auto pta = table.numbers("pta_g"), mu = table.numbers(mu_column);
  Peaks peaks{.motion = table.texts("motion"), .delta = table.numbers("edp_printed")};
  const auto specimens = table.texts("specimen");
  for (std::size_t i = 0; i < pta.size(); ++i) {
    peaks.label.push_back(specimens[i] + ", " + peaks.motion[i]);
    peaks.im.push_back(intensity(pta[i], mu[i]));
  }
  return peaks;
}

Item line_item(const Sources& sources, const PrintedLine& line) {
  const PrintedTable table(sources, line.table);
  const Peaks peaks = printed_peaks(table, line.mu_column);
  const PeaksFit fit = fit_peaks(peaks, sources.jobs);
  using fragility::LinearDemand;
  Item item;
  const auto add = [&](Number number) {
    number.id = line.name + "." + number.id;
    item.numbers.push_back(compared(std::move(number), Verdict::print_disagrees_with_itself, of_its_table));
  };
  const auto alone = [&](const char* id, const char* what, double value) {
    add({.id = id, .what = what, .ours = value});
  };
  add({.id = "slope",
       .what = "slope of the mean demand over IM, through the origin",
       .ours = fit.line.slope,
       .print = line.slope,
       .print_unit = slope_unit,
       .reach = reach_of_table(table, line, &LinearDemand::slope)});
  add({.id = "r2",
       .what = "r² of that line, squared correlation",
       .ours = fit.line.r2,
       .print = line.r2,
       .print_unit = r2_unit,
       .reach = reach_of_table(table, line, &LinearDemand::r2)});
  add({.id = "ks",
       .what = "Kolmogorov–Smirnov S of the printed line",
       .ours = ks_of(line.slope, line.sd_slope, peaks.im, peaks.delta),
       .print = line.ks,
       .print_unit = ks_unit,
       .reach = reach_of_ks(table, line)});
  alone("determination", "r² as 1 − squares left / squares about the mean", fit.determination);
  alone("sd_slope", "slope of the standard deviation over IM", fit.line.sd_slope);
  alone("slope_se", "standard error of the slope, motions left out in turn", fit.slope_se);
  alone("bin_slope", "slope through the means of the bins", fit.bin_slope);
  alone("bin_r2", "r² of the bins' means", fit.bin_r2);
  alone("bin_sd_slope", "slope through the standard deviations of the bins", fit.bin_sd_slope);
  alone("bin_sd_r2", "r² of the bins' standard deviations", fit.bin_sd_r2);
  alone("ks_ours", "S of our line", fit.ks);
  alone("ks_critical_textbook", "5 % value of S by the textbook, nothing fitted [KM05 5.31, 8.8]",
        fit.ks_critical_textbook);
  alone("ks_critical", "5 % value of S for a line fitted to the same points", fit.ks_critical);
  alone("ks_p", "p of S for a line fitted to the same points", fit.ks_p);
  item.statements.push_back({line.name + ".accepted", "does the test of fit reject the line at 5 %?",
                             fit.ks > fit.ks_critical ? "rejected, under the null of this very line"
                                                      : "accepted, under the null of this very line",
                             "accepted, by the textbook's value",
                             fit.ks > fit.ks_critical ? Verdict::disagrees : Verdict::agrees, ""});
  item.sheets = sheets(line.name, peaks, fit);
  item.left_out = {
      "the report's own bins and the r² of its sigma lines: their numbers are not among the tables; ours are bins of "
      "equal count"};
  return item;
}

double printed_exceedance(const PrintedLine& line, double im, double capacity) {
  return fragility::linear_demand_exceedance({line.slope, line.sd_slope, 0}, im, capacity);
}

Range reach_of_exceedance(const PrintedLine& line, double im, double capacity) {
  return reach(std::vector<Rounded>{{line.slope, slope_unit}, {line.sd_slope, slope_unit}},
               [&](std::span<const double> values) {
                 return fragility::linear_demand_exceedance({values[0], values[1], 0}, im, capacity);
               });
}

}  // namespace freestand::report
