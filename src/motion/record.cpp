#include "motion/record.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"
#include "base/units.hpp"
#include "motion/component.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion {
namespace {

// Beyond these a response of a minute is lost in the rounding of time, or takes the record's whole length to begin.
constexpr double shortest_step_s = 1e-6, longest_step_s = 10;

std::string format_names() {
  std::string names;
  for (const RecordFormat& format : registry<RecordFormat>()) names += (names.empty() ? "" : ", ") + format.name;
  return names;
}

const RecordFormat& choose_format(const RecordText& text, const std::string& wanted) {
  for (const RecordFormat& format : registry<RecordFormat>())
    if (wanted.empty() ? format.recognises(text) : format.name == wanted) return format;
  if (!wanted.empty())
    throw Error(fmt::format("no record format \"{}\" (the formats are {}): name one of these", wanted, format_names()));
  text.fail(0, fmt::format("no known record format (the formats are {}): convert the record to one of these, for "
                           "example to csv with the "
                           "columns time_s and floor_acceleration_mps2; a table of records has a column named file",
                           format_names()));
}

double choose_step(const RecordText& text, const RawRecord& raw, const ReadOptions& options) {
  if (!raw.dt_s && !options.dt_s)
    throw Error(
        fmt::format("{}: the time step is not known (the file does not say it): give dt_s", text.path().string()));
  if (raw.dt_s && options.dt_s && std::abs(*raw.dt_s - *options.dt_s) > 1e-6 * *raw.dt_s)
    throw Error(fmt::format("{}: dt_s {} contradicts the file (it says {}): leave dt_s out", text.path().string(),
                            *options.dt_s, *raw.dt_s));
  const double dt = raw.dt_s ? *raw.dt_s : *options.dt_s;
  if (!(dt > 0) || !std::isfinite(dt))
    text.fail(fmt::format("the time step {} s is of no use (not a positive number): correct it", dt));
  if (dt < shortest_step_s || dt > longest_step_s)
    text.fail(fmt::format(
        "the time step is {:.3g} s (no instrument samples a floor faster than {:g} s or slower than {:g} s): "
        "is its time in seconds?",
        dt, shortest_step_s, longest_step_s));
  return dt;
}

// The unit that the file itself names.
double stated_unit(const RecordText& text, const std::string& unit) {
  try {
    return acceleration_unit_mps2(unit);
  } catch (const Error& error) {
    text.fail(error.what());
  }
}

double choose_unit(const RecordText& text, const RawRecord& raw, const ReadOptions& options) {
  if (raw.unit.empty() && options.unit.empty() && !raw.usual_unit.empty()) return stated_unit(text, raw.usual_unit);
  if (raw.unit.empty() && options.unit.empty())
    throw Error(
        fmt::format("{}: the unit of acceleration is not known (the file does not say it): give unit, "
                    "\"g\" or \"m/s2\"",
                    text.path().string()));
  // A word that is no unit, where the user names one, is none of the file's.
  if (raw.unit.empty() || (!options.unit.empty() && !is_acceleration_unit(raw.unit)))
    return acceleration_unit_mps2(options.unit);
  const double stated = stated_unit(text, raw.unit);
  if (!options.unit.empty() && acceleration_unit_mps2(options.unit) != stated)
    throw Error(fmt::format("{}: unit {} contradicts the file (it says {}): leave unit out", text.path().string(),
                            options.unit, raw.unit));
  return stated;
}

const RawChannel& named_channel(const RecordText& text, const RawRecord& raw, const std::string& wanted) {
  std::string names;
  for (std::size_t i = 0; i < raw.channels.size(); ++i) {
    const std::string& name = raw.channels[i].name;
    if (std::to_string(i + 1) == wanted || (!name.empty() && lower_case(name) == lower_case(wanted)))
      return raw.channels[i];
    names += fmt::format("{}{} {}", i ? ", " : "", i + 1, shown(name));
  }
  throw Error(fmt::format("{}: no channel \"{}\" (the channels are {}): name one of these", text.path().string(),
                          shown(wanted), names));
}

const RawChannel& choose_channel(const RecordText& text, const RawRecord& raw, const ReadOptions& options) {
  const bool vertical = options.component == Component::vertical;
  const auto first = std::find_if(raw.channels.begin(), raw.channels.end(),
                                  [&](const RawChannel& channel) { return channel.vertical == vertical; });
  const RawChannel& chosen = !options.channel.empty()      ? named_channel(text, raw, options.channel)
                             : first == raw.channels.end() ? raw.channels.front()
                                                           : *first;
  if (options.component == Component::horizontal && chosen.vertical)
    text.fail(
        fmt::format("channel {} is vertical, and a horizontal one is needed (the floor would shake sideways with "
                    "it): give the file as the vertical record, or name another channel",
                    chosen.name));
  return chosen;
}

std::vector<double> in_mps2(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

struct Samples {
  double dt_s;
  std::vector<double> horizontal, vertical;
  std::string start = {};
};

// The shorter one ends at rest.
void as_long(Samples& samples) {
  const std::size_t size = std::max(samples.horizontal.size(), samples.vertical.size());
  samples.horizontal.resize(size, 0.0);
  samples.vertical.resize(size, 0.0);
}

Samples read_samples(const std::filesystem::path& path, const ReadOptions& options) {
  const RecordText text(path);
  const RawRecord raw = choose_format(text, options.format).read(text);
  const RawChannel& chosen = choose_channel(text, raw, options);
  if (chosen.values.size() < 2) text.fail("fewer than two samples (no motion): get the whole file");
  const double unit = choose_unit(text, raw, options);
  Samples samples{choose_step(text, raw, options), in_mps2(chosen.values, unit), {}, raw.start};
  // Channels that are called vertical are turned over where they are read (record_channels.hpp).
  if (options.component == Component::vertical && !chosen.vertical && points_down(path))
    for (double& value : samples.horizontal) value = -value;
  for (const RawChannel& channel : raw.channels)
    if (channel.vertical && &channel != &chosen && samples.vertical.empty())
      samples.vertical = in_mps2(channel.values, unit);
  if (!samples.vertical.empty()) as_long(samples);
  return samples;
}

[[noreturn]] void refuse_pair(const std::filesystem::path& path, const std::string& other_file, const std::string& why,
                              const char* cure) {
  throw Error(fmt::format("{} and {} are no pair of components ({}): {}", path.string(), other_file, why, cure),
              Exit::data);
}

// Components that do not begin together make a motion that never was.
void check_pair(const std::filesystem::path& path, const Samples& one, const ReadOptions& options,
                const std::string& other_file, const Samples& other) {
  if (std::abs(other.dt_s - one.dt_s) > 1e-6 * one.dt_s)
    refuse_pair(path, other_file, fmt::format("their steps are {} s and {} s", one.dt_s, other.dt_s),
                "resample one of them");
  if (one.start != other.start && !(options.begin_together && (one.start.empty() || other.start.empty())))
    refuse_pair(path, other_file,
                fmt::format("they begin at {} and at {}", one.start.empty() ? "an unknown time" : shown(one.start),
                            other.start.empty() ? "an unknown time" : shown(other.start)),
                "cut the earlier one");
}

void add_vertical(const std::filesystem::path& path, Samples& samples, const ReadOptions& options) {
  ReadOptions own = options;
  own.vertical_file.clear();
  own.channel.clear();
  own.component = Component::vertical;
  Samples vertical = read_samples(options.vertical_file, own);
  check_pair(path, samples, options, options.vertical_file, vertical);
  samples.vertical = std::move(vertical.horizontal);
  as_long(samples);
}

// Cosine of an angle in degrees, exact at right angles.
double cosine(double angle_deg) {
  const double turn = std::abs(std::remainder(angle_deg, 360.0));
  return turn == 90 ? 0 : turn == 180 ? -1 : std::cos(turn * (pi / 180));
}

// Of a file that holds both components: number of the horizontal channel that the options do not choose.
std::string other_channel(const std::filesystem::path& path, const ReadOptions& options) {
  const RecordText text(path);
  const RawRecord raw = choose_format(text, options.format).read(text);
  const RawChannel& chosen = choose_channel(text, raw, options);
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < raw.channels.size(); ++i)
    if (!raw.channels[i].vertical && &raw.channels[i] != &chosen) others.push_back(i + 1);
  if (others.size() != 1)
    text.fail(
        fmt::format("named as both components of a pair (beside the channel taken it holds {} horizontal channels, and "
                    "one is needed): name the file of the other component",
                    others.empty() ? "no" : std::to_string(others.size())));
  return std::to_string(others.front());
}

// The other horizontal component.
std::vector<double> read_cross(const std::filesystem::path& path, const Samples& samples, const ReadOptions& options) {
  ReadOptions own = options;
  own.cross_file.clear();
  own.vertical_file.clear();
  own.component = Component::horizontal;
  std::error_code ignored;
  if (std::filesystem::equivalent(path, options.cross_file, ignored)) own.channel = other_channel(path, own);
  Samples other = read_samples(options.cross_file, own);
  check_pair(path, samples, options, options.cross_file, other);
  if (other.horizontal == samples.horizontal)
    refuse_pair(path, options.cross_file, "they hold the same motion", "name the other component");
  if (samples.start.empty() && !options.begin_together && samples.horizontal.size() != other.horizontal.size())
    refuse_pair(path, options.cross_file,
                fmt::format("they have {} and {} samples, and nothing tells whether they begin together",
                            samples.horizontal.size(), other.horizontal.size()),
                "cut both to the same instants, or say that they do (begin_together)");
  return std::move(other.horizontal);
}

void turn(Samples& samples, std::vector<double> cross, double angle_deg) {
  const std::size_t size = std::max({samples.horizontal.size(), cross.size(), samples.vertical.size()});
  samples.horizontal.resize(size, 0.0);
  cross.resize(size, 0.0);
  if (!samples.vertical.empty()) samples.vertical.resize(size, 0.0);
  const double along = cosine(angle_deg), across = cosine(angle_deg - 90);
  for (std::size_t i = 0; i < size; ++i) samples.horizontal[i] = along * samples.horizontal[i] + across * cross[i];
}

}  // namespace

