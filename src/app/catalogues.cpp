// The verbs `im` and `edp`: the catalogues of intensities and demands, as `effects` is that of the effects.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "study/measures_page.hpp"

namespace freestand::app {
namespace {

void add(CLI::App& parser, Work& work, const std::string& verb_name, const std::string& what,
         const study::MeasurePages& catalogue) {
  auto name = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* verb = parser.add_subcommand(verb_name, what);
  verb->add_option("name", *name, "one of them, in full");
  verb->add_flag("--json", *json, "for programs");
  verb->callback([name, json, catalogue, &work] {
    work = [name, json, catalogue](const Context& context) {
      context.world.on_root([&] { fmt::print("{}", *json ? catalogue.json(*name) : catalogue.page(*name)); });
      return Exit::done;
    };
  });
}

}  // namespace

void add_im(CLI::App& parser, Work& work) {
  add(parser, work, "im", "the intensities that a study or fit can name", study::intensities_catalogue());
}

void add_edp(CLI::App& parser, Work& work) {
  add(parser, work, "edp", "the demands that a study or fit can name", study::demands_catalogue());
}

}  // namespace freestand::app
