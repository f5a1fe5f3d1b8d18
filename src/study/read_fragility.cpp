// fragility: intensity measure, bins, EDPs, capacities, second axes.
#include <fmt/format.h>

#include <algorithm>

#include "base/shown_text.hpp"
#include "fragility/options.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

const BinsPart default_bins = {{}, 0, 12, Spacing::equal_count};
const BinsPart default_axis_bins = {{}, 0, 5, Spacing::equal_count};

bool increasing(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

// {count: n, spacing: ...}, {width: w} or {edges: [...]}; `fallback` where the key is absent.
BinsPart read_bins(Section& parent, const std::string& key, const BinsPart& fallback) {
  const YAML::Node* node = parent.find(key);
  if (!node) return fallback;
  Section section(*node, parent.name(key), parent.line(key), parent.problems());
  BinsPart bins;
  bins.edges = section.numbers("edges");
  bins.width = section.number("width", 0, {.lower = 0, .why = "a width must be above zero"});
  bins.count = static_cast<int>(section.integer("count", 0, 1, 1000));
  bins.spacing = static_cast<Spacing>(
      section.choice("spacing", {"equal_width", "equal_count", "log"}, static_cast<std::size_t>(fallback.spacing)));
  section.finish();
  if (!node->IsMap()) return fallback;

  const int rules = section.has("edges") + section.has("width") + section.has("count");
  if (rules != 1)
    section.problem(
        "edges", fmt::format("{} has {} of edges, width and count (one of them makes the bins): {}", parent.name(key),
                             rules == 0 ? "none" : "more than one", "write for example {count: 12}"));
  if (section.has("spacing") && !section.has("count"))
    section.problem("spacing",
                    section.name("spacing") + " goes with count only (edges and width say it all): remove it");
  if (section.has("edges") && bins.edges.size() < 2)
    section.problem("edges", section.name("edges") + " has fewer than two numbers (a bin has two ends): add edges");
  if (!increasing(bins.edges))
    section.problem("edges",
                    section.name("edges") + " does not increase (each edge must be above the one before): sort it");
  return rules == 1 ? bins : fallback;
}

// sa_g:0.5, as the command line and databases write it, is {name: sa_g, period_s: 0.5}. Undefined: it is not of that form.
YAML::Node with_its_number(const YAML::Node& im, const Known& known) {
  if (!im.IsScalar()) return YAML::Node(YAML::NodeType::Undefined);
  const std::string& text = im.Scalar();
  const std::size_t colon = text.find(':');
  for (const auto& measure : known.intensities)
    if (colon != std::string::npos && measure.name == text.substr(0, colon) && !measure.parameter.empty()) {
      YAML::Node mapping;
      mapping["name"] = measure.name;
      mapping[measure.parameter] = text.substr(colon + 1);
      return mapping;
    }
  return YAML::Node(YAML::NodeType::Undefined);
}

IntensityPart read_intensity(Section& section, const Known& known) {
  std::vector<std::string> names;
  for (const auto& intensity : known.intensities) names.push_back(intensity.name);
  IntensityPart im;
  const YAML::Node* node = section.find("im");
  const YAML::Node written = node ? with_its_number(*node, known) : YAML::Node(YAML::NodeType::Undefined);
  if (written.IsDefined()) node = &written;
  std::optional<Section> mapping;
  if (node && node->IsMap()) mapping.emplace(*node, section.name("im"), section.line("im"), section.problems());
  if (mapping) {
    im.name = mapping->text("name", "");
    if (!mapping->has("name"))
      mapping->problem("name", section.name("im") + " has no name (which measure?): add name: sa_g");
  } else {
    im.name = section.text("im", im.name);
  }
  const auto found = std::find_if(known.intensities.begin(), known.intensities.end(),
                                  [&](const auto& k) { return k.name == im.name; });
  if (found == known.intensities.end() && known.any_record && im.name.starts_with("record.")) return im;
  const bool building = std::any_of(names.begin(), names.end(), [](const auto& n) { return n.starts_with("ground."); });
  if (found == known.intensities.end() && im.name.starts_with("ground.") && !building) {
    section.problem("im", fmt::format("{} is {} (no records of this study have the keys building and storey: what is "
                                      "under the equipment is the record itself): take {}, or give building and storey "
                                      "(0: the ground, beside sweeps on floors)",
                                      section.name("im"), im.name, im.name.substr(7)));
    return im;
  }
  if (found == known.intensities.end()) {
    if (!im.name.empty())
      section.problem("im",
                      fmt::format("intensity measure {} is not known ({}): name one of {}", im.name,
                                  nearest(im.name, names).empty() ? "nothing like it is there" : hint(im.name, names),
                                  joined(names)));
    return im;
  }
  im.parameter = found->parameter;
  if (!im.parameter.empty()) im.period_s = found->fallback;
  if (mapping) {
    if (!found->parameter.empty())
      im.period_s = mapping->number(found->parameter, found->fallback,
                                    {.lower = 1e-3,
                                     .lower_open = false,
                                     .why = "it must be at least 0.001: a stiffer oscillator only follows the floor"});
    mapping->finish();
  }
  return im;
}

const KnownEdp* find_edp(const Known& known, const std::string& name) {
  const auto found = std::find_if(known.edps.begin(), known.edps.end(), [&](const auto& e) { return e.name == name; });
  return found == known.edps.end() ? nullptr : &*found;
}

std::string unknown_edp(const Known& known, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& edp : known.edps) names.push_back(edp.name);
  if (name.find_first_of("<>=") != std::string::npos || name.find(" or ") != std::string::npos ||
      name.find(" and ") != std::string::npos)
    return fmt::format(
        "{} is a condition, not a demand (demands are numbers with names: {}): give it a name under `damage:` of "
        "`fragility` in "
        "the study, as damage: {{falls: \"{}\"}}",
        shown(name), joined(names), shown(name));
  return fmt::format("demand parameter {} is not known ({}): name some of {}", name,
                     nearest(name, names).empty() ? "nothing like it is there" : hint(name, names), joined(names));
}

