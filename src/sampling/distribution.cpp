#include "sampling/distribution.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freestand::sampling {
namespace {

// Standard normal cut to [lower, upper]. Worked in the tail that is smaller, where the probabilities keep their digits.
double cut_normal(double lower, double upper, double u) {
  if (std::isinf(lower) && std::isinf(upper)) return gsl_cdf_ugaussian_Pinv(u);
  if (lower > 0) {
    const double a = gsl_cdf_ugaussian_Q(lower), b = gsl_cdf_ugaussian_Q(upper);
    return std::clamp(gsl_cdf_ugaussian_Qinv(a - u * (a - b)), lower, upper);
  }
  const double a = gsl_cdf_ugaussian_P(lower), b = gsl_cdf_ugaussian_P(upper);
  return std::clamp(gsl_cdf_ugaussian_Pinv(a + u * (b - a)), lower, upper);
}

double value(const Fixed& d, double) { return d.value; }

double value(const Uniform& d, double u) { return std::clamp(d.lower + u * (d.upper - d.lower), d.lower, d.upper); }

double value(const LogUniform& d, double u) {
  return std::clamp(d.lower * std::exp(u * std::log(d.upper / d.lower)), d.lower, d.upper);
}

double value(const Normal& d, double u) {
  const double z = cut_normal((d.min - d.mean) / d.standard_deviation, (d.max - d.mean) / d.standard_deviation, u);
  return std::clamp(d.mean + d.standard_deviation * z, d.min, d.max);
}

double value(const Lognormal& d, double u) {
  const double lower = d.min > 0 ? std::log(d.min / d.median) / d.dispersion : -unbounded;
  const double upper = std::log(d.max / d.median) / d.dispersion;
  return std::clamp(d.median * std::exp(d.dispersion * cut_normal(lower, upper, u)), d.min, d.max);
}

double value(const Triangular& d, double u) {
  const double width = d.upper - d.lower, rise = d.mode - d.lower, fall = d.upper - d.mode;
  const double x =
      u * width <= rise ? d.lower + std::sqrt(u * width * rise) : d.upper - std::sqrt((1 - u) * width * fall);
  return std::clamp(x, d.lower, d.upper);
}

double value(const Choice& d, double u) { return d.values[pick(d.values.size(), d.weights, u)]; }

double value(const Posterior& d, double u) { return d.values[pick(d.values.size(), {}, u)]; }

// P(Z <= z) of the standard normal cut to [lower, upper], in the smaller tail as above.
double below_in_cut_normal(double lower, double upper, double z) {
  z = std::clamp(z, lower, upper);
  if (lower > 0) {
    const double a = gsl_cdf_ugaussian_Q(lower), b = gsl_cdf_ugaussian_Q(upper);
    return (a - gsl_cdf_ugaussian_Q(z)) / (a - b);
  }
  const double a = gsl_cdf_ugaussian_P(lower), b = gsl_cdf_ugaussian_P(upper);
  return (gsl_cdf_ugaussian_P(z) - a) / (b - a);
}

double below(const Fixed& d, double x) { return x < d.value ? 0 : 1; }

double below(const Uniform& d, double x) { return std::clamp((x - d.lower) / (d.upper - d.lower), 0.0, 1.0); }

double below(const LogUniform& d, double x) {
  return x > d.lower ? std::min(std::log(x / d.lower) / std::log(d.upper / d.lower), 1.0) : 0;
}

double below(const Normal& d, double x) {
  const auto z = [&](double value) { return (value - d.mean) / d.standard_deviation; };
  return below_in_cut_normal(z(d.min), z(d.max), z(x));
}

double below(const Lognormal& d, double x) {
  const auto z = [&](double value) { return value > 0 ? std::log(value / d.median) / d.dispersion : -unbounded; };
  return below_in_cut_normal(z(d.min), z(d.max), z(x));
}

double below(const Triangular& d, double x) {
  if (x <= d.lower) return 0;
  if (x >= d.upper) return 1;
  const double width = d.upper - d.lower;
  return x < d.mode ? (x - d.lower) * (x - d.lower) / (width * (d.mode - d.lower))
                    : 1 - (d.upper - x) * (d.upper - x) / (width * (d.upper - d.mode));
}

double below(const Choice& d, double x) {
  double here = 0, sum = 0;
  for (std::size_t i = 0; i < d.values.size(); ++i) {
    const double weight = d.weights.empty() ? 1 : d.weights[i];
    sum += weight;
    if (d.values[i] <= x) here += weight;
  }
  return here / sum;
}

double below(const Posterior& d, double x) { return below(Choice{d.values, {}}, x); }

Support ends(const Fixed& d) { return {d.value, d.value, false, false}; }
Support ends(const Uniform& d) { return {d.lower, d.upper, true, true}; }
Support ends(const LogUniform& d) { return {d.lower, d.upper, true, true}; }
Support ends(const Normal& d) { return {d.min, d.max, true, true}; }
Support ends(const Lognormal& d) { return {d.min, d.max, true, true}; }
Support ends(const Triangular& d) { return {d.lower, d.upper, true, true}; }
Support ends(const Choice& d) {
  const auto [least, greatest] = std::minmax_element(d.values.begin(), d.values.end());
  return {*least, *greatest, false, false};
}

Support ends(const Posterior& d) { return ends(Choice{d.values, {}}); }

std::string list(const std::vector<double>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i ? ", " : "") + number_text(values[i]);
  return text + "]";
}

