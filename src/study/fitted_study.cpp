#include "study/fitted_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measurement/predict/placements.hpp"
#include "study/calibrate_keys.hpp"
#include "study/paths.hpp"
#include "study/posterior_tables.hpp"

namespace freestand::study {
namespace {

using namespace measurement;

std::string number(double value) { return fmt::format("{}", value); }

std::vector<FittedNumber> numbers_of(const ModelFit& fit, const std::string& table) {
  std::vector<FittedNumber> numbers;
  for (std::size_t i = 0; i < fit.x.size(); ++i) {
    numbers.push_back({.name = fit.model.free[i].name, .value = fit.x[i], .drawn_from = table});
    if (const auto known = interval_of(fit, i))
      numbers.back().lower = known->lower, numbers.back().upper = known->upper;
  }
  return numbers;
}

}  // namespace

void write_block(YAML::Node root, const Prepared& p) {
  YAML::Node model = root["model"];
  const Dimensions& d = p.data.specimen;
  const bool own =
      std::any_of(p.data.tests.begin(), p.data.tests.end(), [&](const Test& t) { return t.specimen != d; });
  if (own) return;
  YAML::Node block = model["block"];
  if (!block) model["block"] = block = YAML::Node(YAML::NodeType::Map);
  if (!p.validation.width_given && d.width_m) block["width_m"] = number(*d.width_m);
  if (!p.validation.height_given && d.height_m) block["height_m"] = number(*d.height_m);
  if (!p.validation.mass_given && d.mass_kg) block["mass_kg"] = number(*d.mass_kg);
  if (!p.validation.model.block.centre_height && d.centre_height_m)
    block["centre_height_m"] = number(*d.centre_height_m);
  if (!p.validation.model.block.gyration_radius && !p.validation.model.block.inertia && d.gyration_radius_m)
    block["gyration_radius_m"] = number(*d.gyration_radius_m);
  block.SetStyle(YAML::EmitterStyle::Flow);
}

void name_placement_scatter(YAML::Node root, const Prepared& p) {
  YAML::Node model = root["model"];
  if (!p.model.placement_scatter || model["placement_scatter"]) return;
  const Free& free = p.model.free[static_cast<std::size_t>(p.model.placement_scatter->free)];
  model["placement_scatter"] = calibrate_node(free.lower, free.upper);
}

std::optional<KnownMiddle> known_middle(const Prepared& p) {
  if (scatter_number(p.model) < 0 || placement_number(p.model) >= 0) return {};
  if (p.model.slenderness && p.model.size) return KnownMiddle{"slenderness_rad", p.model.slenderness->value};
  if (p.model.width) return KnownMiddle{"width_m", p.model.width->value};
  const Dimensions& d = p.data.specimen;
  if (!d.width_m || std::ranges::any_of(p.data.tests, [&](const Test& t) { return t.specimen != d; })) return {};
  return KnownMiddle{"width_m", *d.width_m};
}

void write_numbers(YAML::Node root, const ModelFit& fit, const std::string& table) {
  add_missing_parameters(root["model"]);  // of effects that are named alone
  write_fitted(root["model"], "", numbers_of(fit, table));
}

std::string study_text(YAML::Node root) {
  root.SetStyle(YAML::EmitterStyle::Block);
  root["model"].SetStyle(YAML::EmitterStyle::Block);
  for (auto pair : root["model"])
    if (pair.second.IsMap()) pair.second.SetStyle(YAML::EmitterStyle::Flow);
  if (!root["model"]["effects"]) root["model"]["effects"] = YAML::Node(YAML::NodeType::Sequence);
  if (root["model"]["effects"].size() > 0) root["model"]["effects"].SetStyle(YAML::EmitterStyle::Block);
  for (auto effect : root["model"]["effects"]) effect.SetStyle(YAML::EmitterStyle::Flow);
  YAML::Emitter out;
  out << root;
  return std::string(out.c_str()) + "\n";
}

void write_paths(YAML::Node root, const Prepared& p, const std::filesystem::path& folder) {
  const std::filesystem::path& start = p.validation.folder;
  if (p.measurements != p.validation.measurements)
    root["measurements"] = std::filesystem::proximate(p.measurements, start.empty() ? "." : start).generic_string();
  root.remove("paths_from");
  const std::string way = way_between(folder, start);
  if (!way.empty()) root["paths_from"] = way;
}

std::string fitted_study(const Prepared& p, const ModelFit& fit, const Posterior& open,
                         const std::filesystem::path& folder) {
  YAML::Node root = YAML::Load(p.validation.text);
  write_block(root, p);
  name_placement_scatter(root, p);
  write_numbers(root, fit, open.draws.empty() ? "" : posterior_table);
  if (const auto middle = known_middle(p); middle && !open.draws.empty())
    root["model"]["placement_scatter"]["placed"] = middle->column();
  root["model"].remove("discrepancy");
  if (open.slip_scatter_ln > 0) {
    YAML::Node slip;
    slip["median"] = fmt::format("{:.4g}", std::exp(open.slip_bias_ln));
    slip["dispersion"] = fmt::format("{:.4g}", open.slip_scatter_ln);
    root["model"]["discrepancy"]["slip"]["lognormal"] = slip;
  }
  write_paths(root, p, folder);
  return study_text(root);
}

}  // namespace freestand::study
