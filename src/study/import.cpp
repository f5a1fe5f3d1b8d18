#include "study/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"
#include "measurement/noise/third_differences.hpp"
#include "study/doubts.hpp"
#include "study/import_clocks.hpp"
#include "study/import_grid.hpp"
#include "study/import_text.hpp"

namespace freestand::study {
namespace {

class Importer {
 public:
  explicit Importer(const Laboratory& lab) : lab_(lab) {}

  Imported run() {
    std::vector<File> floors, responses;
    for (const LabTest& test : lab_.tests) {
      floors.push_back(read_file(test.floor));
      responses.push_back(read_file(test.response));
    }
    auto [late_s, sentences] = clocks(lab_, floors, responses);
    out_.sentences = std::move(sentences);
    for (std::size_t i = 0; i < floors.size(); ++i) take(lab_.tests[i], floors[i], responses[i], late_s[i]);
    tell_noise();
    out_.files.emplace_back("dataset.yaml", dataset_text(lab_, noise_, tests_));
    for (const TestOfLab& t : tests_) out_.files.emplace_back(t.test.id + ".csv", csv_text(t));
    return std::move(out_);
  }

 private:
  void say(std::string sentence) { out_.sentences.push_back(std::move(sentence)); }

  void take(const LabTest& lab, const File& floor, const File& response, double clock_s) {
    TestOfLab t = on_one_clock(lab_, lab, floor, response, clock_s);
    tell(lab, floor, response, t);
    see_floor_noise(lab, floor, t.test.dt_s);
    see_noise(noise_.slip_m, response, lab.slip, lab_.noise.slip_m);
    see_noise(noise_.rotation_rad, response, lab.rotation, lab_.noise.rotation_rad);
    see_noise(noise_.block_acceleration_mps2, response, lab.block_acceleration, lab_.noise.block_acceleration_mps2);
    tests_.push_back(std::move(t));
  }

  static std::string changed(const LabColumn& column, const std::string& to) {
    return fmt::format("{} in {}{} is {}", shown(column.name), shown(column.unit),
                       column.factor < 0 ? ", turned round," : "", to);
  }

