// Legs that give way up and down.
#include <fmt/format.h>

#include "dynamics/spring_legs.hpp"
#include "study/problems.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {

std::optional<LegsPart> read_legs(Section& file, const ModelPart& model) {
  const YAML::Node* node = file.find("legs");
  if (!node) return {};
  Section section(*node, "legs", file.line("legs"), file.problems());
  LegsPart legs;
  legs.frequency = section.quantity("legs", "vertical_frequency_hz", range::positive, 1);
  legs.damping = section.quantity("legs", "vertical_damping", range::not_negative);
  section.finish();
  if (!node->IsMap()) return {};
  if (!section.has("vertical_frequency_hz"))
    section.problem(
        "vertical_frequency_hz",
        "legs.vertical_frequency_hz is missing (how stiff the legs are is not known): add it, of the block that "
        "goes up and down on all of them");
  const auto refuse = [&](const std::string& why, const char* cure) {
    file.problem("legs", fmt::format("legs does not go with this block ({}): {}", why, cure));
  };
  if (model.model != Model::slide_rock)
    refuse("on legs that give way it sways, slips and rocks", "set model: slide_rock, or remove legs");
  else if (const std::string why = dynamics::refusal_on_spring_legs(kind_of(model)); !why.empty())
    refuse(why, "remove the effect, or legs");
  const auto& factor = model.impact.factor.value;
  if (model.impact.law != ImpactLaw::housner || !is_fixed(factor) || quantile(factor, 0.5) != 1)
    refuse("impact is of blows, which legs that give way soften", "remove impact, or legs");
  if (model.chain) refuse("a chain is of a block on rigid edges", "remove one of them");
  if (model.start.any()) refuse("on them a block begins at rest where it stands", "remove start, or legs");
  return legs;
}

}  // namespace freestand::study
