#include "decision/hazard.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"

namespace freestand::decision {
namespace {

struct Line {
  int number;
  std::vector<std::string> cells;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<Line> lines_of(std::string text) {
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::vector<Line> lines;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = trimmed(text.substr(at, end - at));
    at = end + 1;
    ++number;
    if (line.empty() || line.front() == '#') continue;
    lines.push_back({number, {}});
    for (std::size_t from = 0; from <= line.size();) {
      const std::size_t comma = std::min(line.find(',', from), line.size());
      lines.back().cells.push_back(trimmed(line.substr(from, comma - from)));
      from = comma + 1;
    }
  }
  return lines;
}

[[noreturn]] void refuse(const std::string& file, int line, const std::string& problem) {
  throw Error(fmt::format("{}:{}: {}", file, line, problem), Exit::data);
}

struct Columns {
  std::size_t im, rate, period;
};

// An intensity by its name, and by that with a period, as sa_g:0.5.
struct NamedMeasure {
  std::string name;
  double period_s = 0;
};

NamedMeasure measure_of(const std::string& column) {
  const std::size_t colon = column.find(':');
  if (colon == std::string::npos) return {column};
  char* end = nullptr;
  const double period = std::strtod(column.c_str() + colon + 1, &end);
  if (*end != '\0' || !(period > 0) || !std::isfinite(period)) return {column};
  return {column.substr(0, colon), period};
}

Columns columns_of(const Line& header, const std::string& file, const std::vector<std::string>& measures,
                   HazardCurve& curve) {
  const std::size_t none = header.cells.size();
  Columns found{none, none, none};
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::string& name = header.cells[i];
    const NamedMeasure named = measure_of(name);
    const bool measure = std::find(measures.begin(), measures.end(), named.name) != measures.end();
    std::size_t* column = name == "annual_rate" ? &found.rate
                          : name == "period_s"  ? &found.period
                          : measure             ? &found.im
                                                : nullptr;
    if (!column && (name == "rate" || name == "annual_rate_of_exceedance" || name == "lambda" || name == "poe" ||
                    name == "frequency"))
      refuse(file, header.number,
             fmt::format("column {} is unknown (how often a year an intensity is exceeded is called annual_rate): name "
                         "it annual_rate, if that is what it holds",
                         name));
    if (!column && name.find(';') != std::string::npos)
      refuse(file, header.number,
             "cells are parted by semicolons (commas part them here, and decimals have points): replace them");
    if (!column && curve.measure.size() > 0)
      refuse(file, header.number,
             fmt::format(
                 "column {} is unknown (beside {} a hazard curve has annual_rate, how often a year it is exceeded): "
                 "name it so if that is what it holds; from a probability p in N years it is -ln(1 - p)/N, from a "
                 "return period T 1/T",
                 name.empty() ? "without a name" : shown(name), curve.measure));
    if (!column)
      refuse(file, header.number,
             fmt::format("column {} is unknown (a hazard curve has an intensity and annual_rate): name the intensity "
                         "with its unit, "
                         "as one of {}",
                         name.empty() ? "without a name" : shown(name), fmt::join(measures, ", ")));
    if (*column != none)
      refuse(file, header.number, fmt::format("a second column like {} (which one counts?): leave one", shown(name)));
    *column = i;
    if (measure) curve.measure = named.name, curve.period_s = named.period_s;
  }
  if (found.im == none)
    refuse(file, header.number,
           fmt::format("no column of an intensity (there must be one): add one of {}", fmt::join(measures, ", ")));
  if (found.rate == none)
    refuse(file, header.number,
           "no column annual_rate (how often a year an intensity is exceeded): add it; from a probability p in N years "
           "it is -ln(1 - p)/N");
  return found;
}

double number(const Line& line, std::size_t column, const std::string& name, const std::string& file) {
  const std::string& cell = line.cells[column];
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0' || !std::isfinite(value))
    refuse(file, line.number, fmt::format("{} is no number ({}): write it with a decimal point", shown(cell), name));
  if (!(value > 0))
    refuse(file, line.number,
           fmt::format("{} = {} is not positive (its logarithm is needed): leave the line out", name, cell));
  return value;
}

void add_point(const Line& line, double im, double rate, const std::string& file, HazardCurve& curve) {
  if (!curve.im.empty() && im <= curve.last())
    refuse(file, line.number,
           im < curve.last()
               ? fmt::format("{} falls from {} to {}: sort the lines by intensity", curve.measure, curve.last(), im)
               : fmt::format("{} is {} again (which rate counts?): leave one of the two lines", curve.measure, im));
  if (!curve.im.empty() && rate > curve.annual_rate.back())
    refuse(file, line.number,
           fmt::format(
               "annual_rate rises from {} to {} (a larger intensity cannot be exceeded more often): is the column a "
               "rate of exceedance?",
               curve.annual_rate.back(), rate));
  if (rate > once_an_hour)
    refuse(
        file, line.number,
        fmt::format("annual_rate is {:g} (more than once an hour, which no earthquake's intensity is exceeded): is the "
                    "column a rate of exceedance, by the year?",
                    rate));
  curve.im.push_back(im);
  curve.annual_rate.push_back(rate);
}

}  // namespace

double HazardCurve::slope(std::size_t i) const {
  return std::log(annual_rate[i] / annual_rate[i - 1]) / std::log(im[i] / im[i - 1]);
}

double HazardCurve::rate(double intensity) const {
  const auto above = std::upper_bound(im.begin(), im.end(), intensity);
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - im.begin(), 1, std::ssize(im) - 1));
  return std::min(std::max(once_an_hour, annual_rate.front()),
                  annual_rate[i - 1] * std::pow(intensity / im[i - 1], slope(i)));
}

HazardCurve parse_hazard(const std::string& text, const std::string& file, const std::vector<std::string>& measures) {
  if (text.find('\0') != std::string::npos)
    refuse(file, 1, "is no text but a binary file (it holds a zero byte): give the hazard curve as csv");
  const std::vector<Line> lines = lines_of(text);
  if (lines.empty()) refuse(file, 1, "is empty (a hazard curve has a header and at least two points): fill it");
  HazardCurve curve;
  const Columns columns = columns_of(lines.front(), file, measures, curve);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Line& line = lines[i];
    if (line.cells.size() != lines.front().cells.size())
      refuse(file, line.number,
             fmt::format("has {} fields, the header {} (a decimal comma?): write as many, with decimal points",
                         line.cells.size(), lines.front().cells.size()));
    add_point(line, number(line, columns.im, curve.measure, file), number(line, columns.rate, "annual_rate", file),
              file, curve);
    if (columns.period == lines.front().cells.size()) continue;
    const double period = number(line, columns.period, "period_s", file);
    if (curve.period_s > 0 && period != curve.period_s)
      refuse(file, line.number, "period_s changes (one curve is of one period): give each a file of its own");
    curve.period_s = period;
  }
  if (curve.im.size() < 2) refuse(file, lines.back().number, "fewer than two points (a curve needs two): add more");
  return curve;
}

}  // namespace freestand::decision
