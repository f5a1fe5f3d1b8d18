#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/floors.hpp"
#include "base/units.hpp"
#include "io/output_folder.hpp"
#include "motion/component.hpp"
#include "motion/identify.hpp"
#include "motion/peaks.hpp"
#include "motion/record.hpp"
#include "motion/spectrum.hpp"
#include "study/read_building.hpp"

namespace freestand::app {
namespace {

struct MotionOptions {
  std::vector<std::string> files;
  std::string unit, channel, convert, floor;
  int storey = -1;
  double dt_s = 0;
  bool overwrite = false;
};

constexpr double spectrum_periods_s[] = {0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0};
constexpr double damping = 0.05;

std::string description(const FloorMotion& motion) {
  const motion::MotionPeaks peaks = motion::peaks(motion);
  const motion::IdentifiedPulse pulse = motion::identify_pulse(motion);
  std::string text = fmt::format("{}\n", motion.name);
  text += fmt::format("  {} samples, step {:g} s, {:g} s, {}\n", motion.knot_s.size(),
                      motion.duration_s() / static_cast<double>(motion.segments()), motion.duration_s(),
                      motion.vertical_mps2.empty() ? "horizontal" : "horizontal and vertical");
  text += fmt::format("  PGA {:.4f} g   PGV {:.4f} m/s   PGD {:.4f} m\n", peaks.pga_mps2 / standard_gravity_mps2,
                      peaks.pgv_mps, peaks.pgd_m);
  if (!pulse.type.empty())
    text += fmt::format(
        "  pulse {}: period {:.3f} s, velocity {:.3f} m/s, from {:.2f} s, explains {:.0f} % of the velocity\n",
        pulse.type, pulse.period_s, pulse.velocity_mps, pulse.start_s, 100 * pulse.explained);
  text += fmt::format("  Sa, {:.0f} % damped:", 100 * damping);
  for (const double period : spectrum_periods_s)
    text += fmt::format("  {:g} s {:.3f} g", period,
                        motion::spectral_acceleration_mps2(motion, period, damping) / standard_gravity_mps2);
  return text + "\n";
}

// Floor motion csv of the samples; the step of a record is constant.
std::string floor_csv(const FloorMotion& motion) {
  const bool vertical = !motion.vertical_mps2.empty();
  std::string text = vertical ? "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n"
                              : "time_s,floor_acceleration_mps2\n";
  const auto stride = static_cast<std::size_t>(motion.degree) + 1;
  for (std::size_t i = 0; i < motion.knot_s.size(); ++i) {
    const bool last = i == motion.segments();  // the end of the last segment
    const auto at = [&](const std::vector<double>& c) {
      return last ? c[(i - 1) * stride] + c[(i - 1) * stride + 1] * (motion.knot_s[i] - motion.knot_s[i - 1])
                  : c[i * stride];
    };
    text += fmt::format("{},{}", motion.knot_s[i], at(motion.horizontal_mps2));
    text += vertical ? fmt::format(",{}\n", at(motion.vertical_mps2)) : "\n";
  }
  return text;
}

void convert(const FloorMotion& motion, const MotionOptions& options) {
  const std::filesystem::path target = options.convert;
  if (std::filesystem::exists(target) && !std::filesystem::is_regular_file(target))
    throw Error(target.string() + " is no plain file (it would be replaced by one): give the name of a file");
  if (std::filesystem::exists(target) && !options.overwrite)
    throw Error(target.string() + " exists already (it would be lost): choose another name, or give --overwrite");
  io::write_text(target, floor_csv(motion));
}

Exit show(const MotionOptions& options) {
  if (!options.convert.empty() && options.files.size() != 1)
    throw Error("--convert takes one record (there are " + std::to_string(options.files.size()) +
                "): convert them one by one");
  if (options.storey >= 0 && options.floor.empty())
    throw Error(fmt::format("--storey {} is of no building (the record is taken as it is): add --floor building.yaml",
                            options.storey));
  std::optional<motion::Building> building;
  if (!options.floor.empty()) building = study::read_building_file(options.floor);
  if (building && options.storey > building->floors())
    throw Error(
        fmt::format("--storey {} is none of {} (it has {} floors above the ground, which is 0): name one of these",
                    options.storey, building->name, building->floors()));
  if (building && options.storey < 0 && !options.convert.empty())
    throw Error(fmt::format(
        "--convert writes the motion of one floor (of {}, which has {}, and of the ground, 0): add --storey {}",
        building->name, building->floors(), building->floors()));
  motion::ReadOptions read;
  if (options.dt_s > 0) read.dt_s = options.dt_s;
  read.unit = options.unit;
  read.channel = options.channel;
  for (const std::string& file : options.files) {
    const FloorMotion motion = motion::read_record(file, read);
    fmt::print("{}", description(motion));
    if (const std::string sign = motion::vertical_sign(file); !sign.empty())
      fmt::print("  a vertical component: {}\n", sign);
    if (building) fmt::print("{}", floors_text(motion, *building));
    if (!options.convert.empty()) convert(building ? floor_of(motion, *building, options.storey) : motion, options);
  }
  return Exit::done;
}

}  // namespace

void add_motion(CLI::App& parser, Work& work) {
  auto options = std::make_shared<MotionOptions>();
  CLI::App* verb = parser.add_subcommand("motion", "what is in a record: step, peaks, spectrum, identified pulse");
  verb->add_option("files", options->files, "records")->required();
  verb->add_option("--dt", options->dt_s, "time step in s, for plain columns")->check(CLI::PositiveNumber);
  verb->add_option("--unit", options->unit, "unit of plain columns: g, m/s2, cm/s2 ...");
  verb->add_option("--channel", options->channel, "channel of files that hold several");
  verb->add_option("--convert", options->convert, "write the record as floor motion csv to this file");
  verb->add_option("--floor", options->floor,
                   "building.yaml: the record is of the ground; tells what each floor of it does");
  verb->add_option("--storey", options->storey, "with --convert: how many floors above the ground (0: the ground)")
      ->check(CLI::NonNegativeNumber);
  verb->add_flag("--overwrite", options->overwrite, "replace that file if it is there");
  verb->callback([options, &work] {
    work = [options](const Context& context) {
      context.world.on_root([&] { show(*options); });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
