// The laws of a sample are recorded on one tape (dynamics/tape.hpp), whose length is fixed. Whether those of a study find
// room there is known before the first sample: what a law asks for follows from its text, but for exponents that are whole
// numbers and for equal constants, which are recorded once. So the laws are recorded with numbers from within their
// ranges, no two alike, and at the ends of their ranges, whole ones among them.
#include <fmt/format.h>

#include <cmath>

#include "dynamics/chain.hpp"
#include "dynamics/laws.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using dynamics::Excess;

using Pick = double (*)(const sampling::Distribution&, std::size_t place);

double within(const sampling::Distribution& value, std::size_t place) {
  const double golden = 0.6180339887498949;  // its multiples are never alike
  return sampling::quantile(value, std::fmod(golden * static_cast<double>(place + 1), 1.0));
}
double least(const sampling::Distribution& value, std::size_t) { return sampling::support(value).lower; }
double most(const sampling::Distribution& value, std::size_t) { return sampling::support(value).upper; }
double whole(const sampling::Distribution& value, std::size_t) { return std::floor(sampling::support(value).upper); }

Excess excess(const std::vector<EffectPart>& effects, const std::optional<ChainPart>& chain, Pick pick) {
  Specimen specimen{Block::rectangular(1, 1, 1), {0.5, 0.5}, {}};
  std::size_t place = 0;
  for (const EffectPart& part : effects) {
    specimen.effects.push_back({part.effect.get(), {}});
    for (const Quantity& q : part.parameters) specimen.effects.back().parameters.push_back(pick(q.value, place++));
  }
  if (chain)
    specimen.effects.push_back(dynamics::use({.stiffness_npm = 1,
                                              .strength_n = 1,
                                              .elevation_rad = chain->elevation ? 0.3 : 0.0,
                                              .damping_nspm = chain->damping ? 1.0 : 0.0},
                                             specimen.block));
  return dynamics::Laws(specimen).excess;
}

}  // namespace

std::string no_room_for(const std::vector<EffectPart>& effects, const std::optional<ChainPart>& chain) {
  Excess found = Excess::none;
  for (const Pick pick : {within, least, most, whole})
    if (found == Excess::none) found = excess(effects, chain, pick);
  if (found == Excess::none) return "";
  std::string names;
  for (const EffectPart& part : effects) names += (names.empty() ? "" : ", ") + part.name;
  if (chain) names += (names.empty() ? "" : " and ") + std::string("the chain");
  switch (found) {
    case Excess::kinks:
      return fmt::format(
          "the laws of {} bend too often for one sample (abs, min, max, if, step, < and > stand in them "
          "more than {} times): shorten them, or leave one out",
          names, dynamics::max_kinks);
    case Excess::states:
      return fmt::format("the effects {} bring along too many states for one sample (more than {}): leave one out",
                         names, dynamics::max_states);
    default:
      return fmt::format(
          "the laws of {} are too long for one sample (they make more than {} operations): shorten "
          "them, or leave one out",
          names, dynamics::max_nodes - dynamics::input_count);
  }
}

}  // namespace freestand::study
