#include "app/floors.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "motion/spectrum.hpp"

namespace freestand::app {
namespace {

constexpr double floor_periods_s[] = {0.1, 0.2, 0.5, 1.0, 2.0};

// Those of the building, some of which the record can excite.
std::vector<motion::Mode> excited_modes(const FloorMotion& ground, const motion::Building& building) {
  std::vector<motion::Mode> modes = motion::modes(building);
  if (const std::string why = motion::outside_the_band(ground, modes); !why.empty())
    throw Error(fmt::format("{}: {}", ground.name, why), Exit::data);
  return modes;
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

Floors::Floors(const FloorMotion& ground, const motion::Building& building)
    : ground_(ground), building_(building), modes_(excited_modes(ground, building)), response_(ground, modes_) {}

std::string Floors::text() {
  std::string text = modes_text(building_, modes_);
  text += "    storey  height m   PFA g  of PGA  PFV m/s  of PGV   Sa of the floor, 5 % damped, g:";
  for (const double period : floor_periods_s) text += fmt::format("  {:g} s", period);
  text += "  samples\n";
  const motion::MotionPeaks below = motion::peaks(ground_);
  for (int storey = building_.floors(); storey >= 0; --storey) {
    const FloorMotion floor = response_.floor(storey, ground_.name);
    const motion::MotionPeaks peaks = motion::peaks(floor);
    const auto height = building_.height_m(building_.floors()) ? building_.height_m(storey) : std::nullopt;
    const auto of_ground = [](double above, double ground) {
      return ground > 0 ? fmt::format("{:.3f}", above / ground) : "-";
    };
    text += fmt::format("    {:>6}  {:>8}  {:>6.4f}  {:>6}  {:>7.4f}  {:>6}  {:>30}", storey,
                        height ? fmt::format("{:.2f}", *height) : "", peaks.pga_mps2 / standard_gravity_mps2,
                        of_ground(peaks.pga_mps2, below.pga_mps2), peaks.pgv_mps,
                        of_ground(peaks.pgv_mps, below.pgv_mps), "");
    for (const double period : floor_periods_s)
      text += fmt::format(" {:>6.3f}", motion::spectral_acceleration_mps2(floor, period) / standard_gravity_mps2);
    text += fmt::format("  {:>7}\n", floor.knot_s.size());
  }
  return text;
}

FloorMotion Floors::motion_of(int storey) {
  return response_.floor(storey, fmt::format("{} {} storey {}", ground_.name, building_.name, storey));
}

}  // namespace freestand::app
