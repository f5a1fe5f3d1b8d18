#include "io/bin_fields.hpp"

#include <cstdint>
#include <type_traits>

namespace freestand::io {
namespace {

using fragility::BinFit;

// The two ways of one member.
template <class Values, auto member>
double get(const Values& values) {
  return static_cast<double>(values.*member);
}

// The last value of an enumeration.
constexpr auto last(fragility::BinStatus) { return fragility::BinStatus::not_refuted; }

template <class Values, auto member>
bool set(Values& values, double value) {
  using Member = std::remove_reference_t<decltype(values.*member)>;
  if constexpr (!std::is_floating_point_v<Member>) {
    double most = std::is_same_v<Member, bool> ? 1 : 0x1p31 - 1;
    if constexpr (std::is_enum_v<Member>) most = static_cast<double>(last(Member{}));
    if constexpr (std::is_same_v<Member, std::int64_t>) most = 0x1p53;
    const double least = std::is_signed_v<Member> ? -most : 0;
    if (!(value >= least && value <= most)) return false;
  }
  values.*member = static_cast<Member>(value);
  return true;
}

constexpr auto one = FieldUnit::one, edp = FieldUnit::edp;

// clang-format off
constexpr BinField fields[] = {
  {"n", true, one, "samples in the bin, failed ones left out", get<BinFit, &BinFit::n>, set<BinFit, &BinFit::n>},
  {"n_still", true, one, "samples that stood still", get<BinFit, &BinFit::n_still>, set<BinFit, &BinFit::n_still>},
  {"n_over", true, one, "samples that overturned, whatever else happened to them", get<BinFit, &BinFit::n_over>, set<BinFit, &BinFit::n_over>},
  {"n_moved", true, one, "samples that moved and stood; of a demand that happens or not: in which it happened and which stood", get<BinFit, &BinFit::n_moved>, set<BinFit, &BinFit::n_moved>},
  {"n_failed", true, one, "samples that failed, in none of the counts", get<BinFit, &BinFit::n_failed>, set<BinFit, &BinFit::n_failed>},
  {"motions", true, one, "groups of floor motions in the bin", get<BinFit, &BinFit::motions>, set<BinFit, &BinFit::motions>},
  {"p_still", false, one, "probability of standing still, given no overturning", get<BinFit, &BinFit::p_still>, set<BinFit, &BinFit::p_still>},
  {"p_still_lower", false, one, "lower end of its interval, motions as the unit", get<BinFit, &BinFit::p_still_lower>, set<BinFit, &BinFit::p_still_lower>},
  {"p_still_upper", false, one, "upper end of its interval, motions as the unit", get<BinFit, &BinFit::p_still_upper>, set<BinFit, &BinFit::p_still_upper>},
  {"p_over", false, one, "probability of overturning", get<BinFit, &BinFit::p_over>, set<BinFit, &BinFit::p_over>},
  {"p_over_lower", false, one, "lower end of its interval, motions as the unit", get<BinFit, &BinFit::p_over_lower>, set<BinFit, &BinFit::p_over_lower>},
  {"p_over_upper", false, one, "upper end of its interval, motions as the unit", get<BinFit, &BinFit::p_over_upper>, set<BinFit, &BinFit::p_over_upper>},
  {"lambda", false, one, "mean of ln EDP at im, of the lognormal fitted to the samples that moved and stood, which is cut off below the threshold of standing still", get<BinFit, &BinFit::lambda>, set<BinFit, &BinFit::lambda>},
  {"lambda_se", false, one, "its standard error, from resampled motions", get<BinFit, &BinFit::lambda_se>, set<BinFit, &BinFit::lambda_se>},
  {"omega", false, one, "standard deviation of ln EDP about its line over ln IM, of that lognormal", get<BinFit, &BinFit::omega>, set<BinFit, &BinFit::omega>},
  {"omega_se", false, one, "its standard error, from resampled motions", get<BinFit, &BinFit::omega_se>, set<BinFit, &BinFit::omega_se>},
  {"slope", false, one, "of ln EDP over ln IM within the bin", get<BinFit, &BinFit::slope>, set<BinFit, &BinFit::slope>},
  {"p_never", false, one, "share without demand, given no overturning, beyond the lognormal below the threshold", get<BinFit, &BinFit::p_never>, set<BinFit, &BinFit::p_never>},
  {"mean", false, edp, "mean of the fitted lognormal", get<BinFit, &BinFit::mean>, set<BinFit, &BinFit::mean>},
  {"standard_deviation", false, edp, "standard deviation of the fitted lognormal", get<BinFit, &BinFit::standard_deviation>, set<BinFit, &BinFit::standard_deviation>},
  {"ks_statistic", false, one, "Kolmogorov-Smirnov statistic", get<BinFit, &BinFit::ks_statistic>, set<BinFit, &BinFit::ks_statistic>},
  {"ks_resolution", false, one, "what the histogram may have made of it", get<BinFit, &BinFit::ks_resolution>, set<BinFit, &BinFit::ks_resolution>},
  {"correlation", false, one, "of ln EDP of two samples of one record", get<BinFit, &BinFit::correlation>, set<BinFit, &BinFit::correlation>},
  {"ks_p_textbook", false, one, "p value as if the parameters were known beforehand", get<BinFit, &BinFit::ks_p_textbook>, set<BinFit, &BinFit::ks_p_textbook>},
  {"ks_critical_textbook", false, one, "critical value of the same at 5 %", get<BinFit, &BinFit::ks_critical_textbook>, set<BinFit, &BinFit::ks_critical_textbook>},
  {"ks_p_estimated", false, one, "p value for parameters estimated from the same samples, records as the unit", get<BinFit, &BinFit::ks_p_estimated>, set<BinFit, &BinFit::ks_p_estimated>},
  {"ks_critical_estimated", false, one, "critical value of the same at 5 %", get<BinFit, &BinFit::ks_critical_estimated>, set<BinFit, &BinFit::ks_critical_estimated>},
  {"ad_statistic", false, one, "Anderson-Darling statistic", get<BinFit, &BinFit::ad_statistic>, set<BinFit, &BinFit::ad_statistic>},
  {"ad_p_estimated", false, one, "its p value for estimated parameters, of independent samples", get<BinFit, &BinFit::ad_p_estimated>, set<BinFit, &BinFit::ad_p_estimated>},
  {"off_by", false, one, "upper 95 % bound of what a lognormal is off the true probabilities", get<BinFit, &BinFit::off_by>, set<BinFit, &BinFit::off_by>},
  {"fdr_rejected", true, one, "1: rejected with false discovery controlled over the bins", get<BinFit, &BinFit::fdr_rejected>, set<BinFit, &BinFit::fdr_rejected>},
  {"status", true, one, "0 fitted, 1 too few samples, 2 fails goodness of fit, 3 counts only, 4 passes it, but may be off by more than is adequate; by counts but for 0", get<BinFit, &BinFit::status>, set<BinFit, &BinFit::status>},
};

using Fitted = fragility::FragilityFunction;
constexpr FunctionField of_function[] = {
  {"median", true, "IM at which half lie above", get<Fitted, &Fitted::median>, set<Fitted, &Fitted::median>},
  {"dispersion", false, "of ln IM", get<Fitted, &Fitted::dispersion>, set<Fitted, &Fitted::dispersion>},
  {"median_se", true, "standard error of the median, from resampled motions", get<Fitted, &Fitted::median_se>, set<Fitted, &Fitted::median_se>},
  {"dispersion_se", false, "standard error of the dispersion, from resampled motions", get<Fitted, &Fitted::dispersion_se>, set<Fitted, &Fitted::dispersion_se>},
  {"penalised", false, "1: the outcomes separate, the estimate is a penalised one", get<Fitted, &Fitted::penalised>, set<Fitted, &Fitted::penalised>},
  {"im_least", true, "lowest IM swept", get<Fitted, &Fitted::im_least>, set<Fitted, &Fitted::im_least>},
  {"im_most", true, "highest IM swept", get<Fitted, &Fitted::im_most>, set<Fitted, &Fitted::im_most>},
  {"extrapolated", false, "1: the median lies outside of what was swept", get<Fitted, &Fitted::extrapolated>, set<Fitted, &Fitted::extrapolated>},
  {"misfit", false, "largest difference to the counted share of a bin", get<Fitted, &Fitted::misfit>, set<Fitted, &Fitted::misfit>},
  {"misfit_im", true, "mean IM of that bin, or of that part of one", get<Fitted, &Fitted::misfit_im>, set<Fitted, &Fitted::misfit_im>},
  {"misfit_p", false, "chance of a larger misfit if the curve were true, from resampled motions", get<Fitted, &Fitted::misfit_p>, set<Fitted, &Fitted::misfit_p>},
  {"off_by", false, "upper bound of the difference to the true shares of bins of IM; within one it may be larger", get<Fitted, &Fitted::off_by>, set<Fitted, &Fitted::off_by>},
  {"rate_p", false, "chance of annual rates as far from those of the counts if the curve were true", get<Fitted, &Fitted::rate_p>, set<Fitted, &Fitted::rate_p>},
  {"adequate", false, "1: off_by is small enough, and rates agree, for the curve to stand for the counts", get<Fitted, &Fitted::adequate>, set<Fitted, &Fitted::adequate>},
};
// clang-format on

using fragility::Regressions;
constexpr RegressionField of_regressions[] = {
    {"slope", &Regressions::slope},
    {"slope_se", &Regressions::slope_se},
    {"slope_r2", &Regressions::slope_r2},
    {"sd_slope", &Regressions::sd_slope},
    {"sd_slope_se", &Regressions::sd_slope_se},
    {"bin_mean_slope", &Regressions::bin_mean_slope},
    {"bin_sd_slope", &Regressions::bin_sd_slope},
    {"cloud_intercept", &Regressions::cloud_intercept},
    {"cloud_intercept_se", &Regressions::cloud_intercept_se},
    {"cloud_slope", &Regressions::cloud_slope},
    {"cloud_slope_se", &Regressions::cloud_slope_se},
    {"cloud_sd", &Regressions::cloud_sd},
    {"cloud_sd_se", &Regressions::cloud_sd_se},
    {"cloud_r2", &Regressions::cloud_r2},
};

}  // namespace

std::span<const BinField> bin_fields() { return fields; }
std::span<const FunctionField> function_fields() { return of_function; }
std::span<const RegressionField> regression_fields() { return of_regressions; }

}  // namespace freestand::io