std::vector<std::string> read_edps(Section& section, const Known& known) {
  std::vector<std::string> edps;
  const YAML::Node* node = section.find("edp");
  if (!node) {
    for (const auto& edp : known.edps)
      if (edp.by_default) edps.push_back(edp.name);
    return edps;
  }
  const auto names = read_names(*node, section.name("edp"), section.line("edp"), section.problems());
  for (const auto& name : names ? names->values : std::vector<std::string>{}) {
    if (!find_edp(known, name))
      section.problem("edp", unknown_edp(known, name));
    else if (std::find(edps.begin(), edps.end(), name) != edps.end())
      section.problem("edp", fmt::format("{} names {} twice (once is enough): remove one", section.name("edp"), name));
    else if (const std::string& refusal = find_edp(known, name)->refusal; !refusal.empty())
      section.problem("edp", fmt::format("{}: {}", section.name("edp"), refusal));
    else
      edps.push_back(name);
  }
  return edps;
}

void check_capacities(Section& section, const std::string& edp, const std::vector<double>& values) {
  if (values.empty())
    section.problem(edp, section.name(edp) + " is empty (a surface needs capacities): list at least one");
  else if (values.front() <= 0)
    section.problem(
        edp, section.name(edp) + " has a capacity that is not above zero (it would always be exceeded): remove it");
  if (!increasing(values))
    section.problem(edp,
                    section.name(edp) + " does not increase (each capacity must be above the one before): sort it");
}

