// What the study of an entry says about its equipment, as the numbers and words of a database.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/random.hpp"
#include "study/catalogue.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

double median(const Quantity& quantity) { return sampling::quantile(quantity.value, 0.5); }

std::string number(const Quantity& quantity) { return fmt::format("{:.6g}", median(quantity)); }

void describe_block(const BlockPart& block, database::Entry& entry) {
  if (block.width && block.height) {
    entry.width_m = median(*block.width);
    entry.height_m = median(*block.height);
  } else {
    const double angle = median(*block.slenderness), radius = median(*block.size);
    entry.width_m = 2 * radius * std::sin(angle);
    entry.height_m = 2 * radius * std::cos(angle);
  }
  if (block.mass.line > 0) entry.mass_kg = median(block.mass);  // else nobody gave it
}

void describe_friction(const FrictionPart& friction, database::Entry& entry) {
  entry.mu_k = median(friction.mu ? *friction.mu : *friction.mu_k);
  entry.mu_s = friction.mu_s           ? median(*friction.mu_s)
               : friction.static_ratio ? entry.mu_k * median(*friction.static_ratio)
                                       : entry.mu_k;
}

std::string model_words(const ModelPart& model) {
  constexpr const char* models[] = {"slide", "rock", "slide_rock", "bouc_wen"};
  std::string words = models[static_cast<int>(model.model)];
  for (const auto& q : {model.friction.ratio_across, model.friction.axis})
    if (q) words += fmt::format(" {}={}", q->name, number(*q));
  if (const auto& contact = model.bouc_wen)
    for (const auto& q : {contact->yield_displacement, contact->exponent, contact->gamma, contact->beta})
      words += fmt::format(" {}={}", q.name, number(q));
  words += model.impact.law == ImpactLaw::housner ? " impact=housner" : " impact=coulomb";
  if (median(model.impact.factor) != 1) words += " impact.factor=" + number(model.impact.factor);
  if (const auto& chain = model.chain) {
    words += fmt::format(" block.mass_kg={}", number(model.block.mass));
    for (const auto& q : {chain->slack, chain->stiffness, chain->strength})
      words += fmt::format(" {}={}", q.name, number(q));
    for (const auto& q :
         {chain->height, chain->number, chain->plan_angle, chain->elevation, chain->damping, chain->wall_gap})
      if (q) words += fmt::format(" {}={}", q->name, number(*q));
    words += chain->side > 0 ? " chain.side=right" : " chain.side=left";
  }
  if (const auto& neighbour = model.neighbour) {
    words += fmt::format(" block.mass_kg={}", number(model.block.mass));
    for (const auto& q : neighbour->given()) words += fmt::format(" {}={}", q.name, number(q));
    words += neighbour->side > 0 ? " neighbour.side=right" : " neighbour.side=left";
  }
  if (const auto& legs = model.legs)
    for (const auto& q : {std::optional(legs->frequency), legs->damping})
      if (q) words += fmt::format(" {}={}", q->name, number(*q));
  return words;
}

std::string effect_words(const std::vector<EffectPart>& effects) {
  std::vector<std::string> words;
  for (const EffectPart& effect : effects) {
    std::vector<std::string> parameters;
    for (const Quantity& q : effect.parameters)
      parameters.push_back(q.name.substr(q.name.rfind('.') + 1) + "=" + number(q));
    words.push_back(fmt::format("{}({}{}{})", effect.name, effect.friction, effect.force, fmt::join(parameters, ",")));
  }
  return fmt::format("{}", fmt::join(words, " "));
}

std::string scatter_words(const ModelPart& model) {
  constexpr double one_sigma = 0.8413447460685429;
  std::vector<std::string> words;
  for (const Quantity& q : quantities(model))
    if (!is_fixed(q.value))
      words.push_back(fmt::format("{} x{:.4g}", q.name, sampling::quantile(q.value, one_sigma) / median(q)));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

void describe(const Study& study, database::Entry& entry) {
  describe_block(study.model.block, entry);
  describe_friction(study.model.friction, entry);
  entry.model = model_words(study.model);
  entry.effects = effect_words(study.model.effects);
  entry.scatter = scatter_words(study.model);
  entry.shaking = fmt::format("{:016x}", random::stable_hash(motions_text(study.motions)));
  entry.seed = static_cast<std::int64_t>(study.seed);
  entry.samples = static_cast<std::int64_t>(study.samples);
}

}  // namespace freestand::study
