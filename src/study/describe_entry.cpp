// What the study of an entry says about its equipment, as the numbers and words of a database.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "base/random.hpp"
#include "study/catalogue.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

class Description {
 public:
  explicit Description(const Study& study) : study_(study), target_(study.fragility.target) {}

  void put(database::Entry& entry) const {
    describe_block(study_.model.block, entry);
    describe_friction(study_.model, entry);
    entry.model = model_words(study_.model);
    entry.effects = effect_words(study_.model.effects);
    entry.scatter = scatter_words(study_.model);
  }

 private:
  // As it is in the samples that are counted: where a target is given for it, as that is.
  const sampling::Distribution& counted(const Quantity& quantity) const {
    for (const Quantity& target : target_)
      if (target.name == quantity.name) return target.value;
    return quantity.value;
  }
  double median(const Quantity& quantity) const { return sampling::quantile(counted(quantity), 0.5); }

  std::string number(const Quantity& quantity) const { return fmt::format("{:.6g}", median(quantity)); }

  void describe_block(const BlockPart& block, database::Entry& entry) const {
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

  void describe_friction(const ModelPart& model, database::Entry& entry) const {
    const FrictionPart& friction = model.friction;
    entry.mu_k = median(friction.mu ? *friction.mu : *friction.mu_k);
    entry.mu_s = friction.mu_s           ? median(*friction.mu_s)
                 : friction.static_ratio ? entry.mu_k * median(*friction.static_ratio)
                                         : entry.mu_k;
    for (const EffectPart& effect : model.effects)
      if (effect.name == "static_friction") entry.mu_s = entry.mu_k * median(effect.parameters.front());
  }

  // Of a number that grows with the block, which blocks of several sizes that are alike have in common over their height: as points of one
  // grid. Of an inertia the radius of gyration, by which alone it moves the block.
  std::string over_height(const BlockPart& block, const Quantity& q) const {
    const bool inertia = q.name == "block.inertia_kgm2";
    const double length = inertia ? std::sqrt(median(q) / median(block.mass)) : median(q);
    return fmt::format(" {}/height={:.6g}", inertia ? "block.gyration_radius_m" : q.name,
                       length / median(*block.height));
  }

  // All of the model but what the columns of an entry hold, and its effects. Mass moves nothing in a free block of a given radius of
  // gyration.
  std::string model_words(const ModelPart& model) const {
    constexpr const char* models[] = {"slide", "rock", "slide_rock", "bouc_wen"};
    const std::set<std::string> columns{"block.width_m", "block.height_m",       "block.slenderness_rad",
                                        "block.size_m",  "friction.mu",          "friction.mu_k",
                                        "friction.mu_s", "friction.static_ratio"};
    const std::set<std::string> lengths{"block.centre_height_m", "block.gyration_radius_m", "block.inertia_kgm2"};
    const bool heavy = model.chain || model.neighbour;
    std::string words = models[static_cast<int>(model.model)];
    words += model.impact.law == ImpactLaw::housner ? " impact=housner" : " impact=coulomb";
    for (const Quantity& q : quantities(model)) {
      const bool usual = q.name == model.impact.factor.name && median(q) == 1;
      if (columns.contains(q.name) || q.name.starts_with("effects.") || usual || (!heavy && q.name == "block.mass_kg"))
        continue;
      words += lengths.contains(q.name) ? over_height(model.block, q) : fmt::format(" {}={}", q.name, number(q));
    }
    if (model.chain) words += model.chain->side > 0 ? " chain.side=right" : " chain.side=left";
    if (model.neighbour) words += model.neighbour->side > 0 ? " neighbour.side=right" : " neighbour.side=left";
    return words;
  }

  std::string effect_words(const std::vector<EffectPart>& effects) const {
    std::vector<std::string> words;
    for (const EffectPart& effect : effects) {
      std::vector<std::string> parameters;
      for (const Quantity& q : effect.parameters)
        parameters.push_back(q.name.substr(q.name.rfind('.') + 1) + "=" + number(q));
      words.push_back(
          fmt::format("{}({}{}{})", effect.name, effect.friction, effect.force, fmt::join(parameters, ",")));
    }
    return fmt::format("{}", fmt::join(words, " "));
  }

  std::string scatter_words(const ModelPart& model) const {
    constexpr double one_sigma = 0.8413447460685429;
    std::vector<std::string> words;
    for (const Quantity& q : quantities(model))
      if (!is_fixed(counted(q)))
        words.push_back(fmt::format("{} x{:.4g}", q.name, sampling::quantile(counted(q), one_sigma) / median(q)));
    return fmt::format("{}", fmt::join(words, ", "));
  }

  const Study& study_;
  const std::vector<Quantity>& target_;
};

}  // namespace

void describe(const Study& study, database::Entry& entry) {
  Description(study).put(entry);
  entry.shaking = fmt::format("{:016x}", random::stable_hash(motions_text(study.motions)));
  entry.seed = static_cast<std::int64_t>(study.seed);
  entry.samples = static_cast<std::int64_t>(study.samples);
}

}  // namespace freestand::study
