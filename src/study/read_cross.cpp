// Floors that move in both horizontal directions: what does not go with them.
#include <fmt/format.h>

#include <algorithm>

#include "dynamics/plane_slide.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {

Specimen kind_of(const ModelPart& model) {
  Specimen specimen;
  specimen.model = model.model;
  for (const EffectPart& part : model.effects) {
    specimen.effects.push_back({part.effect.get(), {}});
    for (const dynamics::Parameter& parameter : part.effect->parameters)
      specimen.effects.back().parameters.push_back(parameter.fitted ? parameter.low : parameter.fallback.value_or(1));
  }
  return specimen;
}

bool MotionSource::in_plane() const {
  const bool pairs =
      !cross_records.empty() ||
      std::any_of(files.begin(), files.end(), [](const motion::RecordRow& row) { return !row.cross.empty(); });
  return pairs && !turn;
}

void check_cross(Section& file, const Study& study, Files look) {
  if (look == Files::ignore)
    return;  // a table that is not there does not say whether it holds pairs; it was asked before the sweep
  const bool on_a_line =
      std::any_of(study.motions.begin(), study.motions.end(), [](const auto& source) { return !source.in_plane(); });
  const bool turned = std::any_of(study.motions.begin(), study.motions.end(),
                                  [](const auto& source) { return source.turn.has_value(); });
  if (study.model.friction.ratio_across && on_a_line)
    file.problem("friction",
                 fmt::format("friction.ratio_across is of sliding in both horizontal directions ({}): {}, or remove it",
                             turned ? "of a pair that rotate_deg turns one component is left"
                                    : "motions move the floor along one line",
                             turned ? "remove rotate_deg" : "give cross_records"));
  if (std::none_of(study.motions.begin(), study.motions.end(), [](const auto& source) { return source.in_plane(); }))
    return;
  const auto refuse = [&](const char* key, const std::string& why, const char* cure) {
    const char* place = file.has(key) ? key : file.has("motions") ? "motions" : "motion";
    file.problem(
        place, fmt::format("{} does not go with a second horizontal channel of the records ({}): {}", key, why, cure));
  };
  for (const MotionSource& source : study.motions) {
    if (!source.in_plane()) continue;
    const motion::Processing& done = source.processing;
    if (done.baseline || done.band || done.scale)
      refuse("motions", "baseline, band_pass_hz and scales are of one channel",
             "treat the files with `freestand motion --convert`, or keep one component of each pair by rotate_deg");
    if (source.building)
      refuse("building", "its floors move along one line",
             "keep one component of each pair by rotate_deg, or remove it");
  }
  const ModelPart& model = study.model;
  if (model.model != Model::slide)
    refuse("model", "in both directions a block is followed only where it slides and does nothing else",
           "set model: slide, or give one component of each record");
  else if (const std::string why = dynamics::refusal_in_plane(kind_of(model)); !why.empty())
    refuse("effects", why, "remove the effect, or give one component of each record");
  if (model.neighbour) refuse("neighbour", "it stands on one line", "remove it, or give one component of each record");
  if (model.chain) refuse("chain", "it pulls along one line", "remove it, or give one component of each record");
  if (model.start.any()) refuse("start", "there it begins at rest", "remove it, or give one component of each record");
  if (study.acceleration_height_m)
    refuse("acceleration_height_m", "a block that only slides has one acceleration", "remove it");
  if (study.contact_forces) refuse("contact_forces", "forces are followed along one line", "remove it");
  if (study.slip_by_side) refuse("slip_by_side", "the peak slip is that of a vector, which has no sides", "remove it");
}

}  // namespace freestand::study
