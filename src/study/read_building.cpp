#include "study/read_building.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "study/named_file.hpp"
#include "study/read_parts.hpp"
#include "study/yaml_text.hpp"

namespace freestand::study {
namespace {

using motion::Building;
using motion::Storey;

constexpr std::uint64_t most_storeys = 200;

const std::vector<std::string> stiffness_words = {"equal", "straight_first_mode"};

void read_storey(const YAML::Node& node, const std::string& name, int line, Problems& problems, Building& building) {
  Section section(node, name, line, problems);
  Storey storey;
  storey.mass_kg = section.optional_number("mass_kg", range::positive);
  storey.height_m = section.optional_number("height_m", range::positive);
  storey.stiffness_npm = section.optional_number("stiffness_npm", range::positive);
  const std::uint64_t count = section.integer("count", 1, 1, most_storeys);
  section.finish();
  building.storeys.insert(building.storeys.end(), count, storey);
}

// A number of storeys that are alike, or a list of them, the lowest first.
void read_storeys(Section& section, Building& building) {
  const YAML::Node* node = section.find("storeys");
  if (node && node->IsSequence()) {
    if (lacks_braces(*node, section.name("storeys"), section.line("storeys"), section.problems())) return;
    for (std::size_t i = 0; i < node->size(); ++i)
      read_storey((*node)[i], fmt::format("{}[{}]", section.name("storeys"), i),
                  line_of((*node)[i]) ? line_of((*node)[i]) : section.line("storeys"), section.problems(), building);
  } else if (node) {
    building.storeys.resize(section.integer("storeys", 1, 1, most_storeys));
  } else if (!section.has("storeys")) {
    section.problem("storeys", section.name("storeys") +
                                   " is missing (how many floors are there?): write storeys: 5, or a list, the lowest "
                                   "first, [{mass_kg: 4e5, stiffness_npm: 3e8}]");
  }
  if (building.storeys.size() > most_storeys)
    section.problem("storeys", fmt::format("{} has {} storeys (more than {}): is that meant?", section.name("storeys"),
                                           building.storeys.size(), most_storeys));
}

void read_rayleigh(Section& section, Building& building) {
  if (!section.find("rayleigh_modes")) return;
  const std::vector<double> modes = section.numbers("rayleigh_modes");
  if (modes.size() == 2 && modes[0] == std::floor(modes[0]) && modes[1] == std::floor(modes[1]) &&
      std::abs(modes[0]) < 1e6 && std::abs(modes[1]) < 1e6)
    building.rayleigh_modes = {static_cast<int>(modes[0]), static_cast<int>(modes[1])};
  else
    section.problem("rayleigh_modes",
                    section.name("rayleigh_modes") + " is no pair of modes (the damping is that of two): write [1, 2]");
}

// A number, or the median of a distribution, which is kept.
std::optional<double> read_number(Section& section, const std::string& key, const Range& range,
                                  std::optional<Quantity>& kept) {
  const auto quantity = section.quantity("building", key, range);
  if (!quantity) return {};
  if (!is_fixed(quantity->value)) kept = quantity;
  return sampling::quantile(quantity->value, 0.5);
}

BuildingPart read_mapping(const YAML::Node& node, const std::string& path, int line, Problems& problems,
                          const std::string& name) {
  const std::size_t before = problems.count();
  Section section(node, path, line, problems);
  BuildingPart building;
  building.name = section.text("name", name);
  read_storeys(section, building);
  building.period_s = read_number(section, "period_s", range::positive, building.drawn_period);
  building.stiffness = static_cast<Building::Stiffness>(section.choice("stiffness", stiffness_words, 0));
  const Range share = {
      .lower = 0, .upper = 1, .why = "it is a share of critical damping; without any a floor never comes to rest"};
  building.damping = read_number(section, "damping", share, building.drawn_damping).value_or(building.damping);
  read_rayleigh(section, building);
  section.finish();
  if (problems.count() > before) return building;
  try {
    motion::modes(building);
  } catch (const Error& error) {
    problems.add(line, (path.empty() ? "" : path + ": ") + error.what());
  }
  return building;
}

BuildingPart read_file(const std::filesystem::path& file, Problems& problems) {
  const auto root = parse_yaml(read_text(file), problems);
  return root ? read_mapping(*root, "", 1, problems, file.stem().string()) : BuildingPart{};
}

void check_storeys(Section& section, const MotionSource& source) {
  const Quantity& storey = *source.storey;
  const std::string name = section.name("storey");
  const int floors = source.building->floors();
  if (!is_fixed(storey.value) && !std::holds_alternative<sampling::Choice>(storey.value))
    return section.problem("storey", fmt::format("{} is {} (equipment stands on whole storeys): give a number, or "
                                                 "{{choice: [1, 2, 3]}}",
                                                 name, to_string(storey.value)));
  for (const int floor : source.storeys())
    if (floor < 0 || floor > floors)
      section.problem("storey", fmt::format("{} is {} (the building has {} floors above the ground, and 0 is the "
                                            "ground): name a whole number from 0 to {}",
                                            name, to_string(storey.value), floors, floors));
}

}  // namespace

bool in_a_building(const Study& study) {
  return std::any_of(study.motions.begin(), study.motions.end(),
                     [](const MotionSource& source) { return source.building.has_value(); });
}

bool is_of_a_floor(const std::string& im, const Study& study) {
  const bool upstairs = std::any_of(study.motions.begin(), study.motions.end(), [](const MotionSource& source) {
    const std::vector<int> storeys = source.storeys();
    return std::any_of(storeys.begin(), storeys.end(), [](int storey) { return storey != 0; });
  });
  return upstairs && !im.starts_with("ground.") && !im.starts_with("record.");
}

std::vector<int> MotionSource::storeys() const {
  std::vector<double> values;
  if (storey && is_fixed(storey->value)) values = {std::get<sampling::Fixed>(storey->value).value};
  if (storey && std::holds_alternative<sampling::Choice>(storey->value))
    values = std::get<sampling::Choice>(storey->value).values;
  std::vector<int> floors;
  for (const double value : values)
    floors.push_back(value == std::floor(value) && std::abs(value) < 1e6 ? static_cast<int>(value) : -1);
  return floors;
}

void read_building(Section& section, MotionSource& source, const std::filesystem::path& folder, Files look) {
  const std::size_t before = section.problems().count();
  const YAML::Node* node = section.find("building");
  source.storey = section.quantity("motion", "storey", range::any);
  if (node && node->IsScalar() && look == Files::look)
    source.building = read_named_file(section, "building", folder / section.text("building", ""), read_building_file);
  else if (node && !node->IsScalar())
    source.building =
        read_mapping(*node, section.name("building"), section.line("building"), section.problems(), "building");
  if (node && !section.has("storey"))
    section.problem("storey", section.name("storey") +
                                  " is missing (on which floor of the building does the equipment stand?): add storey: "
                                  "3, counted from the ground, which is 0");
  if (source.storey && !section.has("building"))
    section.problem("storey",
                    section.name("storey") +
                        " is of no building (nothing lies between the ground and the equipment): add building, "
                        "or remove it");
  if (source.building && source.building->drawn_period)
    source.numbers.push_back(motion::record_number("building_period_s").value());
  if (source.building && source.building->drawn_damping)
    source.numbers.push_back(motion::record_number("building_damping").value());
  if (source.building && source.storey && section.problems().count() == before) check_storeys(section, source);
}

BuildingPart read_building_file(const std::filesystem::path& file) {
  Problems problems(file.string());
  BuildingPart building = read_file(file, problems);
  problems.throw_if_any();
  return building;
}

std::string building_text(const BuildingPart& building) {
  using sampling::number_text;
  const auto written = [](const std::optional<Quantity>& drawn, double number) {
    return drawn ? to_string(drawn->value) : number_text(number);
  };
  std::vector<std::string> storeys;
  bool alike = true;
  for (const Storey& storey : building.storeys) {
    std::vector<std::string> entries;
    for (const auto& [key, value] : {std::pair("mass_kg", storey.mass_kg), std::pair("height_m", storey.height_m),
                                     std::pair("stiffness_npm", storey.stiffness_npm)})
      if (value) entries.push_back(fmt::format("{}: {}", key, number_text(*value)));
    alike = alike && entries.empty();
    storeys.push_back(fmt::format("{{{}}}", fmt::join(entries, ", ")));
  }
  std::string text = fmt::format("{{name: {}, storeys: ", yaml_text(building.name));
  text += alike ? fmt::format("{}", storeys.size()) : fmt::format("[{}]", fmt::join(storeys, ", "));
  if (building.period_s)
    text += fmt::format(", period_s: {}, stiffness: {}", written(building.drawn_period, *building.period_s),
                        stiffness_words[static_cast<std::size_t>(building.stiffness)]);
  text += fmt::format(", damping: {}", written(building.drawn_damping, building.damping));
  if (building.rayleigh_modes)
    text += fmt::format(", rayleigh_modes: [{}, {}]", building.rayleigh_modes->first, building.rayleigh_modes->second);
  return text + "}";
}

}  // namespace freestand::study
