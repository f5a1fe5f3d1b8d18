// The motions of table 7.1 from records of their stations: two components, as they were cut, turned to fault-normal and
// fault-parallel, in the table's time (lengths are a quarter of the prototype's, times a half), of unit peak.
#pragma once

#include <filesystem>
#include <freestand/floor_motion.hpp>
#include <string>
#include <vector>

namespace freestand::report {

inline constexpr double length_scale = 1.0 / 4, time_scale = 1.0 / 2;
inline constexpr double record_dt_s = 0.005, table_dt_s = record_dt_s * time_scale;
inline constexpr double fault_normal = 38, fault_parallel = 128;  // azimuths, Loma Prieta 1989 (strike 128) [deg]

// The heads of these files were cut, each for itself. When one begins follows from what they hold: the two of Corralitos
// agree sample by sample with the pair of NGA-West2, which begins at one instant; those of Los Gatos differ by 497 samples in
// length, and the shaking comes 500 samples sooner in the shorter one, so that it has lost its head and both end together; in
// those of Gilroy the shaking comes at one time as they stand.
struct Station {
  const char* named;  // how the table's motions begin
  const char* files[2];
  double azimuths[2];
  std::size_t begins[2];  // samples after the first of the two
};
inline constexpr Station stations[] = {{"Loma Prieta Los Gatos PC", {"LGP-000", "LGP-090"}, {0, 90}, {0, 497}},
                                       {"Loma Prieta Corralitos", {"CLS-000", "CLS-090"}, {0, 90}, {0, 0}},
                                       {"Loma Prieta Gilroy Hist. Bldg.", {"GOF-160", "GOF-250"}, {160, 250}, {0, 0}}};

// The station of a motion on the ground; null where there is none.
const Station* station_of(const std::string& motion);

// The folder with these files: the one given, or Loma_Prieta_1989 or slammer/Loma_Prieta_1989 in it. Throws Error (Exit::data)
// that names what is missing.
std::filesystem::path station_folder(const std::filesystem::path& records);

// Samples of one file [m/s2].
std::vector<double> read_component(const std::filesystem::path& folder, const std::string& file);

// Unit peak. half_power_hz: smoothed, half power at that frequency of the table's time; 0: as recorded.
FloorMotion table_motion(const std::filesystem::path& folder, const Station&, double azimuth, double half_power_hz);

}  // namespace freestand::report
