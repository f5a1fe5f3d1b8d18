#include "study/simulate.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "study/accuracy.hpp"

namespace freestand::app {
namespace {

struct SimulateOptions {
  std::string file, folder;
  bool overwrite = false, reference = false;
};

Exit simulate(const SimulateOptions& options) {
  const study::Case c = study::read_case(options.file);
  const std::filesystem::path folder = options.folder;
  io::take_output_folder(folder, io::existing(options.overwrite), {.writes = {"case.yaml"}, .reads = {options.file}});
  const study::Simulation result = study::simulate(c, options.reference);
  for (const std::string& doubt : result.doubts) fmt::print(stderr, "doubtful: {}\n", doubt);
  io::write_result(folder / "history.csv",
                   io::history_csv(result.history, result.floor_displacement_m, result.specimen.block.mass_kg));
  nlohmann::ordered_json summary =
      io::response_summary(result.response, result.history.cross, result.specimen.block.mass_kg);
  summary["accuracy"] = study::accuracy_json(c.study.tolerance, result.response, result.tighter);
  io::write_result(folder / "summary.json", io::json_text(summary));
  io::write_text(folder / "case.yaml", io::signed_text(study::expanded(c, folder)));
  fmt::print("{}: peak slip {:.4g} m, peak rotation {:.4g} rad (alpha {:.4g} rad), {} events; results in {}\n",
             name(result.response.outcome), result.response.peak_slip_m, result.response.peak_rotation_rad,
             result.specimen.block.alpha_rad(), result.response.events, folder.string());
  if (result.still_moving)
    fmt::print(
        "it still moves after {:g} s of free vibration: free_vibration_s may be too short, or nothing stops it\n",
        c.study.free_vibration_s);
  if (result.response.outcome >= Outcome::painleve)
    fmt::print("the computation broke off at {:.4g} s: {}; the numbers hold until then\n", result.response.end_time_s,
               failure(result.response.outcome));
  return Exit::done;
}

}  // namespace

void add_simulate(CLI::App& parser, Work& work) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* verb = parser.add_subcommand("simulate", "one sample: history.csv, summary.json");
  verb->add_option("case", options->file, "case file")->required();
  verb->add_option("-o,--output", options->folder, "folder for the results")->required();
  verb->add_flag("--overwrite", options->overwrite, "replace results that are already in the folder");
  verb->add_flag("--reference", options->reference, "integrate with SUNDIALS instead of the integrator of the sweep");
  verb->callback([options, &work] {
    work = [options](const Context& context) {
      context.world.on_root([&] { simulate(*options); });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