  void tell(const LabTest& lab, const File& floor, const File& response, const TestOfLab& t) {
    const double step_s = t.test.dt_s;
    std::vector<std::string> columns = {changed(lab.acceleration, "floor_acceleration_mps2")};
    if (lab.vertical) columns.push_back(changed(*lab.vertical, "floor_vertical_acceleration_mps2"));
    if (lab.slip) columns.push_back(changed(*lab.slip, "slip_m"));
    if (lab.rotation) columns.push_back(changed(*lab.rotation, "rotation_rad"));
    if (lab.block_acceleration) columns.push_back(changed(*lab.block_acceleration, "block_acceleration_mps2"));
    for (const LabFile* file : {&lab.floor, &lab.response})
      if (file->time.factor != 1) columns.push_back(changed(file->time, "the time"));
    say(fmt::format("{}: {}", lab.id, fmt::join(columns, "; ")));
    const double apart = lab.clock_s ? 0 : response.time.front() - floor.time.front();
    say(fmt::format(
        "{}: floor in steps of {:.4g} s, response of {:.4g} s, both now of {:.4g} s; {:.4g} s of {:.4g} s and {:.4g} s "
        "are in both{}",
        lab.id, floor.step_s, response.step_s, step_s, step_s * static_cast<double>(t.floor.size() - 1),
        floor.time.back() - floor.time.front(), response.time.back() - response.time.front(),
        std::abs(apart) > longest_offset_s
            ? fmt::format(
                  ", which begin {:.4g} s apart by their times: is that so, or are these of two clocks (clock_s)?",
                  std::abs(apart))
            : ""));
    for (const File* file : {&floor, &response})
      if (file->step_s > coarsest_step_s)
        say(fmt::format("{}: the time step of {} is {:.4g} s: is its time in seconds?", lab.id,
                        file->table.file.filename().string(), file->step_s));
    if (std::abs(t.start_s) > 0.5 * step_s)
      say(fmt::format("{}: time 0 is now what was {:.6g} s in {}", lab.id, t.start_s,
                      lab.floor.path.filename().string()));
    // At a share s between two samples white noise keeps (s^2 + (1 - s)^2)^(1/2): in the mean of its square 2/3, and where each n-th one is a
    // sample 1/(3 n^2) more.
    if (std::abs(response.step_s / step_s - 1) > 1e-3)
      say(fmt::format(
          "{}: {} is read between its samples, on straight lines: white noise keeps some {:.2g} of its size, and "
          "is alike from step to step; compare will say so",
          lab.id, response.table.file.filename().string(),
          std::sqrt(2.0 / 3 + (t.test.steps_a_reading > 1 ? std::pow(t.test.steps_a_reading, -2) / 3 : 0))));
    for (const File* file : {&floor, &response})
      if (step_s > 1.5 * file->step_s)
        say(fmt::format(
            "{}: of {} one row in {:.3g} is taken, and what is faster than {:.3g} Hz seems slower: filter it "
            "first, or leave sampling_dt_s out",
            lab.id, file->table.file.filename().string(), step_s / file->step_s, 0.5 / step_s));
    std::vector<std::string> unused;
    const auto see = [&](const LabTable& table, const std::vector<const LabColumn*>& used) {
      for (const std::string& name : table.columns)
        if (std::none_of(used.begin(), used.end(), [&](const LabColumn* c) { return c && c->name == name; }))
          unused.push_back(fmt::format("{} of {}", shown(name), table.file.filename().string()));
    };
    const auto if_there = [](const std::optional<LabColumn>& column) { return column ? &*column : nullptr; };
    const bool one_file = lab.floor.path == lab.response.path;
    std::vector<const LabColumn*> of_floor = {&lab.floor.time, &lab.acceleration, if_there(lab.vertical)};
    const std::vector<const LabColumn*> of_response = {&lab.response.time, if_there(lab.slip), if_there(lab.rotation),
                                                       if_there(lab.block_acceleration)};
    if (one_file)
      of_floor.insert(of_floor.end(), of_response.begin(), of_response.end());
    else
      see(response.table, of_response);
    see(floor.table, of_floor);
    if (!unused.empty()) say(fmt::format("{}: not used: {}", lab.id, fmt::join(unused, ", ")));
    for (const LabTable* table : {&floor.table, &response.table})
      if (!table->with_comma.empty() && (table == &floor.table || !one_file))
        say(fmt::format("{}: commas of {} are taken as decimal points: {} is {}", lab.id,
                        table->file.filename().string(), table->with_comma,
                        std::string(table->with_comma).replace(table->with_comma.find(','), 1, ".")));
    tell_gaps(lab, floor, lab.floor);
    if (!one_file) tell_gaps(lab, response, lab.response);
    for (const LabColumn* column : {&lab.floor.time, &lab.acceleration, if_there(lab.vertical)})
      if (column) tell_unit(lab, *column, floor.table);
    for (const LabColumn* column :
         {&lab.response.time, if_there(lab.slip), if_there(lab.rotation), if_there(lab.block_acceleration)})
      if (column) tell_unit(lab, *column, response.table);
  }

  // Between the ends of a gap the channels go straight.
  void tell_gaps(const LabTest& lab, const File& file, const LabFile& of) {
    std::vector<std::string> gaps;
    std::size_t count = 0;
    constexpr std::size_t most_told = 5;
    for (std::size_t i = 1; i < file.time.size(); ++i) {
      if (!is_behind_gap(file, i)) continue;
      if (++count <= most_told)
        gaps.push_back(fmt::format("{:.4g} s before line {} (at {:.4g} s)", file.time[i] - file.time[i - 1],
                                   file.table.lines[i], file.time[i]));
    }
    if (count > 0)
      say(fmt::format("{}: {} lacks {} row{}, filled by straight lines: {}{}", lab.id, of.path.filename().string(),
                      count, count == 1 ? "" : "s", fmt::join(gaps, ", "), count > most_told ? " ..." : ""));
  }

  // "(mm)", "[mm]" -> "mm".
  static std::string without_brackets(const std::string& unit) {
    const auto first = unit.find_first_not_of("([ "), last = unit.find_last_not_of(")] ");
    return first == std::string::npos ? "" : unit.substr(first, last - first + 1);
  }

