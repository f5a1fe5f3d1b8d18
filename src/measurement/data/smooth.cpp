#include "measurement/data/smooth.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::measurement {
namespace {

// Sums over j = -half .. half of j^2 and j^4.
struct Moments {
  double n, two, four;
  explicit Moments(std::size_t half) : n(2 * static_cast<double>(half) + 1), two(0), four(0) {
    for (std::size_t j = 1; j <= half; ++j) {
      const double square = static_cast<double>(j * j);
      two += 2 * square;
      four += 2 * square * square;
    }
  }
  double determinant() const { return n * four - two * two; }
};

}  // namespace

std::size_t half_window_samples(double half_window_s, double dt_s) {
  return std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(half_window_s / dt_s)));
}

Smooth smooth(const std::vector<double>& samples, double dt_s, double half_window_s) {
  const std::size_t half = half_window_samples(half_window_s, dt_s), n = samples.size(), window = 2 * half + 1;
  Smooth out{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n), half};
  if (n < window) return out;
  const Moments m(half);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t centre = std::clamp(i, half, n - 1 - half);
    double s0 = 0, s1 = 0, s2 = 0;
    for (std::size_t k = 0; k < window; ++k) {
      const double j = static_cast<double>(k) - static_cast<double>(half), y = samples[centre - half + k];
      s0 += y;
      s1 += j * y;
      s2 += j * j * y;
    }
    const double a = (m.four * s0 - m.two * s2) / m.determinant(), b = s1 / m.two;
    const double c = (m.n * s2 - m.two * s0) / m.determinant();
    const double off = static_cast<double>(i) - static_cast<double>(centre);
    out.value[i] = a + off * (b + off * c);
    out.rate[i] = (b + 2 * off * c) / dt_s;
    out.second[i] = 2 * c / (dt_s * dt_s);
  }
  return out;
}

double Smooth::firm_rate(std::size_t i) const {
  return rate.size() > 2 * half ? rate[std::clamp(i, half, rate.size() - 1 - half)] : 0;
}

double rate_noise(double dt_s, double half_window_s) {
  return 1 / (std::sqrt(Moments(half_window_samples(half_window_s, dt_s)).two) * dt_s);
}

double second_noise(double dt_s, double half_window_s) {
  const Moments m(half_window_samples(half_window_s, dt_s));
  return 2 * std::sqrt(m.n / m.determinant()) / (dt_s * dt_s);
}

}  // namespace freestand::measurement