std::string weights_text(const std::vector<double>& weights) {
  return weights.empty() ? "" : ", weights: " + list(weights);
}

std::string limits_text(double min, double no_min, double max) {
  return (min > no_min ? ", min: " + number_text(min) : "") + (max < unbounded ? ", max: " + number_text(max) : "");
}

// A name stands bare where YAML reads it back as the same text, otherwise in single quotes.
std::string quoted(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  const bool bare = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
                    std::all_of(name.begin(), name.end(), plain);
  if (bare) return name;
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? "''" : std::string(1, c);
  return text + "'";
}

std::string text(const Fixed& d) { return number_text(d.value); }
std::string text(const Uniform& d) { return "{uniform: " + list({d.lower, d.upper}) + "}"; }
std::string text(const LogUniform& d) { return "{log_uniform: " + list({d.lower, d.upper}) + "}"; }
std::string text(const Normal& d) {
  return fmt::format("{{normal: {{mean: {}, standard_deviation: {}{}}}}}", number_text(d.mean),
                     number_text(d.standard_deviation), limits_text(d.min, -unbounded, d.max));
}
std::string text(const Lognormal& d) {
  return fmt::format("{{lognormal: {{median: {}, dispersion: {}{}}}}}", number_text(d.median),
                     number_text(d.dispersion), limits_text(d.min, 0, d.max));
}
std::string text(const Triangular& d) { return "{triangular: " + list({d.lower, d.mode, d.upper}) + "}"; }
std::string text(const Choice& d) { return "{choice: " + list(d.values) + weights_text(d.weights) + "}"; }
std::string text(const Posterior& d) {
  return "{posterior: " + quoted(d.table) + ", column: " + quoted(d.column) + ", values: " + list(d.values) + "}";
}

}  // namespace

double quantile(const Distribution& distribution, double u) {
  return std::visit([u](const auto& d) { return value(d, u); }, distribution);
}

double cumulative(const Distribution& distribution, double x) {
  return std::visit([x](const auto& d) { return below(d, x); }, distribution);
}

std::size_t pick(std::size_t count, const std::vector<double>& weights, double u) {
  if (weights.empty()) return std::min(static_cast<std::size_t>(u * static_cast<double>(count)), count - 1);
  const double target = u * std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (weights[i] <= 0) continue;
    sum += weights[i];
    last = i;
    if (target < sum) return i;
  }
  return last;
}

Support support(const Distribution& distribution) {
  return std::visit([](const auto& d) { return ends(d); }, distribution);
}

bool is_fixed(const Distribution& distribution) { return std::holds_alternative<Fixed>(distribution); }

std::string to_string(const Distribution& distribution) {
  return std::visit([](const auto& d) { return text(d); }, distribution);
}

std::string to_string(const Names& names) {
  std::string list = "[";
  for (std::size_t i = 0; i < names.values.size(); ++i) list += (i ? ", " : "") + quoted(names.values[i]);
  list += "]";
  return names.weights.empty() ? list : "{choice: " + list + weights_text(names.weights) + "}";
}

std::string number_text(double value) { return fmt::format("{}", value); }

}  // namespace freestand::sampling
