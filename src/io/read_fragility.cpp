#include <freestand/error.hpp>

#include "io/bin_fields.hpp"
#include "io/fragility_file.hpp"

namespace freestand::io {
namespace {

using fragility::AxisSurface;
using fragility::EdpResult;
using fragility::FragilityFunction;
using fragility::Result;
using h5::Group;

std::vector<double> values(const Group& group, const std::string& name) { return group.open_dataset(name).read(); }

std::vector<std::int64_t> whole(const Group& group, const std::string& name) {
  const std::vector<double> read = values(group, name);
  return {read.begin(), read.end()};
}

void read_bins(const Group& group, EdpResult& edp, std::size_t bins) {
  edp.bins.resize(bins);
  for (const BinField& field : bin_fields()) {
    const std::vector<double> read = values(group, field.name);
    for (std::size_t i = 0; i < bins; ++i) field.set(edp.bins[i], read.at(i));
  }
}

void read_curve(const Group& group, std::vector<double> FragilityFunction::*to, const char* name,
                std::vector<FragilityFunction>& curves) {
  const std::vector<double> read = values(group, name);
  const auto width = static_cast<std::ptrdiff_t>(read.size() / curves.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto row = read.begin() + static_cast<std::ptrdiff_t>(c) * width;
    (curves[c].*to).assign(row, row + width);
  }
}

void read_curves(const Group& group, std::vector<FragilityFunction>& curves) {
  read_curve(group, &FragilityFunction::probability, "probability", curves);
  read_curve(group, &FragilityFunction::lower, "lower", curves);
  read_curve(group, &FragilityFunction::upper, "upper", curves);
  read_curve(group, &FragilityFunction::resampled_median, "resampled_median", curves);
  read_curve(group, &FragilityFunction::resampled_dispersion, "resampled_dispersion", curves);
  if (group.has("left_out_median")) {
    read_curve(group, &FragilityFunction::left_out_median, "left_out_median", curves);
    read_curve(group, &FragilityFunction::left_out_dispersion, "left_out_dispersion", curves);
  }
  for (FragilityFunction& curve : curves) curve.grid = values(group, "grid");
}

void read_functions(const Group& group, EdpResult& edp) {
  edp.functions.resize(edp.capacity.size());
  for (const FunctionField& field : function_fields()) {
    const std::vector<double> read = values(group, field.name);
    for (std::size_t c = 0; c < edp.functions.size(); ++c) field.set(edp.functions[c], read.at(c));
  }
  read_curves(group, edp.functions);
}

AxisSurface read_axis(const Group& group, const std::string& name) {
  return {name,
          group.text_attribute("unit"),
          values(group, "edge"),
          values(group, "centre"),
          values(group, "probability"),
          values(group, "lower"),
          values(group, "upper"),
          whole(group, "n")};
}

EdpResult read_edp(const Group& group, const std::string& name, std::size_t bins) {
  EdpResult edp;
  edp.name = name;
  edp.unit = group.text_attribute("unit");
  edp.symbol = group.text_attribute("symbol");
  edp.binary = group.text_attribute("kind") == "binary";
  edp.regressions.n = group.integer_attribute("regression_n");
  for (const RegressionField& field : regression_fields())
    edp.regressions.*field.value = group.real_attribute(field.name);
  edp.capacity = values(group, "capacity");
  read_bins(group, edp, bins);
  const Group surface = group.open_group("surface");
  edp.surface = {values(surface, "probability"),
                 values(surface, "lower"),
                 values(surface, "upper"),
                 values(surface, "empirical"),
                 values(surface, "least"),
                 values(surface, "most"),
                 surface.has("resampled") ? values(surface, "resampled") : std::vector<double>{},
                 surface.has("probability_left_out") ? values(surface, "probability_left_out") : std::vector<double>{}};
  if (group.has("functions")) read_functions(group.open_group("functions"), edp);
  if (group.has("distribution")) {
    const Group distribution = group.open_group("distribution");
    edp.distribution = {values(distribution, "ln_edge"), whole(distribution, "count")};
  }
  if (!group.has("axis")) return edp;
  const Group axes = group.open_group("axis");
  for (const std::string& axis : axes.names()) edp.axes.push_back(read_axis(axes.open_group(axis), axis));
  return edp;
}

FragilityFunction read_overturning(const Group& group) {
  std::vector<FragilityFunction> curves(1);
  for (const FunctionField& field : function_fields()) field.set(curves[0], group.real_attribute(field.name));
  read_curves(group, curves);
  return curves[0];
}

}  // namespace

FragilityFile read_fragility(const std::filesystem::path& path) {
  const h5::File file = h5::File::open(path);
  const Group root = file.root();
  FragilityFile read{read_provenance(root, fragility_format), {}};
  Result& result = read.result;
  result.im_name = root.text_attribute("im");
  result.im_unit = root.text_attribute("im_unit");
  if (root.has_attribute("im_period_s")) result.im_period_s = root.real_attribute("im_period_s");
  if (root.has_attribute("im_damping")) result.im_damping = root.real_attribute("im_damping");
  result.confidence = root.real_attribute("confidence");
  result.resamples = static_cast<int>(root.integer_attribute("resamples"));
  const std::vector<std::int64_t> outcomes = root.integers_attribute("outcome_counts");
  for (std::size_t i = 0; i < result.outcome_counts.size(); ++i) {
    result.outcome_counts[i] = outcomes.at(i);
    result.samples += outcomes[i];
  }
  result.outside_im = root.integer_attribute("outside_im");
  result.motions = static_cast<int>(root.integer_attribute("motions"));
  if (root.has_attribute("left_out_records"))
    result.left_out_records = static_cast<int>(root.integer_attribute("left_out_records"));
  result.warnings = root.texts_attribute("warnings");
  const Group im = root.open_group("im");
  result.im_edge = values(im, "edge");
  result.im = values(im, "centre");
  const Group edps = root.open_group("edp");
  for (const std::string& name : edps.names())
    result.edps.push_back(read_edp(edps.open_group(name), name, result.im.size()));
  result.overturning = read_overturning(root.open_group("overturning"));
  if (root.has("covariance")) {
    const Group group = root.open_group("covariance");
    result.covariance = {group.open_dataset("edp").read_texts(), values(group, "ln_covariance"), whole(group, "n")};
  }
  return read;
}

}  // namespace freestand::io
