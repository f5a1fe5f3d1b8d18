// Records of a study: a pattern, a folder, a file, or a table of records.
#include <fmt/format.h>

#include "motion/component.hpp"
#include "motion/record.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using Paths = std::vector<std::filesystem::path>;

// Files of a glob, a folder or one file; a problem at the key when there is none.
Paths find_files(Section& section, const std::string& key, const std::string& pattern, const RecordKeys& keys) {
  if (pattern.empty() || keys.look == Files::ignore) return {};
  try {
    return motion::expand_glob(pattern, keys.folder);
  } catch (const Error& error) {
    section.problem(key, section.name(key) + ": " + error.what());
    return {};
  }
}

// A folder holds more than records: what is none is left out, and told. Where a format is named, nothing is judged.
void leave_out_others(Section& section, const std::string& key, const std::string& pattern,
                      const std::filesystem::path& folder, MotionSource& source, Paths& files) {
  if (!source.format.empty() || !motion::names_whole_folder(pattern, folder)) return;
  const std::size_t found = files.size();
  std::vector<std::string> others;
  std::erase_if(files, [&](const std::filesystem::path& file) {
    const std::string why =
        motion::is_record_table(file) ? "a table of records: name it itself" : motion::why_no_record(file);
    if (!why.empty()) others.push_back(fmt::format("{} ({})", file.filename().string(), why));
    return !why.empty();
  });
  if (found > 0 && files.empty())
    section.problem(key, fmt::format("{}: {} holds no record ({}): name the folder of the records, or their format",
                                     section.name(key), pattern, some(others)));
  source.no_records.insert(source.no_records.end(), others.begin(), others.end());
}

// Vertical components that a pattern matched are left out; one that is named itself is a problem.
void leave_out_vertical(Section& section, const std::string& key, MotionSource& source, Paths& files) {
  std::string named;
  std::erase_if(files, [&](const std::filesystem::path& file) {
    const std::string sign = motion::vertical_sign(file);
    if (sign.empty()) return false;
    source.left_out.push_back(fmt::format("{} ({})", file.filename().string(), sign));
    if (source.records.ends_with(file.filename().string())) named = file.string();
    return true;
  });
  if (source.left_out.empty() || !(files.empty() || !named.empty())) return;
  section.problem(key,
                  fmt::format("{}: {} {} (it would shake the floor sideways): give a horizontal component here, and "
                              "this one as {}, with the effect vertical_shaking",
                              section.name(key), joined(source.left_out),
                              source.left_out.size() == 1 ? "is a vertical component" : "are vertical components",
                              key == "file" ? "vertical_file" : "vertical_records"));
}

// Partners in the order of names: vertical components, or the other horizontal ones. Empty where there are none, or others than
// records.
Paths read_partners(Section& section, const std::string& key, const std::string& pattern, const RecordKeys& keys,
                    MotionSource& source, const Paths& files) {
  Paths partners = find_files(section, key, pattern, keys);
  leave_out_others(section, key, pattern, keys.folder, source, partners);
  if (partners.empty() || partners.size() == files.size()) return partners;
  section.problem(key,
                  fmt::format("{} matches {} files but {} matches {} (they are paired in the order of their names): {}",
                              section.name(key), partners.size(), keys.key, files.size(),
                              "make the two patterns match the same records"));
  return {};
}

// What is taken as the other horizontal component must not be a vertical one.
void refuse_vertical(Section& section, const std::string& key, const Paths& cross) {
  for (const std::filesystem::path& file : cross)
    if (const std::string sign = motion::vertical_sign(file); !sign.empty())
      section.problem(key, fmt::format("{}: {} ({}) is a vertical component: give the other horizontal one here",
                                       section.name(key), file.filename().string(), sign));
}

// By a pattern: files in the order of their names, and vertical components likewise.
void read_pattern(Section& section, MotionSource& source, const RecordKeys& keys) {
  Paths files = find_files(section, keys.key, source.records, keys);
  leave_out_others(section, keys.key, source.records, keys.folder, source, files);
  leave_out_vertical(section, keys.key, source, files);
  const Paths vertical = read_partners(section, keys.vertical_key, source.vertical_records, keys, source, files);
  const Paths cross = read_partners(section, keys.cross_key, source.cross_records, keys, source, files);
  refuse_vertical(section, keys.cross_key, cross);
  for (std::size_t i = 0; i < files.size(); ++i) {
    motion::RecordRow row;
    row.file = files[i];
    if (!vertical.empty()) row.vertical = vertical[i];
    if (!cross.empty()) row.cross = cross[i];
    row.group = source.group;
    source.files.push_back(std::move(row));
  }
}

// By a table; a group that is none of its columns names all its records.
void read_table(Section& section, MotionSource& source, const RecordKeys& keys) {
  if (!source.vertical_records.empty())
    section.problem(keys.vertical_key,
                    fmt::format("{} does not go with a table of records (it names them itself): give "
                                "the table a column vertical",
                                section.name(keys.vertical_key)));
  if (!source.cross_records.empty())
    section.problem(
        keys.cross_key,
        fmt::format("{} does not go with a table of records (it names them itself): give the table a column "
                    "cross, or rotate_deg, by which rows of one station are a pair",
                    section.name(keys.cross_key)));
  try {
    motion::RecordTable table = motion::read_record_table(keys.folder / source.records, source.group, keys.vertical);
    if (source.turn) pair_rows(section, *source.turn, table);
    source.files = std::move(table.rows);
    source.numbers = std::move(table.numbers);
    source.left_out = std::move(table.left_out);
    source.ungrouped = std::move(table.grouping_columns);
  } catch (const Error& error) {
    section.problem(keys.key, section.name(keys.key) + ": " + error.what());
  }
}

}  // namespace

void read_amplitude(Section& section, MotionSource& source) {
  const std::optional<Quantity> target = read_scale_to(section, source);
  const Quantity factor = section.quantity("motion", "scale", range::any, 1);
  source.amplitude = target ? *target : factor;
}

void read_records(Section& section, MotionSource& source, const RecordKeys& keys) {
  source.records = section.text(keys.key, "");
  source.vertical_records = section.text(keys.vertical_key, "");
  source.dt_s = section.optional_number("dt_s", {.lower = 0, .why = "a time step must be above zero"});
  source.unit = section.text("unit", "");
  source.format = section.text("format", "");
  source.channel = section.text("channel", "");
  source.group = section.text("group", "");
  source.processing = read_processing(section);
  source.pulse = read_known_pulse(section);
  source.cross_records = section.text(keys.cross_key, "");
  source.turn = read_turn(section);
  source.begin_together = section.flag("begin_together", false);
  read_amplitude(section, source);
  const bool table = keys.look == Files::look && motion::is_record_table(keys.folder / source.records);
  if (keys.look == Files::look && !table) check_turn(section, source, keys);
  if (table)
    read_table(section, source, keys);
  else
    read_pattern(section, source, keys);
  if (source.unit.empty()) return;
  try {
    motion::acceleration_unit_mps2(source.unit);
  } catch (const Error& error) {
    section.problem("unit", section.name("unit") + ": " + error.what());
  }
}

}  // namespace freestand::study