// The numbers of a list; each distribution in it becomes a damage state: the demand exceeds a capacity that is drawn.
std::vector<double> read_values(Section& given, const std::string& edp, std::vector<DamagePart>& damage) {
  const YAML::Node& node = *given.find(edp);
  if (!node.IsSequence() || std::none_of(node.begin(), node.end(), [](const auto& entry) { return entry.IsMap(); }))
    return given.numbers(edp);
  std::vector<double> values;
  int drawn = 0;
  for (const auto& entry : node) {
    const int line = line_of(entry) ? line_of(entry) : given.line(edp);
    const auto value = read_distribution(entry, given.name(edp), line, given.problems());
    if (!value) continue;
    if (const auto* fixed = std::get_if<sampling::Fixed>(&*value)) {
      values.push_back(fixed->value);
      continue;
    }
    check_range(*value, range::positive, given.name(edp), line, given.problems());
    const std::string name = fmt::format("{}_over_capacity_{}", edp, ++drawn);
    damage.push_back({name,
                      edp + " > capacity",
                      {Quantity{fmt::format("damage.{}.capacity", name), unit_of(edp), *value, line}},
                      {},
                      line});
  }
  return values;
}

std::vector<CapacitiesPart> read_capacities(Section& section, const Known& known, const std::vector<std::string>& edps,
                                            std::vector<DamagePart>& damage) {
  std::optional<Section> given;
  if (const YAML::Node* node = section.find("capacities"))
    given.emplace(*node, section.name("capacities"), section.line("capacities"), section.problems());
  std::vector<CapacitiesPart> capacities;
  for (const auto& name : edps) {
    const KnownEdp& edp = *find_edp(known, name);
    if (edp.binary) {
      if (given && given->find(name))
        given->problem(name,
                       fmt::format("{} has capacities (it happens or not, nothing is exceeded): remove them", name));
      continue;
    }
    CapacitiesPart part{name, edp.default_capacities};
    if (given && given->find(name)) {
      const std::size_t before = section.problems().count();
      part.values = read_values(*given, name, damage);
      if (part.values.empty() && !damage.empty() && damage.back().when.starts_with(name + " "))
        part.values = edp.default_capacities;  // distributions alone
      if (section.problems().count() == before) check_capacities(*given, name, part.values);
    } else if (part.values.empty()) {
      section.problem("capacities", fmt::format("{} has no capacities (and no usual ones): add {}: [...] to {}", name,
                                                name, section.name("capacities")));
    }
    capacities.push_back(std::move(part));
  }
  if (!given) return capacities;
  for (const auto& edp : known.edps)
    if (given->find(edp.name) && std::find(edps.begin(), edps.end(), edp.name) == edps.end())
      given->problem(
          edp.name, fmt::format("capacities of {}, which is not in {} (nothing would use them): add it there", edp.name,
                                section.name("edp")));
  given->finish();
  return capacities;
}

// still: {peak_slip_m: 1e-4}, below the EDP's lowest capacity.
std::map<std::string, double> read_still(Section& section, const Known& known, const FragilityPart& part) {
  std::map<std::string, double> still;
  for (const CapacitiesPart& edp : part.capacities) {
    const double usual = find_edp(known, edp.edp)->still;
    // A capacity of the user's own may be smaller than what is usually told apart from nothing.
    still[edp.edp] = edp.values.empty() ? usual : std::min(usual, 0.1 * edp.values.front());
  }
  const YAML::Node* node = section.find("still");
  if (!node) return still;
  Section given(*node, section.name("still"), section.line("still"), section.problems());
  for (const CapacitiesPart& edp : part.capacities) {
    if (!given.find(edp.edp)) continue;
    const double threshold = given.number(
        edp.edp, 0, {.lower = 0, .lower_open = false, .why = "it is a demand at or below which nothing moved"});
    if (!edp.values.empty() && threshold >= edp.values.front())
      given.problem(edp.edp, fmt::format("{} is not below the lowest capacity, {} (what is still exceeds nothing): "
                                         "lower it, or raise the capacity",
                                         given.name(edp.edp), edp.values.front()));
    still[edp.edp] = threshold;
  }
  for (const auto& edp : known.edps)
    if (given.find(edp.name) && !still.count(edp.name))
      given.problem(edp.name, fmt::format("{} has no threshold (it is not asked for, or happens or not): remove it",
                                          given.name(edp.name)));
  given.finish();
  return still;
}

