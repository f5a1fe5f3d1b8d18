#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <freestand/error.hpp>
#include <limits>

#include "io/bin_fields.hpp"
#include "io/fragility_file.hpp"
#include "io/h5_internal.hpp"

namespace freestand::io {
namespace {

using fragility::AxisSurface;
using fragility::EdpResult;
using fragility::FragilityFunction;
using fragility::Result;
using h5::Group;

constexpr std::int64_t most_samples = std::int64_t{1} << 53;  // whole numbers that a double tells apart
constexpr std::int64_t most_motions = std::numeric_limits<int>::max();

std::vector<double> values(const Group& group, const std::string& name) { return group.open_dataset(name).read(); }

std::vector<double> values(const Group& group, const std::string& name, std::size_t count) {
  return group.open_dataset(name).read(count);
}

std::vector<std::int64_t> whole(const Group& group, const std::string& name, std::size_t count) {
  return group.open_dataset(name).read_integers(count);
}

Error misfit(const Group& group, const std::string& what) {
  return Error(fmt::format("{} cannot be used ({}): fit again", group.file_path(), what), Exit::data);
}

// Where every value is a number: intensities and capacities.
std::vector<double> numbers(const Group& group, const std::string& name) {
  std::vector<double> read = values(group, name);
  for (const double value : read)
    if (!std::isfinite(value)) throw misfit(group, fmt::format("{} holds {}", name, value));
  return read;
}

template <class Field, class Values>
void set(const Group& group, const Field& field, Values& values, double value) {
  if (!field.set(values, value)) throw misfit(group, fmt::format("{} is {}", field.name, value));
}

void read_bins(const Group& group, EdpResult& edp, std::size_t bins) {
  edp.bins.resize(bins);
  for (const BinField& field : bin_fields()) {
    const std::vector<double> read = values(group, field.name, bins);
    for (std::size_t i = 0; i < bins; ++i) set(group, field, edp.bins[i], read[i]);
  }
}

// As many for each curve.
void read_curve(const Group& group, std::vector<double> FragilityFunction::*to, const char* name, std::size_t width,
                std::vector<FragilityFunction>& curves) {
  const std::vector<double> read = values(group, name, width * curves.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto row = read.begin() + static_cast<std::ptrdiff_t>(c * width);
    (curves[c].*to).assign(row, row + static_cast<std::ptrdiff_t>(width));
  }
}

void read_curves(const Group& group, std::vector<FragilityFunction>& curves) {
  const std::vector<double> grid = values(group, "grid");
  read_curve(group, &FragilityFunction::probability, "probability", grid.size(), curves);
  read_curve(group, &FragilityFunction::lower, "lower", grid.size(), curves);
  read_curve(group, &FragilityFunction::upper, "upper", grid.size(), curves);
  const std::size_t resamples = group.open_dataset("resample").rows();
  read_curve(group, &FragilityFunction::resampled_median, "resampled_median", resamples, curves);
  read_curve(group, &FragilityFunction::resampled_dispersion, "resampled_dispersion", resamples, curves);
  if (group.has("left_out_median")) {
    const std::size_t left_out = group.open_dataset("left_out").rows();
    read_curve(group, &FragilityFunction::left_out_median, "left_out_median", left_out, curves);
    read_curve(group, &FragilityFunction::left_out_dispersion, "left_out_dispersion", left_out, curves);
  }
  for (FragilityFunction& curve : curves) curve.grid = grid;
}

void read_cells(const Group& group, std::vector<FragilityFunction>& curves) {
  if (!group.has("cell_share")) return;
  const std::vector<double> cell = values(group, "cell");
  read_curve(group, &FragilityFunction::cell_share, "cell_share", cell.size(), curves);
  read_curve(group, &FragilityFunction::cell_n, "cell_n", cell.size(), curves);
  const auto read_again = [&](const char* name, std::vector<double> FragilityFunction::*of) {
    if (!group.has(name)) return;
    const h5::Dimensions extent = group.open_dataset(name).dimensions();
    if (extent.size() != 3 || extent[0] != curves.size() || extent[2] != cell.size())
      throw misfit(group, fmt::format("{} is [{}], not [{}, repeat, {}]", name, fmt::join(extent, ", "), curves.size(),
                                      cell.size()));
    if (cell.empty() || curves.empty()) return;
    read_curve(group, of, name, values(group, name).size() / curves.size(), curves);
    for (FragilityFunction& curve : curves)
      if (!(curve.*of).empty() && std::isnan((curve.*of).front())) (curve.*of).clear();
  };
  read_again("resampled_cell_share", &FragilityFunction::resampled_cell_share);
  read_again("left_out_cell_share", &FragilityFunction::left_out_cell_share);
  for (FragilityFunction& curve : curves)
    if (!curve.cell_share.empty() && std::isnan(curve.cell_share.front()))
      curve.cell_share.clear(), curve.cell_n.clear();
    else
      curve.cell_im = cell;
}

void read_functions(const Group& group, EdpResult& edp) {
  edp.functions.resize(edp.capacity.size());
  for (const FunctionField& field : function_fields()) {
    const std::vector<double> read = values(group, field.name, edp.functions.size());
    for (std::size_t c = 0; c < edp.functions.size(); ++c) set(group, field, edp.functions[c], read[c]);
  }
  read_curves(group, edp.functions);
  read_cells(group, edp.functions);
}

AxisSurface read_axis(const Group& group, const std::string& name, std::size_t bins, std::size_t capacities) {
  const std::vector<double> centre = values(group, "centre");
  const std::size_t cells = bins * centre.size(), points = cells * capacities;
  return {name,
          group.text_attribute("unit"),
          values(group, "edge", centre.size() + 1),
          centre,
          values(group, "probability", points),
          values(group, "lower", points),
          values(group, "upper", points),
          whole(group, "n", cells)};
}

// One surface for each resample, or each group left out.
std::vector<double> read_surfaces(const Group& group, const char* name, std::size_t points) {
  if (!group.has(name)) return {};
  const std::vector<double> read = values(group, name);
  if (points == 0 || read.size() % points != 0)
    throw misfit(group, fmt::format("{} has {} values, for surfaces of {} points", name, read.size(), points));
  return read;
}

fragility::Surface read_surface(const Group& group, std::size_t points) {
  return {values(group, "probability", points),
          values(group, "lower", points),
          values(group, "upper", points),
          values(group, "empirical", points),
          values(group, "least", points),
          values(group, "most", points),
          values(group, "empirical_lower", points),
          values(group, "empirical_upper", points),
          read_surfaces(group, "resampled", points),
          read_surfaces(group, "probability_left_out", points)};
}

fragility::Distribution read_distribution(const Group& group, std::size_t bins) {
  const std::vector<double> edges = values(group, "ln_edge");
  if (edges.empty()) throw misfit(group, "the cells of ln EDP have no edges");
  return {edges, whole(group, "count", bins * (edges.size() - 1))};
}

EdpResult read_edp(const Group& group, const std::string& name, std::size_t bins) {
  EdpResult edp;
  edp.name = name;
  edp.unit = group.text_attribute("unit");
  edp.symbol = group.text_attribute("symbol");
  edp.binary = group.text_attribute("kind") == "binary";
  edp.regressions.n = h5::count_attribute(group, "regression_n", most_samples);
  for (const RegressionField& field : regression_fields())
    edp.regressions.*field.value = group.real_attribute(field.name);
  edp.capacity = numbers(group, "capacity");
  read_bins(group, edp, bins);
  edp.surface = read_surface(group.open_group("surface"), bins * edp.capacity.size());
  if (group.has("functions")) read_functions(group.open_group("functions"), edp);
  if (group.has("distribution")) edp.distribution = read_distribution(group.open_group("distribution"), bins);
  if (!group.has("axis")) return edp;
  const Group axes = group.open_group("axis");
  for (const std::string& axis : axes.names())
    edp.axes.push_back(read_axis(axes.open_group(axis), axis, bins, edp.capacity.size()));
  return edp;
}

FragilityFunction read_overturning(const Group& group) {
  std::vector<FragilityFunction> curves(1);
  for (const FunctionField& field : function_fields()) set(group, field, curves[0], group.real_attribute(field.name));
  read_curves(group, curves);
  return curves[0];
}

fragility::Covariance read_covariance(const Group& group, std::size_t bins) {
  const std::vector<std::string> edps = group.open_dataset("edp").read_texts();
  const std::size_t pairs = bins * edps.size() * edps.size();
  return {edps, values(group, "ln_covariance", pairs), whole(group, "n", pairs)};
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
  if (!(result.confidence > 0 && result.confidence < 1))
    throw misfit(root, fmt::format("its confidence is {}", result.confidence));
  result.resamples = static_cast<int>(h5::count_attribute(root, "resamples", most_motions));
  const std::vector<std::int64_t> outcomes = root.integers_attribute("outcome_counts");
  if (outcomes.size() != result.outcome_counts.size())
    throw misfit(root,
                 fmt::format("it counts {} outcomes instead of {}", outcomes.size(), result.outcome_counts.size()));
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i] < 0 || outcomes[i] > most_samples)
      throw misfit(root, fmt::format("{} samples had one outcome", outcomes[i]));
    result.outcome_counts[i] = outcomes[i];
    result.samples += outcomes[i];
  }
  result.outside_im = h5::count_attribute(root, "outside_im", most_samples);
  result.motions = static_cast<int>(h5::count_attribute(root, "motions", most_motions));
  if (root.has_attribute("left_out_records"))
    result.left_out_records = static_cast<int>(h5::count_attribute(root, "left_out_records", most_motions));
  result.warnings = root.texts_attribute("warnings");
  const Group im = root.open_group("im");
  result.im = numbers(im, "centre");
  result.im_edge = numbers(im, "edge");
  if (result.im_edge.size() != result.im.size() + 1)
    throw misfit(im, fmt::format("{} edges of {} bins", result.im_edge.size(), result.im.size()));
  if (!im.has("cell"))
    throw misfit(im, "it is of an earlier version, and does not tell how intensities are spread within bins");
  result.cell_im = numbers(im, "cell");
  if (result.im.empty() || result.cell_im.size() % result.im.size() != 0)
    throw misfit(im, fmt::format("it has {} fine cells in {} bins", result.cell_im.size(), result.im.size()));
  result.cell_n = whole(im, "cell_n", result.cell_im.size());
  const Group edps = root.open_group("edp");
  for (const std::string& name : edps.names())
    result.edps.push_back(read_edp(edps.open_group(name), name, result.im.size()));
  result.overturning = read_overturning(root.open_group("overturning"));
  if (root.has("covariance")) result.covariance = read_covariance(root.open_group("covariance"), result.im.size());
  return read;
}

}  // namespace freestand::io
