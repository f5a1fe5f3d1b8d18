// Intensity measures: ONE FILE PER MEASURE in this folder. A file declares its measure once:
//
//   const Register here{{
//       .name = "pga_g", .unit = "g", .symbol = "PGA", .summary = "...", .source = "...", .value = [](const Input& in)
//       {...}}};
//
// and from that come the study's names, `freestand im`, the ranking and the labels of the pictures.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "motion/summary.hpp"

namespace freestand::intensity {

// What a measure may look at: the sample's motion at unit scale, and what the sample's row holds.
struct Input {
  const motion::MotionSummary& motion;
  double scale = 1, stretch = 1;  // the floor's acceleration is scale * motion(t / stretch); stretch is 1 for records
  double alpha_rad = 0, p_radps = 0, mu_k = 0;  // of the block: slenderness, frequency parameter, kinetic friction
  double parameter = 0;                         // the declared default where the study gives none

  // Peaks of the floor as this sample feels it.
  motion::MotionPeaks peaks() const { return motion::scaled(motion.peaks, scale, stretch); }
};

// The one number a measure may take, as the period of Sa(T).
struct Parameter {
  std::string name;  // with unit suffix: period_s
  double fallback = 0;
};

struct Measure {
  std::string name;     // as in the study file, with unit suffix where it has one
  std::string unit;     // "1" for pure numbers
  std::string symbol;   // as on an axis
  std::string summary;  // one line
  std::string source;
  std::optional<Parameter> parameter = {};
  std::optional<double> damping = {};              // of its oscillator, of critical
  std::function<double(const Input&)> value = {};  // undefined ones (no friction in PTA/(mu_k g) - 1) are +inf
  bool proportional = false;                       // to the scale of the motion: a motion can be scaled to it
  bool spectral = false;                           // reads the spectrum
  bool of_the_ground = false;                      // ground.NAME
};

// ground.NAME of each measure NAME that is of the motion alone: the same of the ground under the building, MotionSummary::ground.
// Sorted by name.
std::vector<const Measure*> of_the_ground();

// The measure of that name, or throws Error that lists the names there are. record.COLUMN is what tables of records give, at
// the scale of the sample (motion/record_table.hpp); nan for motions of which none does.
const Measure& find(const std::string& name);

// All measures, sorted by name.
std::vector<const Measure*> all();

// What the measure takes: the given number, or its default where none is given.
double parameter_of(const Measure& measure, std::optional<double> given);

// Puts a measure into the registry; used once in each measure's file.
struct Register {
  explicit Register(Measure measure);
};

}  // namespace freestand::intensity
