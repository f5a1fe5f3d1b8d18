#include "motion/record_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>
#include <map>

#include "base/csv_table.hpp"
#include "base/key_names.hpp"
#include "base/shown_text.hpp"
#include "motion/component.hpp"
#include "motion/record.hpp"
#include "motion/record_text.hpp"

namespace freestand::motion {
namespace {

namespace fs = std::filesystem;

// Columns that say how to read a record, and are no intensities.
constexpr std::string_view own_columns[] = {
    "file",     "folder", "suite",   "dt_s",        "unit",       "format",     "channel",        "group", "component",
    "vertical", "event",  "station", "azimuth_deg", "strike_deg", "pulse_type", "pulse_period_s", "cross", "weight"};
// First words of columns that no scaling of the record changes, whatever their unit; their units are not those of shaking.
constexpr std::string_view properties[] = {"magnitude", "mw",     "distance",  "depth",   "vs30", "elevation",
                                           "duration",  "rjb",    "rrup",      "rhypo",   "repi", "latitude",
                                           "longitude", "period", "bandwidth", "building"};
// Units of accelerations, velocities and displacements, which go with L T^time at another scale.
struct Amplitudes {
  int time;
  std::vector<std::string_view> units;
};
const Amplitudes amplitudes[] = {
    {-2, {"g", "gal", "m/s2", "cm/s2"}}, {-1, {"m/s", "cm/s", "in/s"}}, {0, {"m", "cm", "mm", "in"}}};

template <class Words>
bool holds(const Words& words, std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

// A spectral ordinate: sa_0.5s_g, Sa(1s)_g, rotd50_1s_g.
bool is_of_a_period(const std::string& column) {
  const std::string name = lower_case(column);
  constexpr std::string_view ordinates[] = {"sa", "psa", "sv", "psv", "sd", "rotd"};
  return holds(ordinates, std::string_view(name).substr(0, name.find_first_not_of("abcdefghijklmnopqrstuvwxyz")));
}

class Reader {
 public:
  Reader(const fs::path& file, const std::string& group, bool vertical)
      : table_(read_csv_table(file)), group_(group.empty() ? "group" : group), vertical_(vertical) {
    if (!has("file"))
      throw Error(fmt::format("{} has no column file (a table of records names them): add it", file.string()),
                  Exit::data);
    if (!group.empty() && !has(group))
      throw Error(fmt::format("{} has no column {} to group by (its columns are {}): name one of them, or add it",
                              file.string(), shown(group), fmt::format("{}", fmt::join(table_.columns, ", "))),
                  Exit::data);
    for (const std::string& column : table_.columns)
      if (const auto number = record_number(column)) found_.numbers.push_back(*number);
    for (const char* column : {"event", "earthquake", "station"})
      if (!has(group_) && has(column)) found_.grouping_columns.emplace_back(column);
  }

  RecordTable read() {
    for (const CsvTable::Row& row : table_.rows) add(row);
    if (!problems_.empty()) throw Error(problems_, Exit::data);
    if (found_.rows.empty())
      throw Error(fmt::format("{} names no horizontal component (nothing would shake sideways): add some",
                              table_.file.string()),
                  Exit::data);
    if (std::all_of(found_.rows.begin(), found_.rows.end(), [](const RecordRow& row) { return row.weight == 0; }))
      throw Error(
          fmt::format("{} gives no record a weight above 0 (none would be drawn): give some", table_.file.string()),
          Exit::data);
    if (vertical_ && !has("vertical"))
      for (std::size_t i = 0; i < found_.rows.size(); ++i)
        if (const auto partner = verticals_.find(stations_[i]); partner != verticals_.end())
          found_.rows[i].vertical = partner->second;
    return std::move(found_);
  }

 private:
  bool has(const std::string& column) const { return table_.column(column) < table_.columns.size(); }
  std::string text(const CsvTable::Row& row, const std::string& column) const {
    return has(column) ? row.cells[table_.column(column)] : "";
  }
  void wrong(const CsvTable::Row& row, const std::string& what) {
    if (!problems_.empty()) problems_ += '\n';
    problems_.append(table_.at(row)).append(what);
  }

  // From the folder or suite in the table's folder, or from that itself.
  fs::path path(const CsvTable::Row& row, const std::string& column) {
    const std::string name = text(row, column);
    if (name.empty()) return {};
    const fs::path base = table_.file.parent_path();
    const std::string folder = has("folder") ? text(row, "folder") : text(row, "suite");
    std::error_code ignored;
    for (const fs::path& candidate : {base / folder / name, base / name})
      if (fs::is_regular_file(candidate, ignored)) return candidate;
    wrong(row, fmt::format("{} {} is not there (looked for {}): correct the path, which starts at the table's folder",
                           column, shown(name), (base / folder / name).string()));
    return {};
  }

  // A number, or nan for an empty cell.
  double number(const CsvTable::Row& row, const std::string& column) {
    const std::string cell = text(row, column), word = lower_case(cell);
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    if (cell.empty() || word == "nan" || word == "na" || word == "n/a" || word == "-") return nothing;
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value)) return value;
    wrong(row, fmt::format("{} is \"{}\" (a number, or nothing, is needed): correct the cell", column, shown(cell)));
    return nothing;
  }

  std::optional<double> given(const CsvTable::Row& row, const std::string& column) {
    const double value = number(row, column);
    return std::isnan(value) ? std::nullopt : std::optional(value);
  }

