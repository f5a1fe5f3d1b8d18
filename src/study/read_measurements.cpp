#include "study/read_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/folder.hpp"
#include "base/units.hpp"
#include "measurement/data/test_file.hpp"
#include "motion/component.hpp"
#include "motion/pulse.hpp"
#include "motion/record.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using measurement::Dataset;
using measurement::Dimensions;
using measurement::Test;

constexpr const char* format_name = "freestand-measurements/1";
constexpr Range size_range = {.lower = 0, .why = "a size must be above zero"};
constexpr Range tolerance_range = {.lower = 0,
                                   .upper = 0.1,
                                   .lower_open = false,
                                   .why = "it is a standard deviation over what is stated, 0.01 is 1 %"};
constexpr Range clock_range = {
    .lower = 0,
    .upper = 0.05,
    .lower_open = false,
    .why = "it is a standard deviation [s]; clocks that differ by more than three of it are bad data"};
constexpr Range noise_range = {.lower = 0, .why = "errors are told in units of it, so that it must be above zero"};
const std::vector<std::string> peak_keys = {"peak_slip_m",         "residual_slip_m",           "peak_rotation_rad",
                                            "peak_acceleration_g", "block_peak_acceleration_g", "overturned"};

}  // namespace

Dimensions read_dimensions(Section& file, const Dimensions& fallback) {
  Dimensions dimensions = fallback;
  const YAML::Node* node = file.find("specimen");
  if (!node) return dimensions;
  Section section(*node, file.name("specimen"), file.line("specimen"), file.problems());
  if (const auto width = section.optional_number("width_m", size_range)) dimensions.width_m = width;
  if (const auto height = section.optional_number("height_m", size_range)) dimensions.height_m = height;
  if (const auto mass = section.optional_number("mass_kg", size_range)) dimensions.mass_kg = mass;
  if (const auto centre = section.optional_number("centre_height_m", size_range)) dimensions.centre_height_m = centre;
  if (const auto radius = section.optional_number("gyration_radius_m", size_range))
    dimensions.gyration_radius_m = radius;
  if (dimensions.centre_height_m && dimensions.height_m && *dimensions.centre_height_m >= *dimensions.height_m)
    section.problem(
        "centre_height_m",
        fmt::format("{} is {:g}, of a block {:g} m high (the centre of mass lies within the block): correct one",
                    section.name("centre_height_m"), *dimensions.centre_height_m, *dimensions.height_m));
  section.finish();
  return dimensions;
}

measurement::Noise read_noise(Section& file) {
  measurement::Noise noise;
  const YAML::Node* node = file.find("noise");
  if (!node) return noise;
  Section section(*node, "noise", file.line("noise"), file.problems());
  noise.slip_m = section.number("slip_m", 0, noise_range);
  noise.rotation_rad = section.number("rotation_rad", 0, noise_range);
  noise.block_acceleration_mps2 = section.number("block_acceleration_mps2", 0, noise_range);
  noise.floor_acceleration_mps2 = section.number("floor_acceleration_mps2", 0, noise_range);
  section.finish();
  return noise;
}

measurement::Tolerance read_tolerance(Section& file) {
  measurement::Tolerance tolerance;
  const YAML::Node* node = file.find("tolerance");
  if (!node) return tolerance;
  Section section(*node, "tolerance", file.line("tolerance"), file.problems());
  tolerance.width = section.number("width", tolerance.width, tolerance_range);
  tolerance.centre_height = section.number("centre_height", tolerance.centre_height, tolerance_range);
  tolerance.floor_gain = section.number("floor_gain", tolerance.floor_gain, tolerance_range);
  tolerance.clock_s = section.number("clock_s", tolerance.clock_s, clock_range);
  section.finish();
  return tolerance;
}

