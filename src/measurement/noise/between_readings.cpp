#include "measurement/noise/between_readings.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::measurement {
namespace {

// Every second reading, from the first on, moved by that share of the way to what the others say; the first and the last one stay.
std::vector<double> strayed(const std::vector<double>& readings, std::size_t first, bool smooth, double share) {
  std::vector<double> places, values;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (i < first || (i - first) % 2 != 0 || i + 1 == readings.size())
      places.push_back(static_cast<double>(i)), values.push_back(readings[i]);
  if (readings.empty()) return readings;
  std::vector<double> moved = curve_through(places, values, smooth, 1, readings.size());
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = readings[i] + share * (moved[i] - readings[i]);
  return moved;
}

// The middle between readings at -3, -1, 1 and 3, by the line or the cubic through them.
struct Middle {
  double inner, outer;
  double from_noise() const { return 1 + 2 * (inner * inner + outer * outer); }  // of 1 on each reading
};

constexpr Middle of_line{.inner = 0.5, .outer = 0}, of_cubic{.inner = 9.0 / 16, .outer = -1.0 / 16};

// Mean square by which the middles between readings that are two times so many steps apart are missed, without what noise adds.
double missed(const std::vector<double>& readings, std::size_t steps, bool smooth, double noise) {
  const Middle middle = smooth ? of_cubic : of_line;
  double sum = 0, count = 0;
  for (std::size_t i = 3 * steps; i + 3 * steps < readings.size(); ++i, ++count)
    sum += std::pow(readings[i] - middle.inner * (readings[i - steps] + readings[i + steps]) -
                        middle.outer * (readings[i - 3 * steps] + readings[i + 3 * steps]),
                    2);
  return count > 0 ? std::max(0.0, sum / count - middle.from_noise() * noise * noise) : 0;
}

}  // namespace

BetweenReadings between_readings(const FloorReadings& read, double noise_mps2) {
  if (read.horizontal_mps2.size() < 5) return {};
  const bool smooth = read.smooth();
  // What steps of 2 h miss over what h misses, as errors of histories go.
  const double by_one = missed(read.horizontal_mps2, 1, smooth, noise_mps2),
               by_two = missed(read.horizontal_mps2, 2, smooth, noise_mps2);
  const double of_smooth = smooth ? 16 : 4, ratio = by_one > 0 ? std::sqrt(by_two / by_one) : of_smooth;
  BetweenReadings found;
  found.share = 1 / (std::clamp(ratio, 2.0, of_smooth) - 1);
  for (const std::size_t first : {1U, 2U})
    found.strayed.push_back(
        motion_through({read.name, read.step_s, strayed(read.horizontal_mps2, first, smooth, found.share),
                        strayed(read.vertical_mps2, first, smooth, found.share)}));
  return found;
}

}  // namespace freestand::measurement
