// The block that stands beside another one.
#include <fmt/format.h>

#include "dynamics/side_by_side.hpp"
#include "study/problems.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {

std::optional<NeighbourPart> read_neighbour(Section& file, const ModelPart& model) {
  const YAML::Node* node = file.find("neighbour");
  if (!node) return {};
  Section section(*node, "neighbour", file.line("neighbour"), file.problems());
  NeighbourPart neighbour;
  neighbour.gap = section.quantity("neighbour", "gap_m", range::not_negative, 0);
  neighbour.mass = section.quantity("neighbour", "mass_kg", range::positive, 0);
  neighbour.mu_k = section.quantity("neighbour", "mu_k", range::not_negative, 0);
  neighbour.static_ratio =
      section.quantity("neighbour", "static_ratio", {.lower = 1, .lower_open = false, .why = "it must be at least 1"});
  neighbour.restitution = section.quantity("neighbour", "restitution", range::fraction);
  neighbour.side = section.choice("side", {"right", "left"}, 0) == 0 ? 1 : -1;
  section.finish();
  if (!node->IsMap()) return {};
  for (const char* key : {"gap_m", "mass_kg", "mu_k"})
    if (!section.has(key))
      section.problem(key, fmt::format("{0} is missing (it is the block beside that is not known): add {1}",
                                       section.name(key), key));
  const auto refuse = [&](const std::string& why, const char* cure) {
    file.problem("neighbour", fmt::format("neighbour does not go with this block ({}): {}", why, cure));
  };
  if (model.model != Model::slide)
    refuse("two blocks side by side are followed where they only slide", "set model: slide, or remove neighbour");
  else if (const std::string why = dynamics::refusal_beside_neighbour(kind_of(model)); !why.empty())
    refuse(why, "remove the effect, or neighbour");
  if (model.chain) refuse("a chain is of a block that stands alone", "remove one of them");
  if (model.start.any()) refuse("beside it a block begins at rest", "remove start, or neighbour");
  if (model.block.mass.line == 0)
    refuse("in their blows both masses matter, and that of the block is not given", "add block.mass_kg");
  return neighbour;
}

void check_neighbour(Section& file, const Study& study) {
  if (!study.model.neighbour) return;
  const auto refuse = [&](const char* key) {
    file.problem(key,
                 fmt::format("{} does not go with neighbour (it is of a block that stands alone): remove one", key));
  };
  if (study.acceleration_height_m) refuse("acceleration_height_m");
  if (study.contact_forces) refuse("contact_forces");
}

}  // namespace freestand::study
