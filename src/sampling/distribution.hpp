// Distributions of the numbers of a study, each through its quantile function: one uniform in, one value out.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace freestand::sampling {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Fixed {
  double value = 0;
};
struct Uniform {
  double lower = 0, upper = 1;
};
// ln x uniform between ln lower and ln upper; 0 < lower < upper.
struct LogUniform {
  double lower = 1, upper = 2;
};
// Normal, cut to [min, max] where these are given (the rest renormalised).
struct Normal {
  double mean = 0, standard_deviation = 1;
  double min = -unbounded, max = unbounded;
};
// ln x normal with mean ln(median) and standard deviation `dispersion`; cut to [min, max] where these are given.
struct Lognormal {
  double median = 1, dispersion = 1;
  double min = 0, max = unbounded;
};
// Density rises linearly from `lower` to `mode` and falls to `upper`; lower <= mode <= upper, lower < upper.
struct Triangular {
  double lower = 0, mode = 0.5, upper = 1;
};
// One of the values; weights (any positive sum) or, when empty, all alike.
struct Choice {
  std::vector<double> values;
  std::vector<double> weights;
};

// A column of a table of joint draws, all rows alike likely. Numbers of one table share the uniform that picks the row.
struct Posterior {
  std::string table, column;
  std::vector<double> values;
};

using Distribution = std::variant<Fixed, Uniform, LogUniform, Normal, Lognormal, Triangular, Choice, Posterior>;

// One of some names (pulse types); weights as in Choice.
struct Names {
  std::vector<std::string> values;
  std::vector<double> weights;
};

// Value with probability u below it, 0 < u < 1. Monotone in u (a Choice, a Posterior: in the order of its list).
double quantile(const Distribution&, double u);

// P(value <= x).
double cumulative(const Distribution&, double x);

// Position of the item that u in (0, 1) falls on, items 0..count-1, with the given weights (empty: all alike).
std::size_t pick(std::size_t count, const std::vector<double>& weights, double u);

// Least and greatest value. `open` ends are approached but never taken (uniform, lognormal at 0), closed ones are.
struct Support {
  double lower, upper;
  bool lower_open, upper_open;
  bool positive() const { return lower > 0 || (lower == 0 && lower_open); }
  bool not_negative() const { return lower >= 0; }
};
Support support(const Distribution&);

// Why the distribution is impossible and what to do, as "problem (why): what to do"; nothing when it is sound.
std::optional<std::string> mistake(const Distribution&);
std::optional<std::string> mistake(const Names&);

bool is_fixed(const Distribution&);

// As the study file writes it: 0.6, {uniform: [0.3, 2]}, {lognormal: {median: 0.2, dispersion: 0.25}} ... Numbers in
// the shortest text that reads back to the same bits.
std::string to_string(const Distribution&);
std::string to_string(const Names&);

// Shortest text of a number that reads back to the same bits; "0.1", "2", "1e-09".
std::string number_text(double);

}  // namespace freestand::sampling