  std::optional<double> azimuth(const CsvTable::Row& row) {
    if (has("azimuth_deg")) return given(row, "azimuth_deg");
    const std::string component = lower_case(text(row, "component"));
    if (component == "n" || component == "ns" || component == "n-s") return 0;
    if (component == "e" || component == "ew" || component == "e-w") return 90;
    double value = 0;
    const auto [end, error] = std::from_chars(component.data(), component.data() + component.size(), value);
    const bool degrees = error == std::errc() && end == component.data() + component.size() && component.size() >= 2;
    return degrees && value >= 0 && value <= 360 ? std::optional(value) : std::nullopt;
  }

  void check(const CsvTable::Row& row, const RecordRow& record) {
    if (text(row, "file").empty()) wrong(row, "file is empty (which record is it?): name it");
    if (!(record.weight >= 0)) wrong(row, "weight is not a number from 0 on (how often is it drawn?): correct it");
    if (record.dt_s && !(*record.dt_s > 0)) wrong(row, "dt_s is not above zero (a time step is): correct it");
    if (record.pulse.period_s && !(*record.pulse.period_s > 0))
      wrong(row, "pulse_period_s is not above zero (a period is): correct it");
    if (!record.pulse.type.empty() && !holds(pulse_types(), record.pulse.type))
      wrong(row,
            fmt::format("pulse_type is \"{}\" (a record's pulse is one of {}): correct it, or leave the cell empty",
                        shown(record.pulse.type), fmt::format("{}", fmt::join(pulse_types(), ", "))));
    if (const std::string sign = record.cross.empty() ? "" : vertical_sign(record.cross); !sign.empty())
      wrong(row, fmt::format("cross is {} ({}), a vertical component: name the other horizontal one",
                             record.cross.filename().string(), sign));
    if (record.unit.empty()) return;
    try {
      acceleration_unit_mps2(record.unit);
    } catch (const Error& error) {
      wrong(row, error.what());
    }
  }

  std::string sign_of_vertical(const CsvTable::Row& row, const fs::path& file) const {
    const std::string component = text(row, "component");
    if (is_vertical_word(component)) return "its component is " + component;
    return !component.empty() || file.empty() ? "" : vertical_sign(file);
  }

  void add(const CsvTable::Row& row) {
    RecordRow record;
    record.where = fmt::format("{}:{}", table_.file.string(), row.line);
    record.file = path(row, "file");
    record.vertical = path(row, "vertical");
    record.cross = path(row, "cross");
    record.dt_s = given(row, "dt_s");
    record.pulse = {text(row, "pulse_type"), given(row, "pulse_period_s")};
    record.azimuth_deg = azimuth(row);
    record.strike_deg = given(row, "strike_deg");
    record.unit = text(row, "unit");
    record.format = text(row, "format");
    record.channel = text(row, "channel");
    record.group = text(row, group_);
    if (has("weight")) record.weight = number(row, "weight");
    for (const RecordNumber& column : found_.numbers) record.numbers.push_back(number(row, column.name));
    check(row, record);
    const std::string station = text(row, "suite") + "\n" + text(row, "event") + "\n" + text(row, "station");
    if (const std::string sign = sign_of_vertical(row, record.file); !sign.empty()) {
      found_.left_out.push_back(fmt::format("{} ({})", text(row, "file"), sign));
      if (has("station")) verticals_[station] = record.file;
      return;
    }
    if (has("station")) record.station = station;
    found_.rows.push_back(std::move(record));
    stations_.push_back(station);
  }

  CsvTable table_;
  std::string group_;
  bool vertical_;
  RecordTable found_;
  std::vector<std::string> stations_;          // of each row
  std::map<std::string, fs::path> verticals_;  // by station
  std::string problems_;
};

}  // namespace

std::optional<RecordNumber> record_number(const std::string& column) {
  if (holds(own_columns, column)) return {};
  const std::string first = lower_case(column.substr(0, column.find('_')));
  const std::string unit = column.ends_with("_km") ? "km" : unit_of(column);
  const int time = unit == "s" ? 1 : unit == "Hz" || unit == "rad/s" ? -1 : unit == "Hz/s" ? -2 : 0;
  if (holds(properties, first)) return RecordNumber{column, unit, 0, 0, time};
  if (first == "bracketed")
    return {};  // the time above a level: at another scale of the record it is another one, and none knows which
  if ((first == "arias" || first == "ia") && unit != "1")
    return RecordNumber{column, unit, 2, 2, -3};  // integral of a^2 over g
  if (unit == "1") return {};
  for (const Amplitudes& like : amplitudes)
    if (holds(like.units, unit)) return RecordNumber{column, unit, 1, 1, like.time};
  return RecordNumber{column, unit, 0, 0, time};
}

double RecordNumber::at_scale(double value, const Similitude& scale) const {
  if (scale.time != 1 && is_of_a_period(name)) return std::numeric_limits<double>::quiet_NaN();
  return value * std::pow(scale.length, length) * std::pow(scale.time, time);
}

bool is_record_table(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  const std::vector<std::string> columns = csv_columns(file);
  // Parted by semicolons: its reader says so.
  if (columns.size() == 1 && (";" + columns.front() + ";").find(";file;") != std::string::npos) return true;
  return std::find(columns.begin(), columns.end(), "file") != columns.end();
}

RecordTable read_record_table(const fs::path& file, const std::string& group, bool vertical) {
  return Reader(file, group, vertical).read();
}

}  // namespace freestand::motion
