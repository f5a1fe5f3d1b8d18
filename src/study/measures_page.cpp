#include "study/measures_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "edp/edp.hpp"
#include "intensity/intensity.hpp"
#include "study/problems.hpp"

namespace freestand::study {
namespace {

using edp::Edp;
using intensity::Measure;
using nlohmann::ordered_json;

std::vector<const Edp*> demands() {
  std::vector<const Edp*> all;
  for (const Edp& edp : edp::all()) all.push_back(&edp);
  return all;
}

// The entry of that name among all, or throws.
template <class Entry>
const Entry& named(const std::vector<const Entry*>& all, const std::string& name, const char* kind, const char* verb) {
  std::vector<std::string> names;
  for (const Entry* entry : all) {
    if (entry->name == name) return *entry;
    names.push_back(entry->name);
  }
  if constexpr (std::is_same_v<Entry, Measure>)
    if (name.starts_with("record.") || name.starts_with("ground.")) return intensity::find(name);
  throw Error(
      fmt::format("{} {} is not in the catalogue ({}): see `freestand {}`", kind, name, hint(name, names), verb));
}

template <class Entry>
std::string list(const std::vector<const Entry*>& all, const std::string& note) {
  std::size_t name = 0, unit = 0;
  for (const Entry* entry : all) {
    name = std::max(name, entry->name.size());
    unit = std::max(unit, entry->unit.size());
  }
  std::string text;
  for (const Entry* entry : all)
    text += fmt::format("{:<{}}  {:<{}}  {}\n", entry->name, name, entry->unit, unit, entry->summary);
  return text + "\n" + note;
}

std::string line(const std::string& label, const std::string& text) { return fmt::format("  {:<11}{}\n", label, text); }

std::string page(const Measure& im) {
  std::string text = fmt::format("{}: {}\n", im.name, im.summary) + line("symbol", im.symbol) + line("unit", im.unit);
  std::string study = im.name, fit = im.name;
  if (im.parameter) {
    text += line("takes", fmt::format("{}, {} where none is given", im.parameter->name, im.parameter->fallback));
    study = fmt::format("{{name: {}, {}: {}}}", im.name, im.parameter->name, 0.5);
    fit += ":0.5";
  }
  return text + line("source", im.source) + line("study", fmt::format("fragility: {{im: {}}}", study)) +
         line("afterwards", fmt::format("freestand fit DIR --im {} -o DIR2", fit));
}

ordered_json json(const Measure& im) {
  ordered_json json = {
      {"name", im.name}, {"unit", im.unit}, {"symbol", im.symbol}, {"summary", im.summary}, {"source", im.source}};
  json["parameter"] =
      im.parameter ? ordered_json{{"name", im.parameter->name}, {"default", im.parameter->fallback}} : ordered_json();
  return json;
}

// What stands beside the demand in a study.
const char* needed(edp::Wants wants) {
  constexpr const char* keys[] = {
      "",
      "slip_by_side: true, ",
      "effects: [{name: wall_impact, gap_m: 0.05}], ",
      "chain: {stiffness_npm: 36000, strength_n: 2700}, ",
      "acceleration_height_m: 1.5, ",
      "contact_forces: true, ",
      "contact_forces: true, chain: {stiffness_npm: 36000, strength_n: 2700}, ",
      "contact_forces: true, effects: [{name: moving_contents, mass_ratio: 0.2, frequency_hz: 3}], ",
      "contact_forces: true, effects: [{name: flexible_legs, frequency_hz: 5}], "};
  return keys[static_cast<int>(wants)];
}

std::string page(const Edp& edp) {
  std::string text =
      fmt::format("{}: {}\n", edp.name, edp.summary) + line("symbol", edp.symbol) + line("unit", edp.unit);
  if (edp.binary)
    text += line("happens", "or not: it takes no capacities");
  else
    text +=
        line("still", edp.still > 0 ? fmt::format("up to {} {}", edp.still, edp.unit == "1" ? "" : edp.unit) : "at 0");
  if (!edp.binary)
    text += line("capacities", edp.default_capacities.empty()
                                   ? "none by themselves: a study has to give them"
                                   : fmt::format("{} where none are given", fmt::join(edp.default_capacities, ", ")));
  if (edp.censored) text += line("overturned", "it has no value then, and counts as above every capacity");
  text += line("fitted", edp.by_default ? "where a study names no demands, and where it names this one"
                                        : "where a study names it");
  return text + line("source", edp.source) +
         line("study", fmt::format("{}fragility: {{edp: [{}]}}", needed(edp.wants), edp.name)) +
         line("afterwards", fmt::format("freestand fit DIR --edp {} -o DIR2", edp.name));
}

ordered_json json(const Edp& edp) {
  return {{"name", edp.name},
          {"unit", edp.unit},
          {"symbol", edp.symbol},
          {"summary", edp.summary},
          {"source", edp.source},
          {"binary", edp.binary},
          {"censored", edp.censored},
          {"still", edp.still},
          {"by_side", edp.wants == edp::Wants::sides},
          {"by_default", edp.by_default},
          {"default_capacities", edp.default_capacities}};
}

template <class Entry>
MeasurePages catalogue(std::vector<const Entry*> all, const char* kind, const char* verb, const std::string& note) {
  return {[=](const std::string& name) { return name.empty() ? list(all, note) : page(named(all, name, kind, verb)); },
          [=](const std::string& name) {
            if (!name.empty()) return json(named(all, name, kind, verb)).dump(2) + "\n";
            auto array = ordered_json::array();
            for (const Entry* entry : all) array.push_back(json(*entry));
            return array.dump(2) + "\n";
          }};
}

}  // namespace

MeasurePages intensities_catalogue() {
  return catalogue(
      intensity::all(), "intensity", "im",
      "`freestand im NAME` tells more. A finished sweep holds all of them: `freestand fit DIR --im NAME -o "
      "DIR2`\nneeds no new one.\nA table of records (`records: INDEX.csv`) adds its own columns as record.COLUMN: "
      "record.pga_g, record.magnitude_mw.\nWhere "
      "records go through a building (`building`, `storey`), those of the ground under it are there too: ground.pga_g, "
      "ground.sa_g.\n");
}

MeasurePages demands_catalogue() {
  return catalogue(
      demands(), "demand", "edp",
      "`freestand edp NAME` tells more. A finished sweep holds all of them that its study asks for: those by side are "
      "followed "
      "where it says\nslip_by_side, those of forces with contact_forces, of a height with acceleration_height_m. "
      "`freestand fit DIR --edp NAME -o DIR2`\nneeds no new sweep for what was followed.\n");
}

}  // namespace freestand::study
