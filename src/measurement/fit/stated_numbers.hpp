// What a laboratory states of its specimen, its accelerometer and its clocks, and models take as stated: it may be off, by standard
// deviations that the set gives (Dataset::tolerance).
#pragma once

#include <string>
#include <vector>

#include "measurement/levels.hpp"
#include "measurement/predict/model.hpp"

namespace freestand::measurement {

inline constexpr const char *width_fault = "width_as_stated", *centre_fault = "centre_height_as_stated",
                            *gain_fault = "floor_gain_as_stated", *clock_fault = "clock_as_stated";
bool is_laboratory_fault(const std::string& name);
// "the width is 1.9 % smaller than stated". number: the factor, or the time [s].
std::string fault_sentence(const std::string& name, double number);
// ", which is as far as is sought, ..." where a number ended there; else nothing.
std::string at_its_limit(const Free& free, double number);
// "the responses are stamped 0.012 s late against the floor's channel".
std::string clock_sentence(const std::string& whose, double late_s);

struct StatedNumber {
  const char* name;  // of the fault
  Number ModelSpec::*number;
  double deviation;
  const char* unit = "1";
};
// Those that the model takes as stated and that may be off.
std::vector<StatedNumber> stated_numbers(const Tolerance&, const ModelSpec&);

// Makes it the last free number of the model, within three standard deviations to both sides of what is stated.
void let_free(ModelSpec&, const StatedNumber&);

// Does a number that let_free() made lie within what the tolerance makes by chance?
bool within_tolerance(const Free&, double number);

// One standard deviation in the cube in which fits move (to_unit), and where in it what is stated lies.
inline constexpr double deviation_in_cube = 1 / (2 * fault_deviations), stated_in_cube = 0.5;

}  // namespace freestand::measurement
