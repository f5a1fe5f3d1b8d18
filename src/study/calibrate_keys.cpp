#include "study/calibrate_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "effects/effects.hpp"
#include "measurement/predict/placements.hpp"
#include "study/section.hpp"

namespace freestand::study {
namespace {

bool is_calibrate(const YAML::Node& node) { return node.IsMap() && node["calibrate"]; }

// The middle, of the logarithm where the range spans much.
double middle(double lower, double upper) {
  return lower > 0 && upper / lower >= 4 ? std::sqrt(lower * upper) : 0.5 * (lower + upper);
}

Calibrated read_one(const YAML::Node& node, const std::string& name, int line, Problems& problems) {
  Section section(node, name, line, problems);
  const std::vector<double> range = section.numbers("calibrate");
  Calibrated c{.name = name, .lower = 0, .upper = 1, .value = section.optional_number("value"), .interval = {}};
  if (section.has("interval")) c.interval = section.numbers("interval");
  for (const char* of_sweeps : {"posterior", "column", "placed"}) section.text(of_sweeps, "");
  section.finish();
  if (range.size() == 2 && range[0] < range[1]) {
    c.lower = range[0];
    c.upper = range[1];
  } else {
    problems.add(line, fmt::format("{}.calibrate is no range (a fit needs a least and a greatest value): write "
                                   "calibrate: [lower, upper]",
                                   name));
  }
  if (c.value && (*c.value < c.lower || *c.value > c.upper))
    problems.add(line, fmt::format("{}.value lies outside its range (it was fitted between {} and {}): correct one",
                                   name, c.lower, c.upper));
  return c;
}

// `name`: dotted, as quantities are named: entries of `effects` by the effect's name, `parameters` of formulas left out.
void walk(YAML::Node node, const std::string& name, int line, std::vector<Calibrated>& found, Problems& problems) {
  if (node.IsMap()) {
    std::vector<std::string> keys;
    for (const auto& pair : node) keys.push_back(pair.first.Scalar());
    for (const auto& key : keys) {
      const YAML::Node value = node[key];
      const int here = line_of(value) ? line_of(value) : line;
      const std::string inner = key == "parameters" ? name : name.empty() ? key : name + "." + key;
      if (is_calibrate(value)) {
        found.push_back(read_one(value, inner, here, problems));
        node[key] = fmt::format("{}", found.back().value.value_or(middle(found.back().lower, found.back().upper)));
      } else {
        walk(value, inner, here, found, problems);
      }
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string entry = node[i].IsMap() && node[i]["name"] ? node[i]["name"].as<std::string>("") : "";
      walk(node[i], name + "." + entry, line, found, problems);
    }
  }
}

// Numbers with a table of joint draws become a distribution.
void leave_to_draws(YAML::Node node) {
  if (node.IsMap()) {
    std::vector<std::string> keys;
    for (const auto& pair : node) keys.push_back(pair.first.Scalar());
    for (const auto& key : keys) {
      YAML::Node value = node[key];
      if (is_calibrate(value) && value["posterior"])
        for (const char* of_fit : {"calibrate", "value", "interval"}) value.remove(of_fit);
      else
        leave_to_draws(value);
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) leave_to_draws(node[i]);
  }
}

}  // namespace

std::vector<Calibrated> take_calibrated(YAML::Node model, Problems& problems) {
  std::vector<Calibrated> found;
  walk(model, "", line_of(model), found, problems);
  return found;
}

YAML::Node calibrate_node(double lower, double upper) {
  YAML::Node node(YAML::NodeType::Map);
  for (const double end : {lower, upper}) node["calibrate"].push_back(fmt::format("{}", end));
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

void add_missing_parameters(YAML::Node model) {
  YAML::Node list = model["effects"];
  if (!list || !list.IsSequence()) return;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].IsScalar()) {
      YAML::Node entry(YAML::NodeType::Map);
      entry["name"] = list[i].Scalar();
      list[i] = entry;
    }
    YAML::Node entry = list[i];
    const dynamics::Effect* effect =
        entry.IsMap() && entry["name"] ? effects::find(entry["name"].as<std::string>("")) : nullptr;
    if (!effect) continue;
    for (const auto& parameter : effect->parameters) {
      if (entry[parameter.name] || parameter.fallback) continue;
      YAML::Node range(YAML::NodeType::Map);
      range["calibrate"].push_back(parameter.low);
      range["calibrate"].push_back(parameter.high);
      entry[parameter.name] = range;
    }
  }
}

