// A user's own table of measured peaks, treated as the report treats its own.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "report/item.hpp"

namespace freestand::report {

// A csv with one row a test, as configs/report/table_5_1.csv has it:
//   pta_g                      peak acceleration of the floor
//   pulse_period_s, period_s   period of the pulse that stands for the motion
//   peak_slip_m (_mm, _cm, _in)
//   im, or mu, or mu_NAME ...  the intensity, or friction from which it follows; several columns of friction are so many lines
//   specimen, motion           names, may be missing; tests of one motion are not independent
// Other columns are named and not used. Throws Error that names every line that is wrong: a column that is missing (Exit::usage),
// a number that is none or not above 0, a row whose intensity is not above 0 (Exit::data).
std::vector<std::pair<Entry, Item>> own_peaks(const std::filesystem::path& table, const Jobs& jobs);

}  // namespace freestand::report
