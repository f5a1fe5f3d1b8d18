#include "study/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"
#include "measurement/data/floor_readings.hpp"
#include "measurement/laboratory/timing.hpp"
#include "measurement/noise/third_differences.hpp"
#include "measurement/predict/bench.hpp"
#include "study/doubts.hpp"
#include "study/import_file.hpp"
#include "study/import_text.hpp"

namespace freestand::study {
namespace {

constexpr double longest_offset_s = 0.5;
constexpr double surely_mirrored = 4;  // times steadier, as more than chance is (timing.hpp)

class Importer {
 public:
  explicit Importer(const Laboratory& lab) : lab_(lab) {}

  Imported run() {
    std::vector<File> floors, responses;
    for (const LabTest& test : lab_.tests) {
      floors.push_back(read_file(test.floor));
      responses.push_back(read_file(test.response));
    }
    const std::vector<double> clock_s = clocks(floors, responses);
    for (std::size_t i = 0; i < floors.size(); ++i) take(lab_.tests[i], floors[i], responses[i], clock_s[i]);
    tell_noise();
    out_.files.emplace_back("dataset.yaml", dataset_text(lab_, noise_, tests_));
    for (const TestOfLab& t : tests_) out_.files.emplace_back(t.test.id + ".csv", csv_text(t));
    return std::move(out_);
  }

 private:
  void say(std::string sentence) { out_.sentences.push_back(std::move(sentence)); }

  void take(const LabTest& lab, const File& floor, const File& response, double clock_s) {
    TestOfLab t = on_one_clock(lab, floor, response, clock_s);
    tell(lab, floor, response, t);
    see_floor_noise(lab, floor, t.test.dt_s);
    see_noise(noise_.slip_m, response, lab.slip, lab_.noise.slip_m);
    see_noise(noise_.rotation_rad, response, lab.rotation, lab_.noise.rotation_rad);
    see_noise(noise_.block_acceleration_mps2, response, lab.block_acceleration, lab_.noise.block_acceleration_mps2);
    tests_.push_back(std::move(t));
  }

  // Of each test, by how much the response is stamped late. Tests that agree to two steps were read by one clock: its
  // offset is the middle one, and holds for those, too, whose motion tells nothing.
  std::vector<double> clocks(const std::vector<File>& floors, const std::vector<File>& responses) {
    std::vector<double> found, each;
    std::vector<std::string> together, mirrored, unsure, too_short;
    std::vector<measurement::Timing> as_given(lab_.tests.size()),
        turned(lab_.tests.size());  // turned: or as it is given, the better
    for (std::size_t i = 0; i < lab_.tests.size(); ++i) {
      if (lab_.tests[i].clock_s || !lab_.tests[i].slip) continue;
      const TestOfLab test = on_one_clock(lab_.tests[i], floors[i], responses[i], 0);
      as_given[i] = timing_of(lab_.tests[i], responses[i], test, true);
      turned[i] = timing_of(lab_.tests[i], responses[i], test, false);
    }
    // One that is mirrored beyond doubt tells of the others, too, unless one goes better as it is.
    const auto sure = [&](std::size_t i) { return turned[i].gain > surely_mirrored * as_given[i].gain; };
    bool one_sure = false, none_as_given = true;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      one_sure |= sure(i);
      none_as_given &= turned[i].mirrored || !turned[i].judged();
    }
    for (std::size_t i = 0; i < lab_.tests.size(); ++i) {
      const LabTest& lab = lab_.tests[i];
      each.push_back(lab.clock_s.value_or(0));
      if (lab.clock_s || !lab.slip) continue;
      const measurement::Timing& timing = as_given[i];
      if (sure(i) || (one_sure && none_as_given && turned[i].mirrored)) {
        mirrored.push_back(lab.id);
        continue;
      }
      if (!timing.wrong()) {
        if (lab.floor.path != lab.response.path) (timing.judged() ? together : too_short).push_back(lab.id);
        continue;
      }
      if (!timing.known()) {
        unsure.push_back(lab.id);
        continue;
      }
      each.back() = std::round(1e4 * timing.late * step_of(floors[i], responses[i])) / 1e4;
      found.push_back(each.back());
    }
    for (const LabTest& lab : lab_.tests)
      if (!lab.slip && !lab.clock_s && lab.floor.path != lab.response.path)
        say(fmt::format(
            "{}: the clocks of floor and response are taken as one: slips show their offset, and none was measured "
            "(clock_s of a test says what it is)",
            lab.id));
    if (!mirrored.empty())
      say(fmt::format(
          "{}: the slip looks mirrored, and no clock was set by it: with the other sign (sign: of its column) it goes "
          "with the floor far better at some time than as it is at any, up to {} s either way",
          fmt::join(mirrored, ", "), longest_offset_s));
    std::sort(found.begin(), found.end());
    const bool one_clock = found.size() > 1 && found.back() - found.front() <= 2 * longest_step(floors, responses);
    if (!together.empty() && !one_clock)  // else it is told of all tests below
      say(fmt::format(
          "{}: no offset between the clocks of floor and response is seen by the slips, which are looked through up "
          "to {} s either way: they are taken as one (clock_s of a test says otherwise)",
          fmt::join(together, ", "), longest_offset_s));
    if (!too_short.empty() && !one_clock)
      say(
          fmt::format("{}: slips are too few or too short to tell whether the clocks of floor and response differ: "
                      "they are taken as one (give clock_s of the test, by how much the response is stamped late)",
                      fmt::join(too_short, ", ")));
    if (!unsure.empty() && !one_clock)
      say(fmt::format(
          "{}: the slips say that the clocks of floor and response differ, and not by how much: several offsets suit "
          "them, or more than the {} s that are looked through. They are taken as one: give clock_s of the test, by "
          "how much the response is stamped late",
          fmt::join(unsure, ", "), longest_offset_s));
    if (found.empty()) return each;
    const double middle = 0.5 * (found[(found.size() - 1) / 2] + found[found.size() / 2]);
    for (std::size_t i = 0; i < each.size(); ++i) {
      if (lab_.tests[i].clock_s || !lab_.tests[i].slip) continue;
      if (one_clock) each[i] = middle;
      if (!one_clock && each[i] != 0) say(clock_sentence(lab_.tests[i].id, each[i]));
    }
    if (one_clock) say(clock_sentence("all tests", middle));
    return each;
  }

