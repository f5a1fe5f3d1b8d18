#include "io/bin_fields.hpp"

namespace freestand::io {
namespace {

using fragility::BinFit;

template <auto member>
double get(const BinFit& bin) {
  return static_cast<double>(bin.*member);
}

constexpr auto one = FieldUnit::one, edp = FieldUnit::edp;

// clang-format off
constexpr BinField fields[] = {
  {"n", true, one, "samples in the bin, failed ones left out", get<&BinFit::n>},
  {"n_still", true, one, "samples that stood still", get<&BinFit::n_still>},
  {"n_over", true, one, "samples that overturned", get<&BinFit::n_over>},
  {"n_moved", true, one, "samples that moved and stood", get<&BinFit::n_moved>},
  {"motions", true, one, "groups of floor motions in the bin", get<&BinFit::motions>},
  {"p_still", false, one, "probability of standing still, given no overturning", get<&BinFit::p_still>},
  {"p_still_lower", false, one, "lower end of its exact binomial interval", get<&BinFit::p_still_lower>},
  {"p_still_upper", false, one, "upper end of its exact binomial interval", get<&BinFit::p_still_upper>},
  {"p_over", false, one, "probability of overturning", get<&BinFit::p_over>},
  {"p_over_lower", false, one, "lower end of its exact binomial interval", get<&BinFit::p_over_lower>},
  {"p_over_upper", false, one, "upper end of its exact binomial interval", get<&BinFit::p_over_upper>},
  {"lambda", false, one, "mean of ln EDP of the samples that moved and stood", get<&BinFit::lambda>},
  {"lambda_se", false, one, "its standard error, samples taken as independent", get<&BinFit::lambda_se>},
  {"lambda_se_motions", false, one, "its standard error from resampled motions", get<&BinFit::lambda_se_motions>},
  {"omega", false, one, "standard deviation of ln EDP of the samples that moved and stood", get<&BinFit::omega>},
  {"omega_se", false, one, "its standard error, samples taken as independent", get<&BinFit::omega_se>},
  {"omega_se_motions", false, one, "its standard error from resampled motions", get<&BinFit::omega_se_motions>},
  {"mean", false, edp, "mean of the fitted lognormal", get<&BinFit::mean>},
  {"standard_deviation", false, edp, "standard deviation of the fitted lognormal", get<&BinFit::standard_deviation>},
  {"ks_statistic", false, one, "Kolmogorov-Smirnov statistic", get<&BinFit::ks_statistic>},
  {"ks_resolution", false, one, "bound on its error from the histogram", get<&BinFit::ks_resolution>},
  {"ks_p_textbook", false, one, "p value as if the parameters were known beforehand", get<&BinFit::ks_p_textbook>},
  {"ks_critical_textbook", false, one, "critical value of the same at 5 %", get<&BinFit::ks_critical_textbook>},
  {"ks_p_estimated", false, one, "p value for parameters estimated from the same samples", get<&BinFit::ks_p_estimated>},
  {"ks_critical_estimated", false, one, "critical value of the same at 5 %", get<&BinFit::ks_critical_estimated>},
  {"ad_statistic", false, one, "Anderson-Darling statistic", get<&BinFit::ad_statistic>},
  {"ad_p_estimated", false, one, "its p value for estimated parameters", get<&BinFit::ad_p_estimated>},
  {"fdr_rejected", true, one, "1: rejected with false discovery controlled over the bins", get<&BinFit::fdr_rejected>},
  {"status", true, one, "0 fitted, 1 too few samples, 2 fails goodness of fit, 3 counts only", get<&BinFit::status>},
};
// clang-format on

}  // namespace

std::span<const BinField> bin_fields() { return fields; }

}  // namespace freestand::io
