// Table 7.1: quarter-scale blocks, overturned or not, under the pulses that table 8.1 gives for the same motions, and, with
// the records, under ensembles of the motions themselves. A quarter of the length goes with half of the time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "report/printed_table.hpp"
#include "report/quarter_scale.hpp"
#include "report/table_pulses.hpp"

namespace freestand::report {
namespace {

// The table's words for a motion, without commas and what stands in brackets, so that tables 7.1 and 8.1 compare.
std::string plain(std::string motion) {
  motion.erase(std::remove(motion.begin(), motion.end(), ','), motion.end());
  return motion.substr(0, motion.find(" ("));
}

class PulseRows {
 public:
  explicit PulseRows(const Sources& sources)
      : table_(sources, "table_8_1.csv"), motion_(table_.texts("motion")), type_(table_.texts("pulse_type")) {}

  // In the time of the quarter-scale table, or of the prototype; no motion where table 8.1 has none of that name.
  Shaking shaking(const std::string& motion, bool quarter) {
    for (std::size_t i = 0; i < motion_.size(); ++i)
      if (plain(motion_[i]) == plain(motion)) {
        const double scale = quarter ? time_scale : 1;
        return pulses_.shaking(type_[i], table_.numbers("pulse_period_s")[i] * scale,
                               table_.numbers("pulse_velocity_in_per_s")[i] * scale);
      }
    return {};
  }

 private:
  PrintedTable table_;
  std::vector<std::string> motion_, type_;
  TablePulses pulses_;
};

Response rocked(const BlockTest& test, const Sides& sides, double scale, const Shaking& shaking) {
  return respond({Block::rectangular(sides.narrow_m * scale, sides.height_m * scale, 10), {test.mu, test.mu}, {}},
                 shaking);
}

// Largest difference between the quarter-scale block and its prototype, in rotation and in slip over length.
double off_similitude(const Response& small, const Response& large) {
  return std::max(std::abs(small.peak_rotation_rad - large.peak_rotation_rad),
                  std::abs(small.peak_slip_m / length_scale - large.peak_slip_m));
}

void under_pulses(const Sources& sources, Item& item) {
  PulseRows pulses(sources);
  const auto blocks = quarter_scale_blocks(sources);
  Sheet sheet{"table_7_1",
              {"motion", "pta_g", "pulse_peak_g", "experiment_overturned", "working_model_overturned",
               "pulse_overturned", "pulse_peak_rotation_over_alpha"},
              {}};
  int experiment = 0, model = 0, ours = 0, rows = 0;
  double off = 0;
  for (const BlockTest& test : sound_tests(sources)) {
    const Shaking shaking = pulses.shaking(test.motion, true);
    if (!shaking.motion)
      throw Error(fmt::format("table_8_1.csv has no pulse for the motion {} of table_7_1.csv (a table was changed): "
                              "give the ones of freestand's source",
                              test.motion),
                  Exit::data);
    const Sides& sides = blocks.at(test.block);
    const Response response = rocked(test, sides, 1, shaking);
    const bool overturned = response.outcome == Outcome::overturned;
    off = std::max(off,
                   off_similitude(response, rocked(test, sides, 1 / length_scale, pulses.shaking(test.motion, false))));
    ++rows;
    experiment += test.overturned;
    model += test.working_model_overturned == test.overturned;
    ours += overturned == test.overturned;
    const double alpha = std::atan(sides.narrow_m / sides.height_m);
    sheet.rows.push_back({test.block, test.motion, test.pta_g, std::abs(shaking.scale) / standard_gravity_mps2,
                          test.overturned ? 1.0 : 0.0, test.working_model_overturned ? 1.0 : 0.0,
                          overturned ? 1.0 : 0.0, response.peak_rotation_rad / alpha});
  }
  const auto add = [&](const char* id, const char* what, double value) {
    item.numbers.push_back({.id = std::string("table_7_1.") + id, .what = what, .ours = value});
  };
  add("rows", "tests of the two sound blocks", rows);
  add("experiment", "of them overturned in the experiment", experiment);
  add("working_model", "right by the report's own model, under the recorded table motions", model);
  add("pulses", "right under the pulses of table 8.1", ours);
  item.statements.push_back(
      {"table_7_1.similitude",
       "a quarter of the length and half of the time give the same rotations and slips over length",
       off < 1e-9 ? "to 1e-9" : fmt::format("off by {:.1e}", off), "the same",
       off < 1e-9 ? Verdict::agrees : Verdict::disagrees, ""});
  item.sheets.push_back(std::move(sheet));
}

void under_records(const Sources& sources, Item& item) {
  Sheet sheet{"table_7_1_records",
              {"half_power_hz", "motion", "pta_g", "experiment_overturned", "probability_normal",
               "probability_parallel", "probability_after_others"},
              {}};
  for (const double half_power_hz : {0.0, 20.0, 10.0}) {
    const std::vector<Prediction> found = predict(sources, *sources.records, half_power_hz, &Sides::narrow_m);
    const Score s = score(found);
    const std::string id = fmt::format("table_7_1.records_{:g}", half_power_hz),
                      band = half_power_hz > 0 ? fmt::format("half power at {:g} Hz", half_power_hz) : "as recorded";
    item.numbers.push_back(
        {.id = id + ".right", .what = "right of 16 under the records, " + band, .ours = static_cast<double>(s.agree)});
    item.numbers.push_back({.id = id + ".right_after_others",
                            .what = "the same, component told by the other tests, " + band,
                            .ours = static_cast<double>(s.agree_after_others)});
    item.numbers.push_back(
        {.id = id + ".brier", .what = "Brier score under the records (a coin: 0.25), " + band, .ours = s.brier});
    for (const Prediction& one : found)
      sheet.rows.push_back({one.test.block, half_power_hz, one.test.motion, one.test.pta_g,
                            one.test.overturned ? 1.0 : 0.0, one.normal, one.parallel,
                            one.mixed(weight_after_others(found, one))});
  }
  item.sheets.push_back(std::move(sheet));
}

Item table_7_1(const Sources& sources) {
  Item item;
  under_pulses(sources, item);
  if (sources.records)
    under_records(sources, item);
  else
    item.left_out.push_back(
        "outcomes under the records themselves: they are not part of freestand; freestand reproduce --records DIR "
        "computes them from a folder that holds them");
  item.left_out.push_back(
      "the eight tests of the third block, which was damaged; the motion of the 6th floor, of which no record is "
      "published (16 of 18 tests under records)");
  return item;
}

const RegisteredItem table_7_1_here{{.name = "table_7_1",
                                     .order = 710,
                                     .chapter = 7,
                                     .place = "Table 7.1",
                                     .what = "quarter-scale blocks: which tests overturned them",
                                     .compute = table_7_1}};

}  // namespace
}  // namespace freestand::report