Direction direction_of(const std::filesystem::path& path, const ReadOptions& options) {
  const RecordText text(path);
  const RawRecord raw = choose_format(text, options.format).read(text);
  // A channel that is called vertical was turned over as it was read.
  if (const RawChannel& chosen = choose_channel(text, raw, options); chosen.vertical)
    return {.vertical = fmt::format("channel {} is", chosen.name)};
  if (raw.channels.size() > 1) return {};
  return {.vertical = vertical_sign(path), .down = points_down(path)};
}

FloorMotion read_record(const std::filesystem::path& path, const ReadOptions& options) {
  Samples samples = read_samples(path, options);
  std::vector<double> cross;
  if (!options.cross_file.empty()) cross = read_cross(path, samples, options);
  if (!cross.empty() && !options.keep_cross) {
    turn(samples, std::move(cross), options.rotate_deg);
    cross.clear();
  }
  if (!options.vertical_file.empty()) add_vertical(path, samples, options);
  if (cross.empty()) return piecewise_linear(path.string(), samples.dt_s, samples.horizontal, samples.vertical);
  const std::size_t size = std::max(samples.horizontal.size(), cross.size());
  samples.horizontal.resize(size, 0.0);
  cross.resize(size, 0.0);
  if (!samples.vertical.empty()) samples.vertical.resize(size, 0.0);
  FloorMotion motion = piecewise_linear(path.string(), samples.dt_s, samples.horizontal, samples.vertical);
  add_cross(motion, samples.dt_s, cross);
  return motion;
}

