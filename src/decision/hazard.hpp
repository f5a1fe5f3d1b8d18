// A hazard curve: how often a year the floor (or the ground) is shaken by more than an intensity.
#pragma once

#include <string>
#include <vector>

namespace freestand::decision {

// [1/year] What no intensity is exceeded more often than: a point that says so is refused, and no slope leads beyond it.
inline constexpr double once_an_hour = 8766;

// Points in increasing intensity; between them ln rate is linear in ln intensity: rate = k0 im^-k.
struct HazardCurve {
  std::string measure;  // name of the intensity with its unit: pga_g
  double period_s = 0;  // of sa_g, where the file tells it; 0: it does not
  std::vector<double> im;
  std::vector<double> annual_rate;  // of exceeding im; never rising

  double first() const { return im.front(); }
  double last() const { return im.back(); }
  // d ln rate/d ln im between point i - 1 and point i.
  double slope(std::size_t i) const;
  // Rate of exceeding an intensity; before the first point and behind the last one by the slope beside it.
  double rate(double intensity) const;
};

// From the text of a csv file: a header with the intensity's column (sa_g also as sa_g:0.5, at 0.5 s) and annual_rate [, period_s], one
// point a line; lines that are empty or begin with # are skipped. Throws Error (Exit::data) with `file` and line: columns that are missing
// or unknown, what is no number, an intensity that is not positive or does not grow, a rate that is not positive or rises, fewer than two
// points.
// measures: the names that an intensity may have.
HazardCurve parse_hazard(const std::string& text, const std::string& file, const std::vector<std::string>& measures);

}  // namespace freestand::decision
