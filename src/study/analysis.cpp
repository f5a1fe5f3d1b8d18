#include "study/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "edp/edp.hpp"
#include "fragility/fit.hpp"
#include "fragility/pilot.hpp"
#include "intensity/intensity.hpp"
#include "study/bins.hpp"
#include "study/intensities.hpp"
#include "study/realise.hpp"
#include "study/until.hpp"

namespace freestand::study {
namespace {

// Of the first samples, those that the target keeps.
std::vector<double> column(const Table& first, const std::string& name, const Target& target) {
  const std::size_t index = column_index(first.columns, name);
  std::vector<double> values;
  for (std::size_t row = 0; row < first.rows(); ++row)
    if (target.keeps(row) && !std::isnan(first.at(row, index))) values.push_back(first.at(row, index));
  return values;
}

std::function<bool(std::uint64_t)> keeping(const Target& target) {
  if (target.empty()) return {};
  return [&target](std::uint64_t sample) { return target.keeps(sample); };
}

std::vector<double> capacities_of(const FragilityPart& part, const std::string& edp) {
  for (const CapacitiesPart& capacities : part.capacities)
    if (capacities.edp == edp) return capacities.values;
  return edp::find(edp).default_capacities;
}

fragility::EdpOptions edp_options(const FragilityPart& part, const std::string& name) {
  const edp::Edp& edp = edp::find(name);
  return {edp.name,
          edp.unit,
          edp.symbol,
          edp.binary,
          edp.binary ? 0 : part.still.at(name),
          edp.binary ? std::vector<double>{} : capacities_of(part, name),
          edp.censored};
}

// `key` of the study: the bins that it asks for.
std::vector<double> edges(const std::string& key, const BinsPart& bins, std::vector<double> values) {
  try {
    return bin_edges(bins, std::move(values));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", key, error.what()), error.exit());
  }
}

// The first samples, from whole blocks.
Table first_rows(std::int64_t blocks, const ReadTable& read) {
  Table first;
  for (std::int64_t block = 0; block < blocks && first.rows() < bin_layout_samples; ++block) {
    Table more = read(block);
    first.columns = std::move(more.columns);
    first.values.insert(first.values.end(), more.values.begin(), more.values.end());
  }
  first.values.resize(std::min<std::size_t>(first.rows(), bin_layout_samples) * first.columns.size());
  return first;
}

}  // namespace

fragility::Options laid_out(const Study& study, const Target& target, const Table& first,
                            const std::vector<int>& motion_group) {
  const FragilityPart& part = study.fragility;
  const intensity::Measure& measure = intensity::find(part.im.name);
  fragility::Options options;
  options.im_name = measure.name;
  options.im_unit = measure.unit;
  if (measure.parameter) options.im_period_s = intensity::parameter_of(measure, part.im.period_s);
  options.im_damping = measure.damping;
  options.im_edge = edges("fragility.bins", part.bins, column(first, "im_" + measure.name, target));
  for (const std::string& name : part.edp) options.edps.push_back(edp_options(part, name));
  for (fragility::EdpOptions& state : DamageStates(study).edps()) options.edps.push_back(std::move(state));
  for (const AxisPart& axis : part.axes) {
    const std::string name = Realiser::column_of(axis.name);
    const std::string unit = first.columns[column_index(first.columns, name)].unit;
    options.axes.push_back({name, unit, edges("fragility.axes, " + axis.name, axis.bins, column(first, name, target))});
  }
  options.motion_group = motion_group;
  options.resamples = part.resamples;
  options.confidence = part.confidence;
  options.minimum_samples = part.minimum_samples;
  options.false_discovery = part.false_discovery;
  options.empirical_fallback = part.empirical_fallback;
  options.adequate = part.adequate;
  if (study.until) options.half_width = fragility::least_wanted(wanted(study, {}), part.confidence);
  options.open_ends = part.bins.edges.empty();
  options.scrambles = study.scrambles;
  options.seed = study.seed;
  return options;
}

fragility::Options fragility_options(const Study& study, const Target& target, Table first,
                                     const std::vector<int>& motion_group) {
  fragility::Tally pilot(laid_out(study, target, first, motion_group));
  DamageStates(study).append(first, 0);
  pilot.add(first, 0, keeping(target));
  return fragility::with_pilot(pilot);
}

fragility::Result analyse(const parallel::Communicator& world, const Study& study, const Target& target,
                          const std::vector<int>& motion_group, std::int64_t blocks, std::int64_t block_size,
                          const ReadTable& read, const Jobs& jobs, parallel::StepDisplay* display) {
  DemandCounts counts(study, target, fragility_options(study, target, first_rows(blocks, read), motion_group));
  for (std::int64_t block = world.rank(); block < blocks; block += world.size()) {
    counts.add(read(block), static_cast<std::uint64_t>(block * block_size));
    if (display)
      display->show("reading blocks of samples", static_cast<std::size_t>(block + 1), static_cast<std::size_t>(blocks));
  }
  parallel::Words words = counts.words();
  world.sum_in_place(words);
  fragility::Result result = counts.result(words, jobs);
  return world.is_root() ? result : fragility::Result{};
}

DemandCounts::DemandCounts(const Study& study, const Target& target, fragility::Options options)
    : target_(target), damage_(study), tally_(std::move(options)) {}

void DemandCounts::add(Table rows, std::uint64_t first) {
  damage_.append(rows, first);
  tally_.add(rows, first, keeping(target_));
}

fragility::Result DemandCounts::result(std::span<const std::int64_t> words, const Jobs& jobs) const {
  return fragility::fit(fragility::Tally::from_words(tally_.options(), words), jobs);
}

std::vector<std::string> analysed_columns(const FragilityPart& part) {
  std::vector<std::string> names = SampleIntensity::columns();
  names.insert(names.end(), {"outcome", "motion"});
  for (const std::string& edp : part.edp) names.push_back("edp_" + edp);
  for (const DamagePart& state : part.damage)
    for (const std::string& demand : state.demands) names.push_back("edp_" + demand);
  for (const AxisPart& axis : part.axes)
    if (const std::string name = Realiser::column_of(axis.name); name != motion_pulse_column) names.push_back(name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace freestand::study