  static std::string clock_sentence(const std::string& whose, double clock_s) {
    return fmt::format(
        "{}: the response is stamped {:.4g} s {} against the floor by what slips show, and was shifted by that "
        "(clock_s of a test says what it is, 0 too)",
        whose, std::abs(clock_s), clock_s > 0 ? "late" : "early");
  }

  // The finer one of the two files.
  double step_of(const File& floor, const File& response) const {
    return lab_.sampling_dt_s > 0 ? lab_.sampling_dt_s : std::min(floor.step_s, response.step_s);
  }
  double longest_step(const std::vector<File>& floors, const std::vector<File>& responses) const {
    double longest = 0;
    for (std::size_t i = 0; i < floors.size(); ++i) longest = std::max(longest, step_of(floors[i], responses[i]));
    return longest;
  }

  // So near to it that all readings stand on the grid.
  static bool is_whole(double ratio, std::size_t readings) {
    return std::abs(ratio - std::round(ratio)) * static_cast<double>(readings) < 0.05;
  }
  // That of a reading of the response, where these stand on the grid; else as early as both run.
  static double first_instant(const File& floor, const Series& times, double steps_a_reading) {
    const double both = std::max(floor.time.front(), times.front());
    if (!is_whole(steps_a_reading, times.size())) return both;
    const auto first = std::ranges::find_if(times, [&](double time) { return time >= both; });
    return first == times.end() ? both : *first;
  }

  TestOfLab on_one_clock(const LabTest& lab, const File& floor, const File& response, double clock_s) const {
    Series times = response.time;
    for (double& time : times) time -= clock_s;
    const double step_s = step_of(floor, response), start = first_instant(floor, times, response.step_s / step_s);
    const double end = std::min(floor.time.back(), times.back());
    const double steps = std::floor((end - start) / step_s * (1 + 1e-9) + 1e-6);
    if (!(steps >= 10))
      throw Error(
          fmt::format(
              "{}: floor and response have no time in common ({} runs from {:.4g} to {:.4g} s, {} from {:.4g} to "
              "{:.4g} s{}): {} clock_s, by how much the response is stamped late",
              lab.id, lab.floor.path.string(), floor.time.front(), floor.time.back(), lab.response.path.string(),
              response.time.front(), response.time.back(),
              lab.clock_s ? fmt::format(", less clock_s of {:.4g} s", *lab.clock_s) : "",
              lab.clock_s ? "correct" : "give"),
          Exit::data);
    const auto count = static_cast<std::size_t>(steps) + 1;
    const auto of = [&](const File& file, const Series& time, const std::optional<LabColumn>& column) {
      return column ? at_times(file, time, *column, start, step_s, count) : Series{};
    };
    TestOfLab t;
    t.start_s = start;
    const auto of_floor = [&](const std::optional<LabColumn>& column) {
      return column ? floor_at_times(floor, *column, start, step_s, count) : Series{};
    };
    t.floor = of_floor(lab.acceleration);
    t.vertical = of_floor(lab.vertical);
    t.test.id = lab.id;
    t.test.role = lab.role;
    t.test.dt_s = step_s;
    const double steps_a_reading = std::round(response.step_s / step_s);
    if (is_whole(response.step_s / step_s, times.size()) && steps_a_reading <= measurement::most_steps_a_reading)
      t.test.steps_a_reading = std::max(1, static_cast<int>(steps_a_reading));
    t.test.slip_m = of(response, times, lab.slip);
    t.test.rotation_rad = of(response, times, lab.rotation);
    t.test.block_acceleration_mps2 = of(response, times, lab.block_acceleration);
    measurement::read_floor(t.test, {lab.id, step_s, t.floor});
    return t;
  }

  // Of the samples as they were written: those between them hide half of it.
  static double noise_of(const File& file, const std::optional<LabColumn>& column, double given) {
    return given > 0 || !column ? given : measurement::sensor_noise(channel(file.table, *column));
  }

  measurement::Timing timing_of(const LabTest& lab, const File& response, const TestOfLab& t,
                                bool sign_is_known) const {
    measurement::Dataset set;
    set.noise.slip_m = noise_of(response, lab.slip, lab_.noise.slip_m);
    set.noise.rotation_rad = noise_of(response, lab.rotation, lab_.noise.rotation_rad);
    set.tests = {t.test};
    return slip_timing(measurement::Bench(set, 0), 0, static_cast<int>(longest_offset_s / t.test.dt_s), sign_is_known);
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
