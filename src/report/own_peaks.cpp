#include "report/own_peaks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"
#include "base/units.hpp"
#include "report/peaks.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

struct LengthColumn {
  const char* name;
  double metres;
};
constexpr LengthColumn slip_columns[] = {
    {"peak_slip_m", 1}, {"peak_slip_mm", 1e-3}, {"peak_slip_cm", 1e-2}, {"peak_slip_in", inch_m}};
constexpr const char* period_columns[] = {"pulse_period_s", "period_s"};

class OwnTable {
 public:
  explicit OwnTable(CsvTable csv) : csv_(csv), table_(std::move(csv)) {}

  // The one of some columns that the table has; throws where it has none or several.
  template <class Names, class Of>
  const auto& one_of(const Names& names, const Of& name_of, const char* what) {
    const auto has = [&](const auto& one) { return table_.has(name_of(one)); };
    const auto count = std::count_if(std::begin(names), std::end(names), has);
    std::vector<std::string> known;
    for (const auto& one : names) known.emplace_back(name_of(one));
    if (count != 1)
      throw Error(fmt::format("{}:1: {} of the columns {} (each row needs {}): give one of them", csv_.file.string(),
                              count == 0 ? "none" : "several", fmt::join(known, ", "), what),
                  Exit::data);
    const auto& found = *std::find_if(std::begin(names), std::end(names), has);
    used_.emplace_back(name_of(found));
    return found;
  }

  // All numbers of a column, each above 0; lines that are not are gathered.
  std::vector<double> positive(const std::string& column) {
    used_.push_back(column);
    const std::vector<std::string> cells = table_.texts(column);
    std::vector<double> values;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      values.push_back(number_in(cells[i]).value_or(0));
      if (!(values[i] > 0))
        wrong(i, fmt::format("{} is {} (it is a number above 0): correct the line, or leave it out", column,
                             cells[i].empty() ? "empty" : shown(cells[i])));
    }
    return values;
  }

  std::vector<std::string> names(const std::string& column) {
    if (!table_.has(column)) return std::vector<std::string>(table_.rows());
    used_.push_back(column);
    return table_.texts(column);
  }

  void wrong(std::size_t row, const std::string& what) {
    problems_.append(problems_.empty() ? "" : "\n").append(csv_.at(csv_.rows[row])).append(what);
  }
  void throw_if_wrong() const {
    if (!problems_.empty()) throw Error(problems_, Exit::data);
  }

  std::vector<std::string> friction_columns() const {
    std::vector<std::string> found;
    for (const std::string& column : csv_.columns)
      if (column == "mu" || column.starts_with("mu_")) found.push_back(column);
    return found;
  }
  bool has(const std::string& column) const { return table_.has(column); }
  std::vector<std::string> unused() const {
    std::vector<std::string> found;
    for (const std::string& column : csv_.columns)
      if (std::find(used_.begin(), used_.end(), column) == used_.end()) found.push_back(column);
    return found;
  }
  const std::string file() const { return csv_.file.string(); }

 private:
  CsvTable csv_;
  PrintedTable table_;
  std::vector<std::string> used_;
  std::string problems_;
};

// The points with one column of intensity or friction.
Peaks peaks_of(OwnTable& table, const std::string& column) {
  const auto& slip_column = table.one_of(
      slip_columns, [](const LengthColumn& one) { return one.name; }, "the peak slip");
  const auto& period_column = table.one_of(
      period_columns, [](const char* one) { return one; }, "a period");
  const auto pta = table.positive("pta_g"), slip = table.positive(slip_column.name),
             period = table.positive(period_column), given = table.positive(column);
  const auto specimen = table.names("specimen"), motion = table.names("motion");
  table.throw_if_wrong();
  Peaks peaks;
  for (std::size_t i = 0; i < pta.size(); ++i) {
    const double im = column == "im" ? given[i] : intensity(pta[i], given[i]);
    if (!(im > 0))
      table.wrong(i, fmt::format("IM = PTA/(mu g) - 1 is {:.3g} (with that friction the block does not slide): correct "
                                 "pta_g or {}, or leave the line out",
                                 im, column));
    peaks.im.push_back(im);
    peaks.delta.push_back(demand(slip[i] * slip_column.metres, period[i], pta[i]));
    const std::string number = "row " + std::to_string(i + 1);
    peaks.motion.push_back(motion[i].empty() ? number : motion[i]);
    peaks.label.push_back(specimen[i].empty() ? peaks.motion.back() : specimen[i] + ", " + peaks.motion.back());
  }
  table.throw_if_wrong();
  return peaks;
}

