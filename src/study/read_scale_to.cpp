// scale_to: the intensity that a motion is scaled to.
#include <fmt/format.h>

#include "base/shown_text.hpp"
#include "intensity/intensity.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

std::vector<std::string> proportional_measures() {
  std::vector<std::string> names;
  for (const auto* measure : intensity::all())
    if (measure->proportional) names.push_back(measure->name);
  return names;
}

// The measures that the mapping names, of all there are.
std::vector<const intensity::Measure*> measures_named(const Section& scale_to) {
  std::vector<const intensity::Measure*> named;
  for (const auto* measure : intensity::all())
    if (scale_to.has(measure->name)) named.push_back(measure);
  return named;
}

std::optional<double> read_parameter(Section& scale_to, const intensity::Measure& measure) {
  if (!measure.parameter) return {};
  return scale_to.number(measure.parameter->name, measure.parameter->fallback,
                         {.lower = 1e-3,
                          .lower_open = false,
                          .why = "it must be at least 0.001: a stiffer oscillator only follows the floor"});
}

}  // namespace

std::optional<Quantity> read_scale_to(Section& section, MotionSource& source) {
  const YAML::Node* node = section.find("scale_to");
  if (!node) return {};
  Section scale_to(*node, section.name("scale_to"), section.line("scale_to"), section.problems());
  if (section.has("scale"))
    section.problem("scale", fmt::format("{} and scale_to are both given (one determines the other): remove one",
                                         section.name("scale")));
  if (!node->IsMap()) return {};
  const auto named = measures_named(scale_to);
  const std::string known = joined(proportional_measures());
  if (named.size() != 1) {
    const std::string first = node->size() ? node->begin()->first.Scalar() : "";
    const std::string near = nearest(first, proportional_measures());
    section.problem("scale_to",
                    !named.empty()
                        ? fmt::format("{} has {} and {} (one determines the other): remove one",
                                      section.name("scale_to"), named[0]->name, named[1]->name)
                        : fmt::format("{} names no intensity that a motion can be scaled to ({}): name one of {}",
                                      section.name("scale_to"),
                                      near.empty() ? "it has " + (first.empty() ? "nothing in it" : shown(first))
                                                   : "did you mean " + near + "?",
                                      known));
    return {};
  }
  const intensity::Measure& measure = *named.front();
  if (!measure.proportional)
    section.problem("scale_to",
                    fmt::format("{} cannot be scaled to (it does not grow in proportion to the motion): name "
                                "one of {}",
                                scale_to.name(measure.name), known));
  source.scale_to =
      IntensityPart{measure.name, measure.parameter ? measure.parameter->name : "", read_parameter(scale_to, measure)};
  auto target = scale_to.quantity("motion", measure.name, range::any);  // negative: mirrored
  if (target) target->drawn_as = "motion.pta_g";                        // the same shaking, whatever it is measured by
  scale_to.finish();
  return target;
}

}  // namespace freestand::study
