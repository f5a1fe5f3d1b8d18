#include "study/fragility_changes.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <regex>

#include "intensity/intensity.hpp"
#include "study/known.hpp"
#include "study/problems.hpp"

namespace freestand::study {
namespace {

constexpr const char* said_by = "command line";

YAML::Node loaded(const std::string& text, const std::string& option) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& why) {
    throw Error(fmt::format("{}: {} {} cannot be read ({}): see freestand fit --help", said_by, option, text, why.msg));
  }
}

YAML::Node list_of(const std::string& commas, const std::string& option) { return loaded("[" + commas + "]", option); }

YAML::Node intensity_node(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return YAML::Node(text);
  const std::string name = text.substr(0, colon);
  const intensity::Measure& measure = intensity::find(name);
  if (!measure.parameter) {
    std::vector<std::string> with;
    for (const intensity::Measure* one : intensity::all())
      if (one->parameter) with.push_back(one->name);
    throw Error(
        fmt::format("{}: --im {} has a number (only {} takes one): write --im {}", said_by, text, joined(with), name));
  }
  YAML::Node node;
  node["name"] = name;
  node[measure.parameter->name] = text.substr(colon + 1);
  return node;
}

YAML::Node bins_node(const std::string& text) {
  YAML::Node node;
  if (text.find_first_not_of("0123456789") == std::string::npos)
    node["count"] = text;
  else if (text.starts_with("{"))
    node = loaded(text, "--bins");
  else
    node["edges"] = list_of(text, "--bins");
  return node;
}

bool in_units_of_the_intensity(const BinsPart& bins) { return !bins.edges.empty() || bins.width > 0; }

// The entries of demands that stay, of a map by demand.
YAML::Node of_demands(const YAML::Node& before, const std::vector<std::string>& edps) {
  YAML::Node after(YAML::NodeType::Map);
  for (const auto& entry : before) {
    const std::string edp = entry.first.Scalar();
    if (edps.empty() || std::find(edps.begin(), edps.end(), edp) != edps.end()) after[edp] = entry.second;
  }
  return after;
}

// The threshold of standing still goes with the capacities.
void change_capacities(YAML::Node fragility, const FragilityChanges& changes) {
  YAML::Node capacities = of_demands(fragility["capacities"], changes.edp),
             still = of_demands(fragility["still"], changes.edp);
  for (const std::string& text : changes.capacities) {
    if (text.starts_with("{")) {  // as a study has them
      for (const auto& entry : loaded(text, "--capacities")) {
        capacities[entry.first.Scalar()] = entry.second;
        still.remove(entry.first.Scalar());
      }
      continue;
    }
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw Error(
          fmt::format("{}: --capacities {} names no demand (whose capacities are these?): write --capacities "
                      "peak_slip_m=0.05,0.1",
                      said_by, text));
    const std::string edp = text.substr(0, equals);
    capacities[edp] = list_of(text.substr(equals + 1), "--capacities");
    still.remove(edp);
  }
  fragility["capacities"] = capacities;
  fragility["still"] = still;
}

void change_target(YAML::Node fragility, const std::vector<std::string>& target) {
  for (const std::string& text : target) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw Error(
          fmt::format("{}: --target {} gives nothing to a number (how is it distributed?): write --target "
                      "\"friction.mu_k={{lognormal: {{median: 0.3, dispersion: 0.2}}}}\"",
                      said_by, text));
    fragility["target"][text.substr(0, equals)] = loaded(text.substr(equals + 1), "--target");
  }
}

// What is wrong is in no line of a file.
std::string without_lines(const std::string& text) {
  static const std::regex line(std::string("^") + said_by + ":[0-9]+:", std::regex::multiline);
  return std::regex_replace(text, line, std::string(said_by) + ":");
}

}  // namespace

std::vector<std::string> FragilityChanges::keys() const {
  std::vector<std::string> found;
  for (const auto& [given, key] : {std::pair(!bins.empty(), "bins"), std::pair(!capacities.empty(), "capacities"),
                                   std::pair(confidence.has_value(), "confidence"), std::pair(!edp.empty(), "edp"),
                                   std::pair(!im.empty(), "im"), std::pair(!target.empty(), "target")})
    if (given) found.push_back(std::string("fragility.") + key);
  return found;
}

Study with_changes(const Study& study, const FragilityChanges& changes) {
  if (!changes.any()) return study;
  YAML::Node root = YAML::Load(expanded(study));
  YAML::Node fragility = root["fragility"];
  if (!changes.im.empty()) fragility["im"] = intensity_node(changes.im);
  if (!changes.bins.empty())
    fragility["bins"] = bins_node(changes.bins);
  else if (!changes.im.empty() && in_units_of_the_intensity(study.fragility.bins))
    fragility.remove("bins");
  if (!changes.edp.empty()) fragility["edp"] = changes.edp;
  change_capacities(fragility, changes);
  change_target(fragility, changes.target);
  if (changes.confidence) fragility["confidence"] = sampling::number_text(*changes.confidence);
  YAML::Emitter out;
  out << root;
  try {
    Study changed = parse_stored(out.c_str(), said_by);
    changed.folder = study.folder;
    return changed;
  } catch (const Error& error) {
    throw Error(without_lines(error.what()), error.exit());
  }
}

std::string described(const IntensityPart& im) {
  return im.period_s ? fmt::format("{} at {} s", im.name, sampling::number_text(*im.period_s)) : im.name;
}

std::string short_name(const IntensityPart& im) {
  return im.period_s ? fmt::format("{}:{}", im.name, sampling::number_text(*im.period_s)) : im.name;
}

}  // namespace freestand::study
