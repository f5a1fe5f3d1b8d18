#include "study/fit.hpp"

#include <memory>

#include "app/command.hpp"

namespace freestand::app {

void add_fit(CLI::App& parser, Work& work) {
  auto folder = std::make_shared<std::string>();
  CLI::App* verb = parser.add_subcommand("fit", "the second half of run: samples.h5 -> fragility.h5, tables, summary");
  verb->add_option("folder", *folder, "folder of a sweep")->required();
  verb->callback([folder, &work] {
    work = [folder](const Context& context) {
      study::fit(context.world, *folder, context.command_line);
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
