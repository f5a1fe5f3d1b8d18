#include "io/fragility_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "io/bin_fields.hpp"
#include "io/csv_cell.hpp"

namespace freestand::io {
namespace {

using fragility::AxisSurface;
using fragility::BinFit;
using fragility::EdpResult;
using fragility::Result;
using h5::Dataset;
using h5::Group;

const std::string at_mean = "mean of the samples of each bin (its middle where it has none), ";

// A coordinate: its own dimension scale, named as it is.
Dataset coordinate(Group& group, const std::string& name, const std::vector<double>& values, const std::string& unit,
                   const std::string& description) {
  Dataset dataset = group.put(name, values);
  dataset.scale(name).describe(unit, description);
  return dataset;
}

// The two that most groups need: each group holds its own, since readers such as xarray open one group at a time.
Dataset im_of(Group& group, const Result& result) {
  return coordinate(group, "im", result.im, result.im_unit, at_mean + im_text(result));
}
Dataset capacity_of(Group& group, const EdpResult& edp) {
  return coordinate(group, "capacity", edp.capacity, edp.unit, "capacity");
}

void write_bins(Group& group, const Dataset& im, const EdpResult& edp) {
  for (const BinField& field : bin_fields()) {
    std::vector<double> values;
    for (const BinFit& bin : edp.bins) values.push_back(field.value(bin));
    Dataset dataset = field.whole ? group.put(field.name, std::vector<std::int64_t>(values.begin(), values.end()))
                                  : group.put(field.name, values);
    dataset.attach(0, im).describe(field.unit == FieldUnit::one ? "1" : edp.unit, field.description);
  }
}

struct Shown {
  const char* name;
  const std::vector<double>* values;
  const char* description;
};

// Coordinate of what was found for each resampled set of motions.
Dataset resample_numbers(Group& group, const Result& result) {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(result.resamples));
  std::iota(numbers.begin(), numbers.end(), 0);
  Dataset resample = group.put("resample", numbers);
  resample.scale("resample").describe("", "number of the resampled set of motions, the same for every curve");
  return resample;
}

// Of what was found without a group of motions; absent where fewer than two can be left out.
Dataset left_out_numbers(Group& group, std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  Dataset left_out = group.put("left_out", numbers);
  left_out.scale("left_out").describe("", "number of the group of motions that is left out, those of records first");
  return left_out;
}

void write_surface(Group& parent, const Result& result, const EdpResult& edp) {
  Group group = parent.make_group("surface");
  const Dataset im = im_of(group, result), capacity = capacity_of(group, edp);
  const h5::Dimensions shape{edp.bins.size(), edp.capacity.size()};
  for (const Shown& curve :
       {Shown{"probability", &edp.surface.probability, "P(EDP > capacity), fit or counts by status"},
        Shown{"lower", &edp.surface.lower, "lower end of the band, from resampled motions"},
        Shown{"upper", &edp.surface.upper, "upper end of the band, from resampled motions"},
        Shown{"empirical", &edp.surface.empirical, "fraction of samples above, overturned included"},
        Shown{"least", &edp.surface.least, "the same, had every sample that failed stayed below"},
        Shown{"most", &edp.surface.most, "the same, had every sample that failed lain above"},
        Shown{"empirical_lower", &edp.surface.empirical_lower, "lower end of its interval, motions as the unit"},
        Shown{"empirical_upper", &edp.surface.empirical_upper, "upper end of its interval, motions as the unit"}})
    group.put(curve.name, *curve.values, shape).attach(0, im).attach(1, capacity).describe("1", curve.description);
  if (edp.surface.resampled.empty()) return;
  const Dataset resample = resample_numbers(group, result);
  group.put("resampled", edp.surface.resampled, {static_cast<std::uint64_t>(result.resamples), shape[0], shape[1]})
      .attach(0, resample)
      .attach(1, im)
      .attach(2, capacity)
      .describe("1", "fraction of samples above, from each resampled set of motions");
  const std::size_t left_out = edp.surface.left_out.size() / edp.surface.probability.size();
  if (left_out == 0) return;
  group.put("probability_left_out", edp.surface.left_out, {left_out, shape[0], shape[1]})
      .attach(0, left_out_numbers(group, left_out))
      .attach(1, im)
      .attach(2, capacity)
      .describe("1", "fraction of samples above, without each group of motions");
}

void write_distribution(Group& parent, const Result& result, const EdpResult& edp) {
  if (edp.distribution.ln_edge.size() < 2) return;
  Group group = parent.make_group("distribution");
  const Dataset im = im_of(group, result);
  const std::vector<double>& edge = edp.distribution.ln_edge;
  std::vector<double> middle;
  for (std::size_t cell = 0; cell + 1 < edge.size(); ++cell) middle.push_back(0.5 * (edge[cell] + edge[cell + 1]));
  coordinate(group, "ln_edge", edge, "1", "edges of the cells, ln EDP");
  const Dataset cell = coordinate(group, "ln_middle", middle, "1", "middle of the cells, ln EDP");
  group.put("count", edp.distribution.count, {edp.bins.size(), middle.size()})
      .attach(0, im)
      .attach(1, cell)
      .describe("1", "samples that moved and stood, demands moved to im along the slope");
}

void write_axis(Group& parent, const Result& result, const EdpResult& edp, const AxisSurface& axis) {
  Group group = parent.make_group(axis.name);
  const Dataset im = im_of(group, result), capacity = capacity_of(group, edp);
  group.attribute("unit", axis.unit);
  coordinate(group, "edge", axis.edge, axis.unit, "edges of the bins");
  const Dataset centre = coordinate(group, "centre", axis.centre, axis.unit, axis.name);
  const h5::Dimensions cells{edp.bins.size(), axis.centre.size()};
  const h5::Dimensions shape{cells[0], cells[1], edp.capacity.size()};
  for (const Shown& curve : {Shown{"probability", &axis.probability, "P(EDP > capacity), from counts"},
                             Shown{"lower", &axis.lower, "lower end of the band, from resampled motions"},
                             Shown{"upper", &axis.upper, "upper end of the band, from resampled motions"}}) {
    Dataset dataset = group.put(curve.name, *curve.values, shape);
    dataset.attach(0, im).attach(1, centre).attach(2, capacity).describe("1", curve.description);
  }
  group.put("n", axis.n, cells).attach(0, im).attach(1, centre).describe("1", "samples in the cell");
}

// As many as there are resamples; NaN where a curve has none.
std::vector<double> per_resample(std::vector<double> values, const Result& result) {
  values.resize(static_cast<std::size_t>(result.resamples), fragility::unknown);
  return values;
}

// Curves over IM, [capacity] and [capacity, grid].
void write_functions(Group& parent, const Result& result, const EdpResult& edp) {
  using fragility::FragilityFunction;
  Group group = parent.make_group("functions");
  const Dataset capacity = capacity_of(group, edp);
  for (const FunctionField& field : function_fields()) {
    std::vector<double> values;
    for (const FragilityFunction& curve : edp.functions) values.push_back(field.value(curve));
    group.put(field.name, values).attach(0, capacity).describe(field.of_im ? result.im_unit : "1", field.description);
  }
  const Dataset grid = coordinate(group, "grid", edp.functions.front().grid, result.im_unit, im_text(result));
  const Dataset resample = resample_numbers(group, result);
  const auto put = [&](const char* name, const Dataset& columns, const std::string& unit, const char* description,
                       const auto& row_of) {
    std::vector<double> all;
    for (const FragilityFunction& curve : edp.functions) {
      const std::vector<double> row = row_of(curve);
      all.insert(all.end(), row.begin(), row.end());
    }
    group.put(name, all, {edp.functions.size(), columns.dimensions().at(0)})
        .attach(0, capacity)
        .attach(1, columns)
        .describe(unit, description);
  };
  using Curve = const FragilityFunction&;
  put("probability", grid, "1", "P(EDP > capacity), the fitted curve", [](Curve c) { return c.probability; });
  put("lower", grid, "1", "lower end of the band, from resampled motions", [](Curve c) { return c.lower; });
  put("upper", grid, "1", "upper end of the band, from resampled motions", [](Curve c) { return c.upper; });
  put("resampled_median", resample, result.im_unit, "median of each resampled set of motions",
      [&](Curve c) { return per_resample(c.resampled_median, result); });
  put("resampled_dispersion", resample, "1", "dispersion of each resampled set of motions",
      [&](Curve c) { return per_resample(c.resampled_dispersion, result); });
  std::size_t left_out = 0;
  for (Curve curve : edp.functions)
    left_out = std::max({left_out, curve.left_out_median.size(),
                         curve.cell_share.empty() ? 0 : curve.left_out_cell_share.size() / curve.cell_share.size()});
  std::optional<Dataset> out;
  if (left_out > 0) out = left_out_numbers(group, left_out);
  const auto with_cells =
      std::find_if(edp.functions.begin(), edp.functions.end(), [](Curve c) { return !c.cell_share.empty(); });
  if (with_cells != edp.functions.end()) {
    const Dataset cell = coordinate(group, "cell", with_cells->cell_im, result.im_unit, "mean IM of the fine cells");
    const auto or_unknown = [](const std::vector<double>& values, std::size_t size) {
      return values.size() == size ? values : std::vector<double>(size, fragility::unknown);
    };
    const std::size_t cells = with_cells->cell_share.size();
    put("cell_share", cell, "1", "of curves that are not adequate: the shares of fine cells",
        [&](Curve c) { return or_unknown(c.cell_share, cells); });
    put("cell_n", cell, "1", "their samples", [&](Curve c) { return or_unknown(c.cell_n, cells); });
    const auto put_again = [&](const char* name, std::vector<double> FragilityFunction::*of, const Dataset& repeat,
                               const char* description) {
      const std::size_t times = repeat.dimensions().at(0);
      std::vector<double> all;
      for (Curve c : edp.functions) {
        const std::vector<double> row = or_unknown(c.*of, times * cells);
        all.insert(all.end(), row.begin(), row.end());
      }
      group.put(name, all, {edp.functions.size(), times, cells})
          .attach(0, capacity)
          .attach(1, repeat)
          .attach(2, cell)
          .describe("1", description);
    };
    put_again("resampled_cell_share", &FragilityFunction::resampled_cell_share, resample,
              "the same of each resampled set of motions");
    if (out)
      put_again("left_out_cell_share", &FragilityFunction::left_out_cell_share, *out,
                "the same without each group of motions");
  }
  if (!out) return;
  const auto full = [left_out](std::vector<double> values) {
    values.resize(left_out, fragility::unknown);
    return values;
  };
  put("left_out_median", *out, result.im_unit, "median without each group of motions",
      [&](Curve c) { return full(c.left_out_median); });
  put("left_out_dispersion", *out, "1", "dispersion without each group of motions",
      [&](Curve c) { return full(c.left_out_dispersion); });
}

void write_regressions(Group& group, const fragility::Regressions& found) {
  group.attribute("regression_n", found.n);
  for (const RegressionField& field : regression_fields()) group.attribute(field.name, found.*field.value);
}

void write_edp(Group& parent, const Result& result, const EdpResult& edp) {
  Group group = parent.make_group(edp.name);
  group.attribute("unit", edp.unit);
  group.attribute("symbol", edp.symbol);
  group.attribute("kind", edp.binary ? "binary" : "continuous");
  write_regressions(group, edp.regressions);
  capacity_of(group, edp);
  write_bins(group, im_of(group, result), edp);
  write_surface(group, result, edp);
  if (!edp.functions.empty()) write_functions(group, result, edp);
  write_distribution(group, result, edp);
  if (edp.axes.empty()) return;
  Group axes = group.make_group("axis");
  for (const AxisSurface& axis : edp.axes) write_axis(axes, result, edp, axis);
}

// Of which intensity the curves are: its name and unit, and period and damping where they are part of it.
void write_intensity(Group& group, const Result& result) {
  group.attribute("im", result.im_name);
  group.attribute("im_unit", result.im_unit);
  if (result.im_period_s) group.attribute("im_period_s", *result.im_period_s);
  if (result.im_damping) group.attribute("im_damping", *result.im_damping);
}

// One curve: its numbers are attributes.
void write_overturning(Group& root, const Result& result) {
  const fragility::FragilityFunction& curve = result.overturning;
  Group group = root.make_group("overturning");
  write_intensity(group, result);
  for (const FunctionField& field : function_fields()) group.attribute(field.name, field.value(curve));
  const Dataset grid = coordinate(group, "grid", curve.grid, result.im_unit, im_text(result));
  group.put("probability", curve.probability).attach(0, grid).describe("1", "P(overturning)");
  group.put("lower", curve.lower).attach(0, grid).describe("1", "lower end of the band, from resampled motions");
  group.put("upper", curve.upper).attach(0, grid).describe("1", "upper end of the band, from resampled motions");
  const Dataset resample = resample_numbers(group, result);
  group.put("resampled_median", per_resample(curve.resampled_median, result))
      .attach(0, resample)
      .describe(result.im_unit, "median of each resampled set of motions");
  group.put("resampled_dispersion", per_resample(curve.resampled_dispersion, result))
      .attach(0, resample)
      .describe("1", "dispersion of each resampled set of motions");
  if (curve.left_out_median.empty()) return;
  const Dataset out = left_out_numbers(group, curve.left_out_median.size());
  group.put("left_out_median", curve.left_out_median)
      .attach(0, out)
      .describe(result.im_unit, "median without each group of motions");
  group.put("left_out_dispersion", curve.left_out_dispersion)
      .attach(0, out)
      .describe("1", "dispersion without each group of motions");
}

// [im, edp, other]; the two are the same list of demands.
void write_covariance(Group& root, const Result& result) {
  const fragility::Covariance& covariance = result.covariance;
  if (covariance.edps.size() < 2) return;
  Group group = root.make_group("covariance");
  const Dataset im = im_of(group, result);
  Dataset edp = group.put("edp", covariance.edps), other = group.put("other", covariance.edps);
  edp.scale("edp").describe("", "demand");
  other.scale("other").describe("", "the same demands once more");
  const h5::Dimensions shape{result.im.size(), covariance.edps.size(), covariance.edps.size()};
  const auto attached = [&](Dataset dataset, const char* description) {
    dataset.attach(0, im).attach(1, edp).attach(2, other).describe("1", description);
  };
  attached(group.put("ln_covariance", covariance.ln_covariance, shape),
           "covariance of ln EDP of samples that moved by both and stood, about their lines over ln IM");
  attached(group.put("n", covariance.n, shape), "samples that moved by both and stood");
}

void write_root(Group& root, const Provenance& provenance, const Result& result) {
  write_provenance(root, fragility_format, provenance);
  write_intensity(root, result);
  root.attribute("mix",
                 "P(EDP > C) at an intensity is that of the specimens and motions which the study mixes there; "
                 "fragility.target of the study gives another mix");
  root.attribute("confidence", result.confidence);
  root.attribute("resamples", result.resamples);
  std::vector<std::string> names;
  for (int i = 0; i < outcome_count; ++i) names.emplace_back(name(static_cast<Outcome>(i)));
  root.attribute("outcome_names", names);
  root.attribute("outcome_counts",
                 std::vector<std::int64_t>(result.outcome_counts.begin(), result.outcome_counts.end()));
  root.attribute("outside_im", result.outside_im);
  root.attribute("motions", result.motions);
  root.attribute("left_out_records", result.left_out_records);
  root.attribute("warnings", result.warnings);
}

}  // namespace

