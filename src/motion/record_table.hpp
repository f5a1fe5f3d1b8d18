// A table of records: csv, one row a record. From it come what the files do not say themselves, which records belong
// together, and intensities that only its author knows.
//
//   file       path of the record, from the table's folder (needed); with a column folder or suite: from that folder in it
//   dt_s, unit, format, channel   as motion::ReadOptions; empty where the file says it
//   group      records with the same word are one group of motions: of one earthquake, two components of one station
//   weight     how often it is drawn beside the others of the table; without that column all alike
//   component  000, NS, UD ...; vertical ones are left out
//   vertical   path of the vertical component, as file; without that column, the row of a vertical component with the same
//              suite, event and station is taken, where vertical components are asked for
//   cross      path of the other horizontal component, as file: the floor then moves in both directions
//   pulse_type, pulse_period_s   what is known of the record's pulse (identify.hpp): A, B, C1, C2, and its T_p
//   azimuth_deg  of a horizontal component, clockwise from north; without that column, the component where it is a number, N or E
//   strike_deg   of the fault
//   numbers    any column with a unit at its end, and magnitude, magnitude_mw, vs30_mps and the like, is an intensity
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motion/identify.hpp"
#include "motion/similitude.hpp"

namespace freestand::motion {

// A column of numbers: what it is multiplied with when its record is scaled is |scale|^power.
struct RecordNumber {
  std::string name, unit;    // "pga_g", "g"
  int power = 1;             // 1 an amplitude; 2 Arias intensity; 0 a property: magnitude, distance, duration, site
  int length = 0, time = 0;  // at another scale (similitude.hpp) it is multiplied with L^length T^time

  // The number at that scale. NaN of a spectral ordinate (sa_1s_g) at another scale of times: it is then that of another period.
  double at_scale(double value, const Similitude&) const;
};

// The column of a table as such a number; nothing where it is none.
std::optional<RecordNumber> record_number(const std::string& column);

struct RecordRow {
  std::string where;                     // "INDEX.csv:12", for messages
  std::filesystem::path file, vertical;  // vertical: empty where there is none
  std::optional<double> dt_s;
  std::string unit, format, channel, group;
  std::vector<double> numbers;  // one for each RecordTable::numbers; nan where the cell is empty
  KnownPulse pulse = {};
  std::string station = {};  // what the records of one station and event share
  std::optional<double> azimuth_deg = {}, strike_deg = {};
  // The other horizontal component, empty where there is none; of a pair (record_pairs.hpp) 90 degrees clockwise (1) or counterclockwise (-1) from this.
  std::filesystem::path cross = {};
  int cross_side = 1;
  double weight = 1;
};

struct RecordTable {
  std::vector<RecordNumber> numbers;
  std::vector<RecordRow> rows;                // of horizontal components
  std::vector<std::string> left_out;          // vertical ones, and why they are taken for that
  std::vector<std::string> grouping_columns;  // event, station, earthquake: where the table says no group
};

// Is the file a table of records and no record? One that has a column `file`.
bool is_record_table(const std::filesystem::path& file);

// group: the column to group by; empty: the column group, if there is one. Throws Error (Exit::data) that names every row
// that is wrong: a file that is not there, an unknown unit, a step or a number that is none.
RecordTable read_record_table(const std::filesystem::path& file, const std::string& group = {}, bool vertical = false);

}  // namespace freestand::motion