void check_axis(Section& section, const std::string& key, const std::string& name,
                const std::vector<AxisChoice>& choices) {
  if (choices.empty()) return;
  const auto found = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.name == name; });
  if (found == choices.end()) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.name);
    section.problem(key, fmt::format("axis {} is nothing that this study draws ({}): name one of {}", name,
                                     nearest(name, names).empty() ? "not known" : hint(name, names), joined(names)));
  } else if (!found->varies) {
    section.problem(
        key, fmt::format("axis {} has one value only (an axis needs a range): give it a distribution, or {}", name,
                         "remove the axis"));
  }
}

// target: {friction.mu_k: {lognormal: {median: 0.3, dispersion: 0.2}}}; check_target() says of which numbers.
std::vector<Quantity> read_target(Section& section) {
  std::vector<Quantity> target;
  const YAML::Node* node = section.find("target");
  if (!node) return target;
  Section given(*node, section.name("target"), section.line("target"), section.problems());
  if (!node->IsMap()) return target;
  for (const auto& entry : *node) {
    const std::string name = entry.first.Scalar();
    if (auto quantity = given.quantity("target", name, range::any)) {
      quantity->name = name;
      target.push_back(std::move(*quantity));
    }
  }
  given.finish();
  return target;
}

std::vector<AxisPart> read_axes(Section& section, const std::vector<AxisChoice>& choices) {
  std::vector<AxisPart> axes;
  const YAML::Node* node = section.find("axes");
  if (!node) return axes;
  if (!node->IsSequence()) {
    section.problem("axes", section.name("axes") + " is no list (each axis is an entry): write [friction.mu_k]");
    return axes;
  }
  if (lacks_braces(*node, section.name("axes"), section.line("axes"), section.problems())) return axes;
  for (std::size_t i = 0; i < node->size(); ++i) {
    const YAML::Node& entry = (*node)[i];
    if (entry.IsScalar()) {
      axes.push_back({entry.Scalar(), default_axis_bins});
      check_axis(section, "axes", entry.Scalar(), choices);
      continue;
    }
    const int line = line_of(entry) ? line_of(entry) : section.line("axes");
    Section axis(entry, fmt::format("{}[{}]", section.name("axes"), i), line, section.problems());
    if (!entry.IsMap()) continue;
    axes.push_back({axis.text("name", ""), read_bins(axis, "bins", default_axis_bins)});
    check_axis(axis, "name", axes.back().name, choices);
    axis.finish();
  }
  return axes;
}

}  // namespace

FragilityPart read_fragility(Section& file, const Known& known, const std::vector<AxisChoice>& choices) {
  const YAML::Node* node = file.find("fragility");
  Section section(node ? *node : YAML::Node(YAML::NodeType::Map), "fragility", file.line("fragility"), file.problems());
  FragilityPart part;
  part.im = read_intensity(section, known);
  part.bins = read_bins(section, "bins", default_bins);
  part.edp = read_edps(section, known);
  part.capacities = read_capacities(section, known, part.edp, part.damage);
  read_damage(section, known, part);
  part.axes = read_axes(section, choices);
  part.target = read_target(section);
  part.resamples =
      static_cast<int>(section.integer("resamples", 500, fragility::least_resamples, fragility::most_resamples));
  part.confidence = section.number("confidence", 0.95, {.lower = 0, .upper = 1, .why = "it must lie between 0 and 1"});
  part.minimum_samples =
      static_cast<int>(section.integer("minimum_samples", 30, fragility::least_minimum_samples, 1000000));
  part.false_discovery =
      section.number("false_discovery", 0.05, {.lower = 0, .upper = 1, .why = "it must lie between 0 and 1"});
  part.adequate = section.number("adequate", 0.05, {.lower = 0, .upper = 1, .why = "it is an error of probabilities"});
  part.still = read_still(section, known, part);
  part.empirical_fallback = section.flag("empirical_fallback", true);
  section.finish();
  return part;
}

}  // namespace freestand::study
