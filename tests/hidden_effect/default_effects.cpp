#include "hidden_effect/default_effects.hpp"

#include <sstream>

#include "hidden_effect/generator.hpp"

namespace freestand::test {

std::vector<std::string> default_effects() {
  std::vector<std::string> all{"none"};
  all.insert(all.end(), catalogue_effects().begin(), catalogue_effects().end());
  all.insert(all.end(),
             {"static_friction+floor_tilt", "vertical_shaking+pressure_friction", "vertical_shaking+static_friction",
              "rate_weakening+wall_impact", "centering_spring+viscous_drag", "impact_loss+offset_mass"});
  all.insert(all.end(), outside_effects().begin(), outside_effects().end());
  return all;
}

std::vector<std::string> split_effects(const std::string& effects) {
  std::vector<std::string> names;
  std::istringstream stream(effects);
  for (std::string name; std::getline(stream, name, '+');)
    if (name != "none") names.push_back(name);
  return names;
}

}  // namespace freestand::test
