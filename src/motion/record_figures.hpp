// What there is to tell of a record, for a reader and as a table.
#pragma once

#include <filesystem>
#include <freestand/floor_motion.hpp>
#include <string>
#include <vector>

#include "motion/identify.hpp"
#include "motion/peaks.hpp"

namespace freestand::motion {

inline constexpr double bracket_g = 0.05;  // threshold of the bracketed duration

// Of the horizontal channel.
struct RecordFigures {
  std::size_t samples = 0;
  double step_s = 0, duration_s = 0;
  bool has_vertical = false;
  MotionPeaks peaks;
  double arias_mps = 0, cav_mps = 0;
  double significant_5_75_s = 0, significant_5_95_s = 0, bracketed_s = 0;
  std::vector<double> sa_mps2;  // at figure_periods_s(), 5 % damping
  IdentifiedPulse pulse;
};
RecordFigures record_figures(const FloorMotion& motion);

const std::vector<double>& figure_periods_s();

// A paragraph, without the record's name. vertical: the one channel is no horizontal one.
std::string figures_text(const RecordFigures&, bool vertical = false);

// A record and how it was read: what a table of records (record_table.hpp) says of it too.
struct ToldRecord {
  std::filesystem::path file;
  std::string unit, channel;  // empty: the file says it
  RecordFigures figures;
};

// One row a record. It is a table of records itself: paths start at `folder`, the table's own, and its numbers can be
// intensities of a study (im: record.arias_mps).
std::string figures_csv(const std::vector<ToldRecord>&, const std::filesystem::path& folder);

// Floor motion csv of a record: its samples.
std::string floor_csv(const FloorMotion& record);

}  // namespace freestand::motion
