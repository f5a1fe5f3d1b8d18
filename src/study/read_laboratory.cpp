#include "study/read_laboratory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>

#include "base/shown_text.hpp"
#include "base/units.hpp"
#include "motion/record.hpp"
#include "study/read_measurements.hpp"
#include "study/read_parts.hpp"
#include "study/section.hpp"
#include "study/yaml_text.hpp"

namespace freestand::study {
namespace {

using Units = std::map<std::string, double>;
const Units seconds = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60}};
const Units metres = {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}, {"in", inch_m}};
const Units radians = {{"rad", 1}, {"mrad", 1e-3}, {"deg", pi / 180}};

double acceleration_factor(const std::string& unit) { return motion::acceleration_unit_mps2(unit); }

double factor_of(const Units& units, const std::string& unit) {
  const auto found = units.find(unit);
  if (found != units.end()) return found->second;
  std::string known;
  for (const auto& [name, factor] : units) known += (known.empty() ? "" : ", ") + name;
  throw Error(fmt::format("unit {} is not known: choose one of {}", unit, known));
}

using Factor = std::function<double(const std::string&)>;
Factor of(const Units& units) {
  return [&units](const std::string& unit) { return factor_of(units, unit); };
}

bool is_known(const std::string& unit, const Factor& factor) {
  try {
    factor(unit);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::string end_of_name(const std::string& name) {
  const std::string end = name.substr(name.find_last_of("_([ ") + 1);
  return end.substr(0, end.find_last_not_of(")] ") + 1);
}

// "t_ms", "Time (ms)": the unit at the end of a column's name, where it is one of the quantity; else `otherwise`.
std::string unit_of_name(const std::string& name, const Factor& factor, const std::string& otherwise) {
  const std::string end = end_of_name(name);
  return is_known(end, factor) ? end : otherwise;
}

// "slip (inches)", "slip_MM", "slip_ft": meant as a unit, and none of those that are known.
bool ends_with_other_unit(const std::string& name, const Factor& factor) {
  if (name.ends_with(')') || name.ends_with(']')) return true;
  std::string end = end_of_name(name);
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr const char* others[] = {"inch", "inches", "ft", "feet", "foot", "meter", "metre", "meters", "metres"};
  return end != name &&
         (is_known(end, factor) || std::find(std::begin(others), std::end(others), end) != std::end(others));
}

// "name", or {column: name, unit: mm, sign: -1}.
std::optional<LabColumn> read_column(Section& section, const std::string& key, const std::string& unit,
                                     const Factor& factor) {
  const YAML::Node* node = section.find(key);
  if (!node) return {};
  LabColumn column{.name = {}, .unit = unit};
  bool unit_given = false;
  double sign = 1;
  if (node->IsMap()) {
    Section inner(*node, section.name(key), section.line(key), section.problems());
    column.name = inner.text("column", "");
    unit_given = inner.find("unit") != nullptr;
    column.unit = inner.text("unit", unit_of_name(column.name, factor, unit));
    sign = inner.number("sign", 1);
    if (sign != 1 && sign != -1)
      inner.problem("sign", fmt::format("{} is {} (a column is taken as it is, or turned round): give 1 or -1",
                                        inner.name("sign"), sign));
    inner.finish();
  } else if (node->IsScalar()) {
    column.name = node->Scalar();
    column.unit = unit_of_name(column.name, factor, unit);
  }
  column.named_unit = unit_of_name(column.name, factor, "");
  column.assumed = !unit_given && column.named_unit.empty() && !column.name.empty();
  if (column.name.empty())
    section.problem(key, fmt::format("{} names no column: give its name, or {{column: NAME, unit: {}, sign: -1}}",
                                     section.name(key), unit));
  if (column.assumed && ends_with_other_unit(column.name, factor))
    section.problem(key, fmt::format("{}: the name of {} ends with {}, which is no unit that is known: give unit:",
                                     section.name(key), shown(column.name), shown(end_of_name(column.name))));
  try {
    column.factor = sign * factor(column.unit);
  } catch (const Error& error) {
    section.problem(key, section.name(key) + ": " + error.what());
  }
  return column;
}

LabFile read_file(Section& section, const std::filesystem::path& folder) {
  LabFile file;
  const std::string name = section.text("file", "");
  if (name.empty())
    section.problem("file", fmt::format("{} is missing (where the numbers are): add it", section.name("file")));
  file.path = folder / name;
  const auto time = read_column(section, "time", "s", of(seconds));
  if (!time)
    section.problem("time", fmt::format("{} is missing (files have clocks of their own): name the column of the time",
                                        section.name("time")));
  else
    file.time = *time;
  return file;
}

LabTest read_test(Section& section, std::size_t i, const std::filesystem::path& folder) {
  LabTest test;
  test.id = section.text("id", fmt::format("t{:02d}", i + 1));
  if (test.id.empty() || test.id.front() == '.' || test.id.find_first_of("/\\\n") != std::string::npos)
    section.problem("id",
                    fmt::format("{} is {} (the test's file is named so): take one line without / and \\, with no point "
                                "in front",
                                section.name("id"), yaml_text(test.id)));
  test.role = static_cast<measurement::Role>(section.choice("role", {"calibration", "holdout"}, 0));
  test.clock_s = section.optional_number("clock_s");
  for (const bool is_floor : {true, false}) {
    const char* key = is_floor ? "floor" : "response";
    const YAML::Node* node = section.find(key);
    if (!node) {
      section.problem(
          key, fmt::format("{} is missing (what {}): add {}: {{file: ..., time: ..., {}: ...}}", section.name(key),
                           is_floor ? "the floor did" : "the specimen did", key, is_floor ? "acceleration" : "slip"));
      continue;
    }
    Section part(*node, section.name(key), section.line(key), section.problems());
    (is_floor ? test.floor : test.response) = read_file(part, folder);
    if (is_floor) {
      const auto acceleration = read_column(part, "acceleration", "m/s2", acceleration_factor);
      if (!acceleration)
        part.problem("acceleration", fmt::format("{} is missing: name its column", part.name("acceleration")));
      else
        test.acceleration = *acceleration;
      test.vertical = read_column(part, "vertical", "m/s2", acceleration_factor);
    } else {
      test.slip = read_column(part, "slip", "m", of(metres));
      test.rotation = read_column(part, "rotation", "rad", of(radians));
      test.block_acceleration = read_column(part, "block_acceleration", "m/s2", acceleration_factor);
      if (!test.slip && !test.rotation)
        part.problem("slip", fmt::format("{} has neither slip nor rotation (one tells what the specimen did): name a "
                                         "column",
                                         section.name(key)));
    }
    part.finish();
  }
  section.finish();
  return test;
}

}  // namespace

Laboratory read_laboratory(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  Problems problems(path.string());
  Laboratory lab;
  if (const auto root = parse_yaml(text, problems)) {
    Section file(*root, "", 1, problems);
    lab.name = file.text("name", path.stem().string());
    lab.sampling_dt_s = file.optional_number("sampling_dt_s", range::positive).value_or(0);
    lab.specimen = read_dimensions(file, {});
    lab.noise = read_noise(file);
    lab.tolerance = read_tolerance(file);
    const YAML::Node* tests = file.find("tests");
    if (!tests || !tests->IsSequence() || tests->size() == 0) {
      file.problem("tests", "tests is missing or no list: add tests: [{id: ..., floor: {...}, response: {...}}]");
    } else {
      for (std::size_t i = 0; i < tests->size(); ++i) {
        Section test((*tests)[i], fmt::format("tests[{}]", i), line_of((*tests)[i]), problems);
        lab.tests.push_back(read_test(test, i, path.parent_path()));
        for (std::size_t k = 0; k + 1 < lab.tests.size(); ++k)
          if (lab.tests[k].id == lab.tests.back().id)
            test.problem("id", fmt::format("test {} stands twice (an id names one test): rename one", lab.tests[k].id));
      }
    }
    file.finish();
  }
  problems.throw_if_any();
  return lab;
}

}  // namespace freestand::study
