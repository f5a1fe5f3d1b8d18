// LAB.yaml: which files a laboratory wrote, and which of their columns is what, in which unit and sign.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::study {

// A column, by its name, and what one of its units is in SI.
struct LabColumn {
  std::string name, unit;
  double factor = 1;            // sign included
  std::string named_unit = {};  // the unit that its name ends with; empty: none
  bool assumed = false;         // the unit is neither given nor in the name
};

struct LabFile {
  std::filesystem::path path;
  LabColumn time;
};

struct LabTest {
  std::string id;
  measurement::Role role = measurement::Role::calibration;
  LabFile floor, response;
  LabColumn acceleration;
  std::optional<LabColumn> vertical, slip, rotation, block_acceleration;
  std::optional<double> clock_s;  // of the response, behind the floor's; not given: estimated
};

struct Laboratory {
  std::string name;
  measurement::Dimensions specimen;
  measurement::Noise noise;  // 0: not given
  measurement::Tolerance tolerance;
  double sampling_dt_s = 0;  // 0: the finest step of the files
  std::vector<LabTest> tests;
};

// Throws Error (Exit::usage) with every problem of the file.
Laboratory read_laboratory(const std::filesystem::path& file);

}  // namespace freestand::study
