// A database of fragility: many pieces of equipment, what they were swept over, and their curves. Plain values, ready for
// files (io/database_file.hpp) and for questions (query.hpp). What is not known is NaN, or an empty text.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace freestand::database {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// A word of the tables, with what it stands for: a demand or an intensity.
struct Word {
  std::string name;  // with unit suffix where it has one: peak_slip_m
  std::string unit;  // "1" for pure numbers
  std::string symbol, summary;
  bool binary = false;  // a demand that happens or not, and takes no capacity
};

// How a curve is to be read: by its lognormal, where off_by is small; by straight lines between its points, where that is not so, or
// where a lognormal is merely not refuted: too few motions tell whether it is off by little.
inline constexpr const char* lognormal_family = "lognormal";
inline constexpr const char* points_family = "points";
inline constexpr const char* not_refuted_family = "not_refuted";

// One piece of equipment on one floor. Its numbers are what was given, or the median where that is a distribution.
struct Entry {
  std::string id, equipment, floor,
      friction;                     // equipment: the class; floor, friction: names, "" where the file names none
  std::string description, source;  // source: where its numbers come from; "assumed" is one
  double width_m = unknown, height_m = unknown, mass_kg = unknown, mu_k = unknown, mu_s = unknown;
  std::string model, effects;  // effects: names, parted by blanks
  std::string shaking;         // hash of the motions
  std::string scatter;  // of what is drawn from a distribution: "friction.mu_k x1.35", its 84 % point over its median

  // Somebody else's fragility of the same equipment, a lognormal of the probability of a demand beyond a capacity (NaN: it
  // takes none). No source: there is none.
  std::string reference_source, reference_id, reference_im, reference_demand;
  double reference_capacity = unknown, reference_median = unknown, reference_dispersion = unknown;

  std::int64_t version = 1;  // raised whenever the entry is computed anew from another study
  std::string study;         // expanded
  std::string fingerprint;   // of the study
  std::string kernel, program, git_commit, created_utc;
  std::int64_t seed = 0, samples = 0, failed = 0;  // failed: without a result, in none of the curves
  std::int64_t motions = 0;                        // groups of motions: what the bands are from
};

struct Point {
  double im = unknown;  // mean of the samples of its bin
  double probability = unknown, lower = unknown, upper = unknown;
  std::int64_t n = 0;  // samples of the bin
};

// P(demand > capacity | intensity) of one entry: counted or fitted bin by bin, and one lognormal over all of them.
struct Curve {
  std::size_t entry = 0;  // position in Database::entries
  std::string im = {}, demand = {};
  double capacity = unknown;                     // of a binary demand 0.5
  std::int64_t n = 0;                            // samples
  double im_least = unknown, im_most = unknown;  // what was swept
  std::string family = points_family;
  double median = unknown, dispersion = unknown, median_se = unknown, dispersion_se = unknown;
  std::int64_t extrapolated = 0;  // 1: its median lies outside of what was swept
  double misfit = unknown, misfit_im = unknown,
         misfit_p = unknown;       // largest |lognormal - counted|, where, its p value
  double off_by = unknown;         // the true shares are off the lognormal by no more
  std::vector<Point> points = {};  // in the order of im
};

struct Database {
  std::string name = {};
  std::string revision = {};  // as its file says
  double confidence = 0.95;
  std::vector<Word> intensities = {}, demands = {};  // the words of the tables: no other stands there
  std::vector<std::string> classes = {};
  std::vector<Entry> entries = {};
  std::vector<Curve> curves = {};
};

}  // namespace freestand::database