Item item_of(const std::string& name, const Peaks& peaks, const Jobs& jobs) {
  const PeaksFit fit = fit_peaks(peaks, jobs);
  Item item;
  const auto add = [&](const char* id, const char* what, double ours) {
    item.numbers.push_back({.id = name + "." + id, .what = what, .ours = ours});
  };
  add("n", "tests", static_cast<double>(peaks.im.size()));
  add("slope", "slope of the mean demand over IM, through the origin", fit.line.slope);
  add("slope_se", "its standard error, motions left out in turn", fit.slope_se);
  add("r2", "r², squared correlation", fit.line.r2);
  add("determination", "r² as 1 − squares left / squares about the mean", fit.determination);
  add("sd_slope", "slope of the standard deviation over IM", fit.line.sd_slope);
  add("bin_slope", "slope through the means of the bins", fit.bin_slope);
  const bool tells = fit.bins.size() > 2;  // of two points r² is 1 whatever they are
  if (tells) add("bin_r2", "r² of the bins' means", fit.bin_r2);
  add("bin_sd_slope", "slope through the standard deviations of the bins", fit.bin_sd_slope);
  if (tells) add("bin_sd_r2", "r² of the bins' standard deviations", fit.bin_sd_r2);
  add("ks_ours", "Kolmogorov–Smirnov S of the line", fit.ks);
  add("ks_critical_textbook", "5 % value of S by the textbook, nothing fitted", fit.ks_critical_textbook);
  add("ks_critical", "5 % value of S for a line fitted to the same points", fit.ks_critical);
  add("ks_p", "p of S for a line fitted to the same points", fit.ks_p);
  item.statements = {{name + ".accepted", "does the test of fit reject the line at 5 %?",
                      fit.ks > fit.ks_critical ? "yes: rejected" : "no: accepted", "", Verdict::not_printed, ""}};
  item.sheets = sheets(name, peaks, fit);
  return item;
}

}  // namespace

std::vector<std::pair<Entry, Item>> own_peaks(const std::filesystem::path& file, const Jobs& jobs) {
  OwnTable table(read_csv_table(file));
  if (!table.has("pta_g"))
    throw Error(
        file.string() + ":1: no column pta_g (the demand is U w^2/PTA): give the peak acceleration of the floor in g",
        Exit::data);
  std::vector<std::string> columns = table.friction_columns();
  if (table.has("im") && !columns.empty())
    throw Error(fmt::format("{}:1: both im and {} (the intensity is im, or PTA/(mu g) - 1 of a friction; which one "
                            "counts?): leave one of them",
                            file.string(), columns.front()),
                Exit::data);
  if (table.has("im")) columns = {"im"};
  if (columns.empty())
    throw Error(file.string() + ":1: no column im, mu or mu_... (the intensity is PTA/(mu g) - 1): give one of them",
                Exit::data);
  std::vector<std::pair<Entry, Item>> found;
  for (const std::string& column : columns) {
    const Peaks peaks = peaks_of(table, column);
    if (peaks.im.size() < least_peaks)
      throw Error(
          fmt::format("{}: a line and its bins need {} measured peaks (there are {}): give more tests in one table",
                      file.string(), least_peaks, peaks.im.size()),
          Exit::data);
    const std::string name = columns.size() == 1 ? "own" : "own_" + column;
    found.push_back({Entry{.name = name,
                           .place = file.filename().string(),
                           .what = fmt::format("{} measured peaks, intensity by {}", peaks.im.size(), column)},
                     item_of(name, peaks, jobs)});
  }
  if (const auto unused = table.unused(); !unused.empty())
    found.back().second.left_out.push_back(
        fmt::format("these columns of the table are not needed: {}", fmt::join(unused, ", ")));
  return found;
}

}  // namespace freestand::report