namespace {

// With a pulse, peak_acceleration_g is the pulse's, whose sign is its direction; the block's own peak has a key of its own.
void read_peaks(Section& section, measurement::Peaks& peaks) {
  peaks.peak_slip_m = section.optional_number("peak_slip_m", range::not_negative);
  peaks.residual_slip_m = section.optional_number("residual_slip_m", range::any);
  peaks.peak_rotation_rad = section.optional_number("peak_rotation_rad", range::not_negative);
  if (!section.has("pulse"))
    peaks.peak_acceleration_g = section.optional_number("peak_acceleration_g", range::not_negative);
  if (const auto own = section.optional_number("block_peak_acceleration_g", range::not_negative)) {
    if (peaks.peak_acceleration_g)
      section.problem(
          "block_peak_acceleration_g",
          fmt::format("{} and peak_acceleration_g are both given (without a pulse they are the same): remove one",
                      section.name("block_peak_acceleration_g")));
    peaks.peak_acceleration_g = own;
  }
  if (section.has("overturned")) peaks.overturned = section.flag("overturned", false);
}

void read_pulse(Section& section, Test& test) {
  const std::string name = section.text("pulse", "");
  test.stretch = section.number("period_s", 1, size_range);
  const auto acceleration = section.optional_number("peak_acceleration_g");
  const auto velocity = section.optional_number("peak_velocity_mps");
  for (const char* key : {"period_s"})
    if (!section.has(key))
      section.problem(key, fmt::format("{} is missing (a pulse has a length): add it", section.name(key)));
  if (!acceleration == !velocity)
    section.problem("pulse", fmt::format("{} needs one amplitude ({}): give peak_acceleration_g or peak_velocity_mps",
                                         section.name("pulse"), acceleration ? "two are given" : "none is given"));
  try {
    const motion::Pulse pulse = motion::find_pulse(name);
    test.pulse = pulse.name;
    test.motion = motion::pulse_motion(pulse);
    test.scale = acceleration ? *acceleration * standard_gravity_mps2
                              : velocity.value_or(0) / (test.stretch * pulse.peak_velocity);
    test.source = fmt::format("pulse {} of {:.3g} s", pulse.name, test.stretch);
  } catch (const Error& error) {
    section.problem("pulse", section.name("pulse") + ": " + error.what());
  }
}

void read_input(Section& section, const Dataset& set, Test& test) {
  int given = 0;
  for (const char* key : {"file", "motion", "pulse"}) given += section.has(key);
  if (given != 1) {
    section.problem("id", fmt::format("{} has {} of file, motion and pulse (one says what the floor did): give one",
                                      section.name("id"), given));
    for (const char* key : {"file", "motion", "pulse"}) section.find(key);
    read_processing(section);
    return;
  }
  const motion::Processing processing = read_processing(section);
  if (!section.has("motion"))
    for (const std::string& key : processing_keys())
      if (section.has(key))
        section.problem(key, fmt::format("{} goes with motion alone (what a file holds was measured together, and a "
                                         "pulse has a period of its own): remove it",
                                         section.name(key)));
  const auto path = [&](const char* key) { return set.file.parent_path() / section.text(key, ""); };
  try {
    if (section.has("pulse")) read_pulse(section, test);
    if (section.has("file")) read_test_file(path("file"), set.sampling_dt_s, test);
    if (section.has("motion")) {
      const auto file = path("motion");
      if (const std::string sign = motion::vertical_sign(file); !sign.empty())
        section.problem("motion", fmt::format("{} is {}, a vertical component ({}): name the horizontal one",
                                              section.name("motion"), file.string(), sign));
      test.motion = motion::processed(motion::read_record(file), processing);
      test.source = file.string();
    }
  } catch (const Error& error) {
    section.problem("id", error.what());
  }
  read_peaks(section, test.peaks);
  const bool any_peak = std::any_of(peak_keys.begin(), peak_keys.end(),
                                    [&](const auto& key) { return section.has(key) && key != "peak_acceleration_g"; });
  if (section.has("file") && (any_peak || test.peaks.peak_acceleration_g))
    section.problem("file", fmt::format("{} and peaks are both given (a history holds its peaks): remove either",
                                        section.name("file")));
  if (!section.has("file") && !any_peak && !test.peaks.peak_acceleration_g)
    section.problem("id", fmt::format("{} says nothing of what came out (there is nothing to compare with): add file, "
                                      "or one of {}",
                                      section.name("id"), joined(peak_keys)));
}

Start read_start(Section& test) {
  Start start;
  const YAML::Node* node = test.find("start");
  if (!node) return start;
  Section section(*node, test.name("start"), test.line("start"), test.problems());
  start.rotation_rad = section.number("rotation_rad", 0, range::leaning);
  start.rotation_rate_radps = section.number("rotation_rate_radps", 0);
  start.slip_m = section.number("slip_m", 0);
  start.slip_velocity_mps = section.number("slip_velocity_mps", 0);
  section.finish();
  return start;
}

Test read_test(const YAML::Node& node, std::size_t i, int line, const Dataset& set, Problems& problems) {
  Section section(node, fmt::format("tests[{}]", i), line, problems);
  Test test;
  test.id = section.text("id", fmt::format("{}", i + 1));
  if (!section.has("role"))
    section.problem("role", fmt::format("{} is missing (which tests may a fit use?): add role: calibration, or holdout",
                                        section.name("role")));
  test.steps_a_reading = static_cast<int>(section.integer("steps_a_reading", 1, 1, measurement::most_steps_a_reading));
  test.role = static_cast<measurement::Role>(section.choice("role", {"calibration", "holdout"}, 0));
  test.specimen = read_dimensions(section, set.specimen);
  test.start = read_start(section);
  if (node.IsMap()) read_input(section, set, test);
  section.finish();
  return test;
}

void read_tests(Section& file, Dataset& set) {
  const YAML::Node* node = file.find("tests");
  if (!node || !node->IsSequence() || node->size() == 0) {
    file.problem("tests", "tests is missing or no list (there is nothing to compare with): add tests: [{id: ...}]");
    return;
  }
  for (std::size_t i = 0; i < node->size(); ++i) {
    const int line = line_of((*node)[i]) ? line_of((*node)[i]) : file.line("tests");
    Test test = read_test((*node)[i], i, line, set, file.problems());
    const bool twice = std::any_of(set.tests.begin(), set.tests.end(), [&](const Test& t) { return t.id == test.id; });
    if (twice)
      file.problems().add(line, fmt::format("test {} stands twice (an id names one test): rename one", test.id));
    const auto same = std::find_if(set.tests.begin(), set.tests.end(), [&](const Test& t) {
      return t.has_history() && test.has_history() && t.slip_m == test.slip_m && t.rotation_rad == test.rotation_rad &&
             t.motion.horizontal_mps2 == test.motion.horizontal_mps2;
    });
    if (same != set.tests.end() && !twice)
      file.problems().add(
          line,
          fmt::format("test {} has the file of test {}, or a copy of it (a test counts once): correct the file of one",
                      test.id, same->id));
    set.tests.push_back(std::move(test));
  }
}

// A number that is there, and wrong, has been told already.
void check_noise(Section& file, const Dataset& set) {
  const YAML::Node* given = file.find("noise");
  const auto any = [&](auto channel) {
    return std::any_of(set.tests.begin(), set.tests.end(), [&](const Test& t) { return !(t.*channel).empty(); });
  };
  const auto needed = [&](bool there, double noise, const char* key) {
    if (there && noise == 0 && !(given && (!given->IsMap() || (*given)[key])))
      file.problem("noise", fmt::format("noise.{} is missing (errors are told in units of the sensor's noise): add its "
                                        "standard deviation",
                                        key));
  };
  needed(any(&Test::slip_m), set.noise.slip_m, "slip_m");
  needed(any(&Test::rotation_rad), set.noise.rotation_rad, "rotation_rad");
}

}  // namespace

Dataset read_measurements(const std::filesystem::path& path) {
  std::ostringstream text;
  text << open_to_read(path, Exit::data).rdbuf();

  Problems problems(path.string());
  Dataset set;
  set.file = path;
  if (const auto root = parse_yaml(text.str(), problems)) {
    Section file(*root, "", 1, problems);
    problems.throw_if_any(Exit::data);
    if (file.text("format", "") != format_name)
      file.problem("format", fmt::format("format is not {} (another kind of file, or another version): see the "
                                         "description of measurements",
                                         format_name));
    set.name = file.text("name", path.parent_path().filename().string());
    set.sampling_dt_s = file.number("sampling_dt_s", 0, range::positive);
    set.specimen = read_dimensions(file, {});
    set.noise = read_noise(file);
    set.tolerance = read_tolerance(file);
    read_tests(file, set);
    check_noise(file, set);
    file.finish();
  }
  problems.throw_if_any(Exit::data);
  return set;
}

}  // namespace freestand::study
