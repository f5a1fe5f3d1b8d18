// Recorded motions: one file per format in this folder (format_*.cpp), one function to read them all.
#pragma once

#include <filesystem>
#include <freestand/floor_motion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace freestand::motion {

enum class Component { any, horizontal, vertical };

// What the user says about a record. A file that says otherwise is an error: nothing is overridden silently.
struct ReadOptions {
  std::optional<double> dt_s = {};  // time step; needed by plain one-column files
  std::string unit = {};            // "g", "m/s2", "cm/s2" (or "gal"), "mm/s2", "in/s2", "ft/s2"; needed by plain files
  std::string format = {};          // name of a format; empty: found from the content
  std::string channel =
      {};  // of files that hold several: its number ("2") or name ("H1"); empty: the first horizontal one
  // Of files that hold several channels: `horizontal` refuses a vertical one, `vertical` takes that first.
  Component component = Component::any;
  std::string vertical_file = {};  // record of the vertical component, same step; the shorter of the two ends at rest
  // Record of the other horizontal component. `keep_cross`: it becomes the motion's second channel. Else the motion is turned by
  // this angle from this component towards that one: what is read is this * cos + other * sin, each to the bit at 0 and 90
  // degrees. The same file again means the other horizontal channel in it.
  std::string cross_file = {};
  bool keep_cross = false;
  double rotate_deg = 0;
  bool begin_together = false;  // the user says it of a pair: files of other lengths end at other times
};

// Reads a record. The motion's name is the path as given. Files that hold a vertical channel beside the horizontal one
// (floor csv, CSMIP V2) keep it. Throws Error (Exit::data) that names file and line; Error (Exit::usage) when an option
// is missing, unknown or contradicts the file. A pair of horizontal components must begin together: same step, and the same
// stated start of time, or, where the files state none, the same length, unless the user says that they do; else Error (Exit::data) names both.
FloorMotion read_record(const std::filesystem::path& path, const ReadOptions& options = {});

// What is known of the direction of the channel that these options choose.
struct Direction {
  std::string vertical;  // the sign of a vertical one, in words; empty: horizontal
  // Positive downwards in the file, and read so by read_record(): channels that are called vertical are turned over there.
  bool down = false;
};
Direction direction_of(const std::filesystem::path& path, const ReadOptions& options = {});

// Files that a pattern (`*`, `?`, `[...]`) matches, or the files of a folder, sorted by name; a relative pattern starts
// at `base`. Throws Error when there is none.
std::vector<std::filesystem::path> expand_glob(const std::string& pattern, const std::filesystem::path& base = {});

// Does a pattern name a folder, or all that is in one ("records", "records/*")? Then what is no record may lie there too.
bool names_whole_folder(const std::string& pattern, const std::filesystem::path& base = {});

// Is the file no record, as far as its beginning tells? Why; "" where it looks like one of the formats.
std::string why_no_record(const std::filesystem::path& path);

// Name and one line about each format, sorted by name.
struct FormatInfo {
  std::string name, summary;
};
std::vector<FormatInfo> record_formats();

// m/s2 in one of the units above, however it is written: cm/s2, cm/s/s, cm/sec**2, gals. Throws Error that lists them.
double acceleration_unit_mps2(const std::string& unit);
bool is_acceleration_unit(const std::string& unit);

}  // namespace freestand::motion
