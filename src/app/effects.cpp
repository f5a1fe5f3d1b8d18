#include "effects/effects.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "study/effects_page.hpp"
#include "study/problems.hpp"

namespace freestand::app {
namespace {

const dynamics::Effect& effect_named(const std::string& name) {
  if (const auto* effect = freestand::effects::find(name)) return *effect;
  std::vector<std::string> names;
  for (const auto& effect : freestand::effects::all()) names.push_back(effect.name);
  throw Error(
      fmt::format("effect {} is not in the catalogue ({}): see `freestand effects`", name, study::hint(name, names)));
}

std::string json_of_all() {
  auto all = nlohmann::ordered_json::array();
  for (const auto& effect : freestand::effects::all()) all.push_back(study::effect_json(effect));
  return all.dump(2) + "\n";
}

void tell_effects(const std::string& name, bool json) {
  if (name.empty())
    fmt::print("{}", json ? json_of_all() : study::effects_list());
  else if (json)
    fmt::print("{}\n", study::effect_json(effect_named(name)).dump(2));
  else
    fmt::print("{}", study::effect_page(effect_named(name)));
}

}  // namespace

void add_effects(CLI::App& parser, Work& work) {
  auto name = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* verb = parser.add_subcommand("effects", "the physical effects that a study can name: laws and parameters");
  verb->add_option("name", *name, "one effect, in full");
  verb->add_flag("--json", *json, "for programs");
  verb->callback([name, json, &work] {
    work = [name, json](const Context& context) {
      context.world.on_root([&] { tell_effects(*name, *json); });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
