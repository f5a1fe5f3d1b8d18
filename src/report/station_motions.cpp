#include "report/station_motions.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/folder.hpp"
#include "base/units.hpp"
#include "motion/record.hpp"

namespace freestand::report {
namespace {

// Along an azimuth; zeros where one of the files has nothing.
std::vector<double> component(const std::filesystem::path& folder, const Station& station, double azimuth) {
  std::vector<double> sum;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> part = read_component(folder, station.files[i]);
    sum.resize(std::max(sum.size(), station.begins[i] + part.size()), 0.0);
    for (std::size_t k = 0; k < part.size(); ++k)
      sum[station.begins[i] + k] += part[k] * std::cos((azimuth - station.azimuths[i]) * pi / 180);
  }
  return sum;
}

// Gaussian smoothing with half power at the frequency.
std::vector<double> smoothed(const std::vector<double>& samples, double half_power_hz) {
  const double width = std::sqrt(std::log(2.0)) / (2 * pi * half_power_hz) / table_dt_s;
  const auto count = static_cast<std::ptrdiff_t>(samples.size()), reach = static_cast<std::ptrdiff_t>(5 * width) + 1;
  std::vector<double> weights, out(samples.size(), 0.0);
  double total = 0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double x = static_cast<double>(k) / width;
    weights.push_back(std::exp(-0.5 * x * x));
    total += weights.back();
  }
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (std::ptrdiff_t k = std::max(-reach, -i); k <= std::min(reach, count - 1 - i); ++k)
      out[static_cast<std::size_t>(i)] +=
          weights[static_cast<std::size_t>(k + reach)] / total * samples[static_cast<std::size_t>(i + k)];
  return out;
}

}  // namespace

const Station* station_of(const std::string& motion) {
  for (const Station& station : stations)
    if (motion.starts_with(station.named) && motion.ends_with("ground")) return &station;
  return nullptr;
}

std::filesystem::path station_folder(const std::filesystem::path& records) {
  const std::string event = "Loma_Prieta_1989", first = stations[0].files[0];
  std::filesystem::path folder = records;
  for (const auto& one : {records / event, records / "slammer" / event})
    if (is_there(one / first)) folder = one;
  for (const Station& station : stations)
    for (const char* file : station.files)
      if (!is_there(folder / file))
        throw Error((folder / file).string() + " is not there (table 7.1 needs the six records of its stations, in " +
                        event + "): give the folder that holds them with --records, or leave --records out",
                    Exit::data);
  return folder;
}

std::vector<double> read_component(const std::filesystem::path& folder, const std::string& file) {
  const FloorMotion motion = motion::read_record(folder / file, {.dt_s = record_dt_s, .unit = "g"});
  std::vector<double> samples;
  for (std::size_t i = 0; i < motion.segments(); ++i) samples.push_back(motion.horizontal_mps2[2 * i]);
  return samples;
}

FloorMotion table_motion(const std::filesystem::path& folder, const Station& station, double azimuth,
                         double half_power_hz) {
  std::vector<double> samples = component(folder, station, azimuth);
  if (half_power_hz > 0) samples = smoothed(samples, half_power_hz);
  double peak = 0;
  for (const double a : samples) peak = std::max(peak, std::abs(a));
  for (double& a : samples) a /= peak;
  return piecewise_linear(station.named, table_dt_s, samples);
}

}  // namespace freestand::report
