// Measured peaks of sliding blocks, treated as the report treats them [KM05 5.6-5.33, 8.1-8.8]: demand against intensity, the
// line through the origin with its standard deviation, bins, goodness of fit, and the fragility that follows.
//   IM = PTA/(mu g) - 1 [KM05 5.6],  Delta = U w_p^2/PTA [KM05 5.7]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fragility/regression.hpp"
#include "report/item.hpp"

namespace freestand::report {

struct Peaks {
  std::vector<std::string> label = {};  // of each point: specimen and motion
  std::vector<std::string> motion = {};
  std::vector<double> im = {}, delta = {};  // both > 0
};

double intensity(double pta_g, double mu);                         // [KM05 5.6]
double demand(double peak_slip_m, double period_s, double pta_g);  // [KM05 5.7]

// Points of one bin of IM, bins of equal count.
struct PeakBin {
  double im_low = 0, im_high = 0, im = 0;  // least, largest, mean
  std::size_t n = 0;
  double mean = 0, standard_deviation = 0;  // of the demand; divisor n - 1
  double lambda = 0, omega = 0;             // lognormal by maximum likelihood [KM05 5.21-5.25]
};

struct PeaksFit {
  fragility::LinearDemand line{};  // slope and sd_slope through the origin; r2: squared correlation
  double slope_se = 0;             // motions left out in turn; nan where there are fewer than two
  double determination = 0;        // 1 - sum (y - slope x)^2/sum (y - mean y)^2, another r^2
  std::vector<PeakBin> bins;
  double bin_slope = 0, bin_r2 = 0;        // line through the bins' means
  double bin_sd_slope = 0, bin_sd_r2 = 0;  // through their standard deviations
  double ks = 0;                           // S of the line [KM05 5.28-5.30]
  double ks_critical_textbook = 0;         // 5 %, nothing fitted [KM05 5.31, 8.8]
  double ks_critical = 0, ks_p = 0;        // of the null of this very line, its slopes fitted to the same points
};

// Throws Error (Exit::data): fewer points than two bins need.
PeaksFit fit_peaks(const Peaks&, const Jobs& jobs = run_here);

// The tables behind the pictures: NAME_points, NAME_line, NAME_bins, NAME_ks, NAME_surface.
std::vector<Sheet> sheets(const std::string& name, const Peaks&, const PeaksFit&);

// Repeats of the null's simulation: the standard error of a p value near 0.05 is 0.0015.
inline constexpr int null_repeats = 20000;
inline constexpr std::size_t points_per_bin = 7;  // at least: the report's tables then have 4 and 3 bins
inline constexpr std::size_t least_peaks = 2 * points_per_bin;

}  // namespace freestand::report
