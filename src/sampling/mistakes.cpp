// Which distributions are impossible, and what to say about them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sampling/distribution.hpp"

namespace freestand::sampling {
namespace {

using Mistake = std::optional<std::string>;

bool finite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

Mistake not_finite() { return "a value is not a finite number (infinite or not a number): give finite numbers"; }

Mistake ordered(double lower, double upper) {
  if (!finite({lower, upper})) return not_finite();
  if (lower < upper) return {};
  return fmt::format("impossible distribution (its lower end {} is not below its upper end {}): {}", number_text(lower),
                     number_text(upper),
                     lower == upper ? "give the single number instead" : "write the smaller number first");
}

Mistake cut(double lower, double upper) {
  if (lower < upper) return {};
  return fmt::format("impossible distribution (its min {} is not below its max {}): exchange them or leave one out",
                     number_text(lower), number_text(upper));
}

// Is there probability between the limits, in standard normal units? Each tail is worked from its own end, as quantile()
// does.
Mistake enough_left(double lower, double upper) {
  const double left = 0.5 * (std::erfc(-upper / std::sqrt(2.0)) - std::erfc(-lower / std::sqrt(2.0)));
  const double right = 0.5 * (std::erfc(lower / std::sqrt(2.0)) - std::erfc(upper / std::sqrt(2.0)));
  if (std::max(left, right) > 1e-100) return {};
  return "impossible distribution (practically nothing of it lies between min and max): move the limits or the centre";
}

Mistake check(const Fixed& d) { return finite({d.value}) ? Mistake{} : not_finite(); }
Mistake check(const Uniform& d) { return ordered(d.lower, d.upper); }

Mistake check(const LogUniform& d) {
  if (const Mistake m = ordered(d.lower, d.upper)) return m;
  if (d.lower > 0 && std::isfinite(d.upper / d.lower)) return {};
  if (d.lower > 0)
    return fmt::format(
        "impossible distribution (from {} to {} is more than numbers can tell apart): give a range that is met",
        number_text(d.lower), number_text(d.upper));
  return fmt::format(
      "impossible distribution (log_uniform needs a lower end above zero, here {}): raise it or use uniform",
      number_text(d.lower));
}

Mistake check(const Normal& d) {
  if (!finite({d.mean, d.standard_deviation}) || std::isnan(d.min) || std::isnan(d.max)) return not_finite();
  if (!(d.standard_deviation > 0))
    return fmt::format("impossible distribution (its standard_deviation {} is not above zero): {}",
                       number_text(d.standard_deviation), "give a positive one, or the single number");
  if (const Mistake m = cut(d.min, d.max)) return m;
  return enough_left((d.min - d.mean) / d.standard_deviation, (d.max - d.mean) / d.standard_deviation);
}

Mistake check(const Lognormal& d) {
  if (!finite({d.median, d.dispersion}) || std::isnan(d.min) || std::isnan(d.max)) return not_finite();
  if (!(d.median > 0))
    return fmt::format("impossible distribution (the median {} of a lognormal is not above zero): give a positive one",
                       number_text(d.median));
  if (!(d.dispersion > 0))
    return fmt::format("impossible distribution (its dispersion {} is not above zero): {}", number_text(d.dispersion),
                       "give the standard deviation of the logarithm, or the single number");
  if (d.min < 0)
    return fmt::format("impossible distribution (the min {} of a lognormal is negative): leave it out",
                       number_text(d.min));
  if (const Mistake m = cut(d.min, d.max)) return m;
  return enough_left(d.min > 0 ? std::log(d.min / d.median) / d.dispersion : -unbounded,
                     std::log(d.max / d.median) / d.dispersion);
}

Mistake check(const Triangular& d) {
  if (const Mistake m = ordered(d.lower, d.upper)) return m;
  if (!finite({d.mode})) return not_finite();
  if (d.lower <= d.mode && d.mode <= d.upper) return {};
  return fmt::format("impossible distribution (the mode {} of a triangular is outside {} to {}): {}",
                     number_text(d.mode), number_text(d.lower), number_text(d.upper), "write [lower, mode, upper]");
}

Mistake check_weights(std::size_t count, const std::vector<double>& weights) {
  if (count == 0) return "empty choice (there is nothing to draw from): list at least one value";
  if (weights.empty()) return {};
  if (weights.size() != count)
    return fmt::format("impossible choice ({} values but {} weights): give one weight for each value", count,
                       weights.size());
  double sum = 0;
  for (const double w : weights) {
    if (!std::isfinite(w) || w < 0)
      return fmt::format("impossible choice (the weight {} is negative or not finite): give weights of zero or more",
                         number_text(w));
    sum += w;
  }
  if (sum > 0) return {};
  return "impossible choice (all weights are zero): give at least one positive weight";
}

Mistake check(const Choice& d) {
  for (const double x : d.values)
    if (!std::isfinite(x)) return not_finite();
  return check_weights(d.values.size(), d.weights);
}

Mistake check(const Posterior& d) { return check(Choice{d.values, {}}); }

}  // namespace

std::optional<std::string> mistake(const Distribution& distribution) {
  return std::visit([](const auto& d) { return check(d); }, distribution);
}

std::optional<std::string> mistake(const Names& names) { return check_weights(names.values.size(), names.weights); }

}  // namespace freestand::sampling
