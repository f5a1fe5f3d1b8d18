#include "fragility/result_numbers.hpp"

#include <cstring>
#include <type_traits>

namespace freestand::fragility {
namespace {

template <class Way, class Value>
void go(Way& way, Value& value) {
  if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
    way.take(value);
  else
    walk(way, value);
}

template <class Way, class... Values>
void each(Way& way, Values&... values) {
  (go(way, values), ...);
}

template <class Way, class Value>
void walk(Way& way, std::vector<Value>& values) {
  auto size = static_cast<double>(values.size());
  way.take(size);
  values.resize(static_cast<std::size_t>(size));
  for (Value& value : values) go(way, value);
}

// Every member has its name here: a member that is added and forgotten does not compile.
template <class Way>
void walk(Way& way, BinFit& b) {
  auto& [n, n_still, n_over, n_moved, n_failed, motions, im_mean, p_still, p_still_lower, p_still_upper, p_over,
         p_over_lower, p_over_upper, lambda, lambda_se, omega, omega_se, slope, p_never, mean, standard_deviation,
         ks_statistic, ks_resolution, correlation, ks_p_textbook, ks_critical_textbook, ks_p_estimated,
         ks_critical_estimated, ad_statistic, ad_p_estimated, off_by, fdr_rejected, status] = b;
  each(way, n, n_still, n_over, n_moved, n_failed, motions, im_mean, p_still, p_still_lower, p_still_upper, p_over,
       p_over_lower, p_over_upper, lambda, lambda_se, omega, omega_se, slope, p_never, mean, standard_deviation,
       ks_statistic, ks_resolution, correlation, ks_p_textbook, ks_critical_textbook, ks_p_estimated,
       ks_critical_estimated, ad_statistic, ad_p_estimated, off_by, fdr_rejected, status);
}

template <class Way>
void walk(Way& way, Regressions& r) {
  auto& [n, slope, slope_se, slope_r2, sd_slope, sd_slope_se, bin_mean_slope, bin_sd_slope, cloud_intercept,
         cloud_slope, cloud_sd, cloud_r2, cloud_intercept_se, cloud_slope_se, cloud_sd_se] = r;
  each(way, n, slope, slope_se, slope_r2, sd_slope, sd_slope_se, bin_mean_slope, bin_sd_slope, cloud_intercept,
       cloud_slope, cloud_sd, cloud_r2, cloud_intercept_se, cloud_slope_se, cloud_sd_se);
}

template <class Way>
void walk(Way& way, Surface& s) {
  auto& [probability, lower, upper, empirical, least, most, empirical_lower, empirical_upper, resampled, left_out] = s;
  each(way, probability, lower, upper, empirical, least, most, empirical_lower, empirical_upper, resampled, left_out);
}

template <class Way>
void walk(Way& way, AxisSurface& s) {
  auto& [name, unit, edge, centre, probability, lower, upper, n] = s;
  each(way, edge, centre, probability, lower, upper, n);
}

template <class Way>
void walk(Way& way, Distribution& d) {
  auto& [ln_edge, count] = d;
  each(way, ln_edge, count);
}

template <class Way>
void walk(Way& way, FragilityFunction& f) {
  auto& [median, dispersion, median_se, dispersion_se, penalised, im_least, im_most, extrapolated, misfit, misfit_im,
         misfit_p, off_by, rate_p, adequate, cell_im, cell_n, cell_share, grid, probability, lower, upper,
         resampled_median, resampled_dispersion, left_out_median, left_out_dispersion, resampled_cell_share,
         left_out_cell_share] = f;
  each(way, median, dispersion, median_se, dispersion_se, penalised, im_least, im_most, extrapolated, misfit, misfit_im,
       misfit_p, off_by, rate_p, adequate, cell_im, cell_n, cell_share, grid, probability, lower, upper,
       resampled_median, resampled_dispersion, left_out_median, left_out_dispersion, resampled_cell_share,
       left_out_cell_share);
}

template <class Way>
void walk(Way& way, EdpResult& r) {
  auto& [name, unit, symbol, binary, bins, capacity, surface, functions, distribution, axes, regressions] = r;
  each(way, binary, bins, capacity, surface, functions, distribution, axes, regressions);
}

struct Out {
  std::vector<double> numbers = {};

  template <class Value>
  void take(const Value& value) {
    static_assert(sizeof value <= sizeof(double));
    std::memcpy(&numbers.emplace_back(0), &value, sizeof value);
  }
};

struct In {
  const double* next;

  template <class Value>
  void take(Value& value) {
    std::memcpy(&value, next++, sizeof value);
  }
};

template <class Part>
std::vector<double> written(Part part) {
  Out out;
  walk(out, part);
  return std::move(out.numbers);
}

template <class Part>
void read(const std::vector<double>& numbers, Part& part) {
  In in{numbers.data()};
  walk(in, part);
}

}  // namespace

std::vector<double> numbers_of(EdpResult result) { return written(std::move(result)); }
std::vector<double> numbers_of(FragilityFunction function) { return written(std::move(function)); }

void from_numbers(const std::vector<double>& numbers, EdpResult& result) { read(numbers, result); }
void from_numbers(const std::vector<double>& numbers, FragilityFunction& function) { read(numbers, function); }

}  // namespace freestand::fragility