  // What the file says of a column in its line of units is not passed over.
  void tell_unit(const LabTest& lab, const LabColumn& column, const LabTable& table) {
    const std::string written = table.units.empty() ? "" : without_brackets(table.units[table.column(column.name)]);
    if (!written.empty() && written != column.unit) {
      const std::string says =
          fmt::format("{}: {} has {} in its line of units", lab.id, shown(column.name), shown(written));
      if (column.assumed)
        throw Error(
            fmt::format("{}, and unit: is not given (without it {} would be taken): give it", says, column.unit),
            Exit::data);
      say(fmt::format("{}, and is taken as {}", says, shown(column.unit)));
    }
    if (!written.empty() && column.assumed) return;
    if (column.assumed)
      say(fmt::format(
          "{}: no unit of {} is given, nor does its name end with one that is known: taken as {} (unit: says another)",
          lab.id, shown(column.name), shown(column.unit)));
    if (!column.named_unit.empty() && column.named_unit != column.unit)
      say(fmt::format("{}: the name of {} ends with {}, and unit: says {}: taken as {}", lab.id, shown(column.name),
                      shown(column.named_unit), shown(column.unit), shown(column.unit)));
  }

  // The largest of the tests.
  static void see_noise(double& noise, const File& file, const std::optional<LabColumn>& column, double given) {
    noise = std::max(noise, noise_of(file, column, given));
  }

  // Samples that are read between those of a slower floor hide its noise. White noise of sigma at a step of h shakes a block as that of
  // sigma sqrt(h/k) at a step of k does: both have the spectrum sigma^2 h.
  void see_floor_noise(const LabTest& lab, const File& floor, double step_s) {
    const double own_s = floor.step_s;
    if (own_s < 1.01 * step_s) return;  // a clock's rounding, and half a percent of noise
    const double given = lab_.noise.floor_acceleration_mps2;
    const bool heard = given <= 0 && measurement::is_smooth(floor.step_s);
    const double own = heard ? measurement::slow_noise(channel(floor.table, lab.acceleration), floor.step_s)
                             : noise_of(floor, lab.acceleration, given);
    // The least of the tests, as one sensor reads them, at the finest of their steps.
    slow_floor_step_s_ = slow_floor_step_s_ > 0 ? std::min(slow_floor_step_s_, step_s) : step_s;
    if (const double spectrum = own * own * own_s; slow_floor_s_ == 0 || spectrum < slow_floor_spectrum_)
      slow_floor_s_ = own_s, slow_floor_spectrum_ = spectrum;
  }

  void tell_noise() {
    const auto tell_one = [&](const std::vector<double> measurement::Test::*channel, double noise, double given,
                              const char* key) {
      if (given > 0 || std::ranges::all_of(tests_, [&](const TestOfLab& t) { return (t.test.*channel).empty(); }))
        return;
      say(noise > 0
              ? fmt::format("noise.{} is not given: {:.2g} by the quiet parts; check it against the sensor's sheet",
                            key, noise)
              : fmt::format("noise.{} is not given, and {} does not scatter in any test: did its sensor live? Give "
                            "its noise, without which nothing can be compared with it",
                            key, key));
    };
    tell_one(&measurement::Test::slip_m, noise_.slip_m, lab_.noise.slip_m, "slip_m");
    tell_one(&measurement::Test::rotation_rad, noise_.rotation_rad, lab_.noise.rotation_rad, "rotation_rad");
    tell_one(&measurement::Test::block_acceleration_mps2, noise_.block_acceleration_mps2,
             lab_.noise.block_acceleration_mps2, "block_acceleration_mps2");
    noise_.floor_acceleration_mps2 = lab_.noise.floor_acceleration_mps2;
    if (slow_floor_spectrum_ > 0) {
      noise_.floor_acceleration_mps2 = std::sqrt(slow_floor_spectrum_ / slow_floor_step_s_);
      say(
          fmt::format("the floor is sampled every {:.4g} s, and read between its samples every {:.4g} s: its noise is "
                      "told as {:.3g} m/s2, white noise "
                      "at that step that moves a block as far",
                      slow_floor_s_, slow_floor_step_s_, noise_.floor_acceleration_mps2));
    }
  }

  const Laboratory& lab_;
  double slow_floor_s_ = 0, slow_floor_step_s_ = 0, slow_floor_spectrum_ = 0;  // sampled more slowly than the response
  measurement::Noise noise_;
  std::vector<TestOfLab> tests_;
  Imported out_;
};

}  // namespace

Imported import_laboratory(const Laboratory& lab) { return Importer(lab).run(); }

}  // namespace freestand::study
