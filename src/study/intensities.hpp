// Intensities of samples, from their rows in samples.h5 and what is kept of their motions.
#pragma once

#include <string>
#include <vector>

#include "base/table.hpp"
#include "intensity/intensity.hpp"
#include "study/motion_summaries.hpp"
#include "study/study.hpp"

namespace freestand::study {

inline constexpr const char* motion_pulse_column = "motion_pulse_period_s";

// The intensity that a study asks for, of any sample.
class SampleIntensity {
 public:
  // Throws Error (Exit::usage) for a period outside those that are kept of a record.
  SampleIntensity(const IntensityPart&, const MotionSummaries&);

  // The columns of a row that it reads.
  static const std::vector<std::string>& columns();

  // One value a row.
  std::vector<double> operator()(const Table& rows) const;

  // How well it is known between the periods that are kept of records; empty at a kept period, and where no period matters.
  const std::string& interpolation() const { return interpolation_; }

  // The rows with two columns more: motion_pulse_period_s, of the motion's pulse, and last im_NAME.
  Table beside(Table rows) const;

 private:
  const intensity::Measure& measure_;
  double parameter_;
  MotionSummaries motions_;  // of the spectrum, only what the measure reads
  std::string interpolation_;
};

}  // namespace freestand::study
