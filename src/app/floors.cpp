#include "app/floors.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>

#include "base/units.hpp"
#include "motion/building_response.hpp"
#include "motion/peaks.hpp"
#include "motion/spectrum.hpp"

namespace freestand::app {
namespace {

constexpr double floor_periods_s[] = {0.1, 0.2, 0.5, 1.0, 2.0};

void refuse_outside_the_band(const FloorMotion& ground, const std::vector<motion::Mode>& modes) {
  if (const std::string why = motion::outside_the_band(ground, modes); !why.empty())
    throw Error(fmt::format("{}: {}", ground.name, why), Exit::data);
}

std::string modes_text(const motion::Building& building, const std::vector<motion::Mode>& modes) {
  std::string text = fmt::format("  building {}: {} storeys\n    mode  period s  damping  share of mass\n",
                                 building.name, building.floors());
  for (std::size_t m = 0; m < modes.size(); ++m)
    text += fmt::format("    {:>4}  {:>8.4f}  {:>7.4f}  {:>13.4f}\n", m + 1, modes[m].period_s(), modes[m].damping,
                        modes[m].mass_share);
  return text;
}

}  // namespace

std::string floors_text(const FloorMotion& ground, const motion::Building& building) {
  const std::vector<motion::Mode> modes = motion::modes(building);
  refuse_outside_the_band(ground, modes);
  motion::BuildingResponse response(ground, modes);
  std::string text = modes_text(building, modes);
  text += "    storey  height m   PFA g  of PGA  PFV m/s  of PGV   Sa of the floor, 5 % damped, g:";
  for (const double period : floor_periods_s) text += fmt::format("  {:g} s", period);
  text += "  samples\n";
  const motion::MotionPeaks below = motion::peaks(ground);
  for (int storey = building.floors(); storey >= 0; --storey) {
    const FloorMotion floor = response.floor(storey, ground.name);
    const motion::MotionPeaks peaks = motion::peaks(floor);
    const auto height = building.height_m(building.floors()) ? building.height_m(storey) : std::nullopt;
    text += fmt::format("    {:>6}  {:>8}  {:>6.4f}  {:>6.3f}  {:>7.4f}  {:>6.3f}  {:>30}", storey,
                        height ? fmt::format("{:.2f}", *height) : "", peaks.pga_mps2 / standard_gravity_mps2,
                        peaks.pga_mps2 / below.pga_mps2, peaks.pgv_mps, peaks.pgv_mps / below.pgv_mps, "");
    for (const double period : floor_periods_s)
      text += fmt::format(" {:>6.3f}", motion::spectral_acceleration_mps2(floor, period) / standard_gravity_mps2);
    text += fmt::format("  {:>7}\n", floor.knot_s.size());
  }
  return text;
}

FloorMotion floor_of(const FloorMotion& ground, const motion::Building& building, int storey) {
  const std::vector<motion::Mode> modes = motion::modes(building);
  refuse_outside_the_band(ground, modes);
  return motion::BuildingResponse(ground, modes)
      .floor(storey, fmt::format("{} {} storey {}", ground.name, building.name, storey));
}

}  // namespace freestand::app
