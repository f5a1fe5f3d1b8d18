#include "motion/record_pairs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <freestand/error.hpp>
#include <limits>
#include <map>

namespace freestand::motion {
namespace {

// Sensors are set up at right angles to a degree or so; what is written is rounded to one.
constexpr double right_angle_slack_deg = 1.5;

// 1, -1, or 0 where the two are not at a right angle.
int side_of(double azimuth_deg, double other_deg) {
  const double turn = std::remainder(other_deg - azimuth_deg, 360.0);
  if (std::abs(std::abs(turn) - 90) > right_angle_slack_deg) return 0;
  return turn > 0 ? 1 : -1;
}

std::string why_no_pair(const std::vector<const RecordRow*>& of_station) {
  if (of_station.front()->station.empty()) return "the table has no column station, which tells what belongs together";
  if (of_station.size() != 2) return fmt::format("its station has {} horizontal components", of_station.size());
  const RecordRow &a = *of_station[0], &b = *of_station[1];
  if (!a.azimuth_deg || !b.azimuth_deg) return "where its components point is not known: give azimuth_deg";
  if (side_of(*a.azimuth_deg, *b.azimuth_deg) == 0)
    return fmt::format("its components point to {:g} and {:g} degrees, not at a right angle", *a.azimuth_deg,
                       *b.azimuth_deg);
  if (a.dt_s != b.dt_s || a.unit != b.unit || a.format != b.format || a.channel != b.channel)
    return "its two rows differ in dt_s, unit, format or channel";
  if (a.weight != b.weight || a.group != b.group || a.vertical != b.vertical)
    return "its two rows differ in weight, group or vertical";
  if (a.strike_deg != b.strike_deg) return "its two rows differ in strike_deg";
  return "";
}

RecordRow paired(RecordRow first, const RecordRow& second, const std::vector<RecordNumber>& numbers) {
  first.cross = second.file;
  first.cross_side = side_of(*first.azimuth_deg, *second.azimuth_deg);
  // What both rows give alike is the station's; intensities, durations and periods are those of one component.
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i].power != 0 || first.numbers[i] != second.numbers[i])
      first.numbers[i] = std::numeric_limits<double>::quiet_NaN();
  if (!(first.pulse == second.pulse)) first.pulse = {};
  return first;
}

}  // namespace

void pair_components(RecordTable& table) {
  std::map<std::string, std::vector<const RecordRow*>> stations;
  for (const RecordRow& row : table.rows) stations[row.station].push_back(&row);
  std::vector<RecordRow> pairs;
  std::string problems;
  for (const RecordRow& row : table.rows) {
    const auto& of_station = stations.at(row.station);
    if (const std::string why = why_no_pair(of_station); !why.empty())
      problems += fmt::format(
          "{}{}: {} is no half of a pair ({}): a pair is turned out of two horizontal components of one "
          "station",
          problems.empty() ? "" : "\n", row.where, row.file.filename().string(), why);
    else if (of_station.front() == &row)
      pairs.push_back(paired(row, *of_station[1], table.numbers));
  }
  if (!problems.empty()) throw Error(problems);
  table.rows = std::move(pairs);
}

double angle_to_azimuth_deg(const RecordRow& pair, double azimuth_deg) {
  return pair.cross_side * (azimuth_deg - *pair.azimuth_deg);
}

}  // namespace freestand::motion