namespace {

// Of tests of which only the outcome is known: the width, or the slenderness, scatters from test to test about the model's, and so from
// sample to sample of a sweep. Where it was fitted, its joint draws hold that already.
void scatter_placements(YAML::Node block, double scatter) {
  if (!block || !block.IsMap() || !(scatter > 0)) return;
  for (const char* key : {"slenderness_rad", "width_m"}) {
    if (!block[key] || !block[key].IsScalar()) continue;
    YAML::Node spread(YAML::NodeType::Map);
    spread["lognormal"]["median"] = block[key].Scalar();
    spread["lognormal"]["dispersion"] = fmt::format("{:.6g}", scatter);
    if (std::string_view(key) == "slenderness_rad")
      spread["lognormal"]["max"] = fmt::format("{}", measurement::steepest_rad);
    block[key] = spread;
    return;
  }
}

// Where the joint draws hold the dimension itself beside its scatter, which was fitted.
void draw_placements(YAML::Node block, const YAML::Node& scatter) {
  const std::string column = scatter["placed"].Scalar();
  YAML::Node drawn(YAML::NodeType::Map);
  drawn["posterior"] = scatter["posterior"].Scalar();
  drawn["column"] = column;
  if (block && block.IsMap()) block[column.substr(column.find('.') + 1)] = drawn;
}

}  // namespace

void sweep_model(YAML::Node root, Problems& problems, FittedAs fitted) {
  if (!root.IsMap() || !root["model"] || !root["model"].IsMap()) return;
  YAML::Node model = root["model"];
  add_missing_parameters(model);
  YAML::Node scatter = model["placement_scatter"];
  if (fitted == FittedAs::draws && scatter && scatter.IsMap() && scatter["placed"]) {
    draw_placements(model["block"], scatter);
    model.remove("placement_scatter");
    scatter = YAML::Node();
  }
  if (scatter && scatter.IsMap() && scatter["value"]) model["placement_scatter"] = scatter = scatter["value"];
  if (fitted == FittedAs::draws) leave_to_draws(model);
  for (const Calibrated& c : take_calibrated(model, problems))
    if (!c.value && c.name != "placement_scatter")
      problems.add(0, fmt::format("{} is not fitted yet (a sweep needs its value): run DIR/fitted.yaml of `freestand "
                                  "compare STUDY -o DIR`, or give "
                                  "a number",
                                  c.name));
  if (scatter && scatter.IsScalar()) scatter_placements(model["block"], scatter.as<double>(0));
  for (const char* key : {"model", "measurements", "ladder"}) root.remove(key);
  for (const auto& pair : model)
    if (pair.first.Scalar() != "placement_scatter") root[pair.first] = pair.second;
}

void write_fitted(YAML::Node node, const std::string& name, const std::vector<FittedNumber>& numbers) {
  if (node.IsMap()) {
    for (auto pair : node) {
      const std::string key = pair.first.Scalar();
      const std::string inner = key == "parameters" ? name : name.empty() ? key : name + "." + key;
      YAML::Node value = pair.second;
      if (!is_calibrate(value)) {
        write_fitted(value, inner, numbers);
        continue;
      }
      for (const FittedNumber& number : numbers) {
        if (number.name != inner) continue;
        value["value"] = fmt::format("{}", number.value);
        for (const char* before : {"interval", "posterior", "column"}) value.remove(before);
        if (number.lower < number.upper) {
          value["interval"].push_back(fmt::format("{:.9g}", number.lower));
          value["interval"].push_back(fmt::format("{:.9g}", number.upper));
        }
        if (!number.drawn_from.empty()) {
          value["posterior"] = number.drawn_from;
          value["column"] = number.name;
        }
        value.SetStyle(YAML::EmitterStyle::Flow);
      }
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string entry = node[i].IsMap() && node[i]["name"] ? node[i]["name"].as<std::string>("") : "";
      write_fitted(node[i], name + "." + entry, numbers);
    }
  }
}

}  // namespace freestand::study