std::vector<FormatInfo> record_formats() {
  std::vector<FormatInfo> formats;
  for (const RecordFormat& format : registry<RecordFormat>()) formats.push_back({format.name, format.summary});
  return formats;
}

bool names_whole_folder(const std::string& pattern, const std::filesystem::path& base) {
  std::error_code ignored;
  return std::filesystem::path(pattern).filename() == "*" || std::filesystem::is_directory(base / pattern, ignored);
}

std::string why_no_record(const std::filesystem::path& path) {
  try {
    const RecordText head(path, head_bytes);
    for (const RecordFormat& format : registry<RecordFormat>())
      if (format.recognises(head)) return "";
    return "no record format";
  } catch (const Error& error) {
    const std::string why = error.what(), name = path.string() + ": ";
    return why.starts_with(name) ? why.substr(name.size(), why.find(" (") - name.size()) : "it cannot be read";
  }
}

bool is_acceleration_unit(const std::string& unit) {
  try {
    return acceleration_unit_mps2(unit) > 0;
  } catch (const Error&) {
    return false;
  }
}

double acceleration_unit_mps2(const std::string& unit) {
  std::string name;
  for (const char c : lower_case(unit))
    if (c != '^' && c != '*' && c != ' ') name += c;
  for (const char* square : {"/sec/sec", "/s/s", "/sec2", "/s\u00b2", "/sec\u00b2"})
    if (name.ends_with(square)) name = name.substr(0, name.find('/')) + "/s2";
  if (name == "g") return standard_gravity_mps2;
  if (name == "m/s2" || name == "mps2") return 1;
  if (name == "cm/s2" || name == "gal" || name == "gals") return 0.01;
  if (name == "mm/s2") return 0.001;
  if (name == "in/s2") return inch_m;
  if (name == "ft/s2") return 12 * inch_m;
  throw Error(
      fmt::format("no unit of acceleration \"{}\" (the units are g, m/s2, cm/s2 or gal, mm/s2, in/s2, ft/s2): name "
                  "one of these",
                  shown(unit)));
}

std::vector<std::filesystem::path> expand_glob(const std::string& pattern, const std::filesystem::path& base) {
  std::filesystem::path full = base / pattern;  // an absolute pattern stays as it is
  std::error_code ignored;
  if (std::filesystem::is_directory(full, ignored)) full /= "*";
  glob_t found{};
  std::vector<std::filesystem::path> files;
  if (glob(full.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i)
      if (std::filesystem::is_regular_file(found.gl_pathv[i], ignored)) files.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  if (files.empty())
    throw Error(
        fmt::format("no file matches \"{}\" (looked for {}): correct the pattern; a relative one starts at the "
                    "study's folder",
                    pattern, full.string()));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace freestand::motion
