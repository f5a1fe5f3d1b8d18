#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "app/checks.hpp"
#include "app/command.hpp"
#include "app/floors.hpp"
#include "app/synthetic_motions.hpp"
#include "base/folder.hpp"
#include "io/output_folder.hpp"
#include "motion/component.hpp"
#include "motion/processing.hpp"
#include "motion/record.hpp"
#include "motion/record_figures.hpp"
#include "study/read_building.hpp"

namespace freestand::app {
namespace {

struct MotionOptions {
  std::vector<std::string> files;
  std::string unit, channel, convert, floor, csv, cross, baseline;
  SyntheticOptions synthetic;
  std::vector<double> band_hz;
  int storey = -1;
  double dt_s = 0;
  std::optional<double> rotate_deg, time_scale, length_scale;
  bool overwrite = false, begin_together = false;
};

// The building under which the record is, if any.
std::optional<study::BuildingPart> building_of(const MotionOptions& options) {
  if (options.storey >= 0 && options.floor.empty())
    throw Error(fmt::format("--storey {} is of no building (the record is taken as it is): add --floor building.yaml",
                            options.storey));
  std::optional<study::BuildingPart> building;
  if (!options.floor.empty()) building = study::read_building_file(options.floor);
  if (building && options.storey > building->floors())
    throw Error(
        fmt::format("--storey {} is none of {} (it has {} floors above the ground, which is 0): name one of these",
                    options.storey, building->name, building->floors()));
  if (building && options.storey < 0 && !options.convert.empty())
    throw Error(fmt::format(
        "--convert writes the motion of one floor (of {}, which has {}, and of the ground, 0): add --storey {}",
        building->name, building->floors(), building->floors()));
  return building;
}

motion::ReadOptions read_options(const MotionOptions& options) {
  if (options.rotate_deg.has_value() == options.cross.empty())
    throw Error("--rotate and --cross go together (a pair of components is turned): give both, or neither");
  if (!options.cross.empty() && options.files.size() != 1)
    throw Error("--cross takes one record (there are " + std::to_string(options.files.size()) +
                "): turn the pairs one by one");
  motion::ReadOptions read;
  if (options.dt_s > 0) read.dt_s = options.dt_s;
  read.unit = options.unit;
  read.channel = options.channel;
  read.cross_file = options.cross;
  read.rotate_deg = options.rotate_deg.value_or(0);
  read.begin_together = options.begin_together;
  return read;
}

motion::Processing processing(const MotionOptions& options) {
  motion::Processing wanted;
  if (!options.baseline.empty())
    wanted.baseline = options.baseline == "linear" ? motion::Baseline::linear : motion::Baseline::quadratic;
  if (!options.band_hz.empty()) {
    wanted.band = motion::BandPass{options.band_hz.at(0), options.band_hz.at(1)};
    if (!(wanted.band->low_hz > 0 && wanted.band->low_hz < wanted.band->high_hz))
      throw Error("--band-pass is no band (two frequencies above zero, the lower first): give --band-pass 0.1 25");
  }
  if (options.time_scale || options.length_scale)
    wanted.scale = motion::similitude(options.time_scale, options.length_scale);
  return wanted;
}

std::string first_column(const std::filesystem::path& file) {
  std::ifstream text(file);
  std::string line;
  std::getline(text, line);
  return line.substr(0, line.find(','));
}

// Replaced is only what begins as what is written in its place, and is none of the records that are read.
void check_target(const std::filesystem::path& target, const std::string& column, const MotionOptions& options) {
  if (target.empty() || !is_there(target)) return;
  if (!is_file(target))
    throw Error(target.string() + " is no plain file (it would be replaced by one): give the name of a file");
  if (!options.overwrite)
    throw Error(target.string() + " exists already (it would be lost): choose another name, or give --overwrite");
  std::vector<std::string> read = options.files;
  for (const std::string& other : {options.cross, options.floor, options.synthetic.file}) read.push_back(other);
  std::error_code ignored;
  for (const std::string& file : read)
    if (std::filesystem::equivalent(file, target, ignored))
      throw Error(target.string() + " is what is read (it would be lost): choose another name");
  if (first_column(target) != column)
    throw Error(
        fmt::format("{} is not what this command writes (its first column is not {}; it would be lost): choose another "
                    "name, or remove it",
                    target.string(), column));
}
void check_targets(const std::string& convert, const MotionOptions& options) {
  check_target(convert, "time_s", options);
  check_target(options.csv, "file", options);
}

// Names of those options that were given.
std::string given(const CLI::App& verb, const std::vector<std::string>& names) {
  std::string found;
  for (const std::string& name : names)
    if (verb.count(name) > 0) found += (found.empty() ? "" : ", ") + name;
  return found;
}

// Motions of a set, which are made and not read.
void show_set(const MotionOptions& options, const CLI::App& verb) {
  if (!options.files.empty() || !options.floor.empty())
    throw Error("--synthetic takes no records and no building (its motions are made): write them with --convert first");
  if (const std::string other =
          given(verb, {"--dt", "--unit", "--channel", "--storey", "--cross", "--rotate", "--begin-together",
                       "--baseline", "--band-pass", "--time-scale", "--length-scale"});
      !other.empty())
    throw Error(
        fmt::format("{} goes with records, not with --synthetic (its motions are made as they are wanted): "
                    "leave it out, or write the motions with --convert and treat those",
                    other));
  check_targets(options.synthetic.number >= 0 ? options.convert : "", options);
  SyntheticOptions wanted = options.synthetic;
  wanted.convert = options.convert;
  wanted.csv = options.csv;
  show_synthetic(wanted);
}

void show(const MotionOptions& options, const CLI::App& verb) {
  if (!options.synthetic.file.empty()) return show_set(options, verb);
  if (const std::string other = given(verb, {"--seed", "--number"}); !other.empty())
    throw Error(fmt::format("{} is of --synthetic (records are read, not drawn): leave it out, or add --synthetic FILE",
                            other));
  if (options.storey >= 0 && !options.floor.empty() && options.convert.empty())
    throw Error(
        fmt::format("--storey {} says which floor --convert writes (all floors are told without it): add "
                    "--convert FILE, or leave it out",
                    options.storey));
  if (const std::string treated =
          given(verb, {"--cross", "--rotate", "--baseline", "--band-pass", "--time-scale", "--length-scale"});
      !options.csv.empty() && !treated.empty())
    throw Error(
        fmt::format("--csv is a table of records as they are in their files, and {} changes them (what read the "
                    "table would take the figures of one for the samples of the other): write the treated "
                    "record with --convert first, and make the table of that",
                    treated));
  if (options.files.empty())
    throw Error("motion names no record (nothing is there to be told): name one, or --synthetic FILE");
  if (!options.convert.empty() && options.files.size() != 1)
    throw Error("--convert takes one record (there are " + std::to_string(options.files.size()) +
                "): convert them one by one");
  check_targets(options.convert, options);
  const std::optional<study::BuildingPart> building = building_of(options);
  if (building && (building->drawn_period || building->drawn_damping))
    fmt::print("{} at the median of what is a distribution of it: period {:.4g} s, damping {:.4g}\n", building->name,
               building->period_s.value_or(motion::modes(*building).front().period_s()), building->damping);
  const motion::ReadOptions read = read_options(options);
  const motion::Processing wanted = processing(options);
  std::vector<motion::ToldRecord> told;
  for (const std::string& file : options.files) {
    FloorMotion motion = motion::processed(motion::read_record(file, read), wanted);
    told.push_back({file, options.unit, options.channel, motion::record_figures(motion)});
    const motion::Direction direction = motion::direction_of(file, read);
    fmt::print("{}\n{}", file, motion::figures_text(told.back().figures, !direction.vertical.empty()));
    if (!direction.vertical.empty()) fmt::print("  a vertical component: {}\n", direction.vertical);
    if (direction.down && !options.convert.empty()) {
      for (double& value : motion.horizontal_mps2) value = -value;
      fmt::print("  positive downwards in the file, and upwards in {}\n", options.convert);
    }
    std::optional<Floors> floors;
    if (building) fmt::print("{}", floors.emplace(motion, *building).text());
    if (!options.convert.empty())
      io::write_text(options.convert, motion::floor_csv(floors ? floors->motion_of(options.storey) : motion));
  }
  const std::filesystem::path csv = options.csv;
  if (!csv.empty()) io::write_text(csv, motion::figures_csv(told, csv.has_parent_path() ? csv.parent_path() : "."));
}

void add_processing(CLI::App& verb, MotionOptions& options) {
  verb.add_option("--cross", options.cross, "the other horizontal component of one record, which begins with it");
  verb.add_option("--rotate", options.rotate_deg, "turn the pair by so many degrees from the record towards --cross");
  verb.add_flag("--begin-together", options.begin_together, "the two begin together, though they end at other times");
  verb.add_option("--baseline", options.baseline, "take this off the velocity: linear or quadratic")
      ->check(CLI::IsMember({"linear", "quadratic"}));
  verb.add_option("--band-pass", options.band_hz, "corners in Hz, as 0.1 25; Butterworth, without shift of phase")
      ->expected(2);
  verb.add_option("--time-scale", options.time_scale, "of a model: times go with it")
      ->check(within(0.01, 100, "scale of times"));
  verb.add_option("--length-scale", options.length_scale,
                  "of a model: lengths go with it; by itself times with its root")
      ->check(within(1e-4, 1e4, "scale of lengths"));
}

}  // namespace

void add_motion(CLI::App& parser, Work& work) {
  auto options = std::make_shared<MotionOptions>();
  CLI::App* verb = parser.add_subcommand(
      "motion", "what is in a record: step, peaks, Arias intensity, durations, spectrum, identified pulse");
  verb->add_option("files", options->files, "records");
  verb->add_option("--dt", options->dt_s, "time step in s, for plain columns")->check(above_zero("time step"));
  verb->add_option("--unit", options->unit, "unit of plain columns: g, m/s2, cm/s2 ...");
  verb->add_option("--channel", options->channel, "channel of files that hold several");
  verb->add_option("--csv", options->csv, "write all of it to this file, one row a record: a table of records");
  verb->add_option("--convert", options->convert, "write the record as floor motion csv to this file");
  verb->add_option("--floor", options->floor,
                   "building.yaml: the record is of the ground; tells what each floor of it does");
  verb->add_option("--storey", options->storey, "with --convert: how many floors above the ground (0: the ground)")
      ->check(zero_or_above("floor"));
  verb->add_option("--synthetic", options->synthetic.file,
                   "synthetic.yaml: a set of synthetic motions in place of records; --convert writes them to a folder");
  verb->add_option("--seed", options->synthetic.seed, "with --synthetic: of the study that draws them (1)")
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--number", options->synthetic.number, "with --synthetic: this motion alone, the first is 0")
      ->check(zero_or_above("number of a motion"));
  verb->add_flag("--overwrite", options->overwrite, "replace these files if they are there");
  add_processing(*verb, *options);
  verb->callback([options, verb, &work] {
    work = [options, verb](const Context& context) {
      context.world.on_root([&] { show(*options, *verb); });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