const char* name(fragility::BinStatus status) {
  constexpr const char* names[] = {"fitted", "too_few", "rejected", "counts_only", "not_refuted"};
  return names[static_cast<int>(status)];
}

void write_fragility(const std::filesystem::path& path, const Provenance& provenance, const Result& result) {
  h5::File file = h5::File::create(path);
  Group root = file.root();
  write_root(root, provenance, result);
  Group im = root.make_group("im");
  coordinate(im, "edge", result.im_edge, result.im_unit, "edges of the bins, " + im_text(result));
  coordinate(im, "centre", result.im, result.im_unit, at_mean + im_text(result));
  const Dataset cell =
      coordinate(im, "cell", result.cell_im, result.im_unit, "mean IM of the fine cells, as many of each bin");
  im.put("cell_n", result.cell_n).attach(0, cell).describe("1", "their samples");
  Group edps = root.make_group("edp");
  for (const EdpResult& edp : result.edps) write_edp(edps, result, edp);
  write_overturning(root, result);
  write_covariance(root, result);
  file.finish();
}

std::string bins_csv(const Result& result) {
  std::string text = "edp,unit,im,im_lower,im_upper";
  for (const BinField& field : bin_fields()) text += fmt::format(",{}", field.name);
  text += ",n_happened\n";  // of a demand that happens or not, overturned samples included
  for (const EdpResult& edp : result.edps)
    for (std::size_t i = 0; i < edp.bins.size(); ++i) {
      text += fmt::format("{},{},{},{},{}", cell(edp.name), cell(edp.unit), cell(result.im[i]), cell(result.im_edge[i]),
                          cell(result.im_edge[i + 1]));
      for (const BinField& field : bin_fields())
        if (field.name == std::string_view("status"))
          text += fmt::format(",{}", name(edp.bins[i].status));
        else
          text += fmt::format(",{}", cell(field.value(edp.bins[i])));
      const bool told = edp.binary && std::isfinite(edp.surface.empirical[i]);
      text +=
          fmt::format(",{}\n", told ? cell(std::round(edp.surface.empirical[i] * static_cast<double>(edp.bins[i].n)))
                                    : std::string());
    }
  return text;
}

}  // namespace freestand::io
