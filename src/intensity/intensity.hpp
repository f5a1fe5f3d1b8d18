// Intensity measures: ONE FILE PER MEASURE in this folder. A file declares its measure once:
//
//   const Register here{{
//       .name = "pga_g", .unit = "g", .symbol = "PGA", .summary = "...", .source = "...", .value = [](const Input& in)
//       {...}}};
//
// and from that come the study's names, the columns of samples.h5 and the labels of the pictures.
#pragma once

#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>
#include <optional>
#include <string>
#include <vector>

#include "motion/summary.hpp"

namespace freestand::intensity {

// What a measure may look at. `parameter` holds the declared default where the study gives none.
struct Input {
  const motion::MotionSummary& summary;  // of shaking.motion, unscaled
  const Shaking& shaking;
  const Specimen& specimen;
  double parameter = 0;

  // Peaks of the floor as this sample feels it.
  motion::MotionPeaks peaks() const { return motion::scaled(summary.peaks, shaking.scale, shaking.stretch); }
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
  void (*needs)(motion::SummaryRequest&, double parameter) = nullptr;  // what it reads of the summary besides the peaks
  double (*value)(const Input&) = nullptr;
  bool proportional = false;  // to the scale of the motion: a motion can be scaled to it
};

// The measure of that name, or throws Error that lists the names there are.
const Measure& find(const std::string& name);

// All measures, sorted by name.
std::vector<const Measure*> all();

// Value for one sample. Undefined ones (no friction in PTA/(mu_k g) - 1) are +inf, never an exception.
double value(const Measure& measure, const motion::MotionSummary& summary, const Shaking& shaking,
             const Specimen& specimen, std::optional<double> parameter = {});

// Adds to the request what the measure will ask of each motion's summary.
void add_needs(const Measure& measure, motion::SummaryRequest& request, std::optional<double> parameter = {});

// Puts a measure into the registry; used once in each measure's file.
struct Register {
  explicit Register(Measure measure);
};

}  // namespace freestand::intensity
