#include "study/intensities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>

namespace freestand::study {
namespace {

enum Read : std::size_t { motion_index, scale, pulse_period, alpha, p, mu_k };

// One ordinate is looked up faster than many.
motion::MotionSummary with_one_period(motion::MotionSummary summary, double period_s) {
  if (!summary.is_pulse) summary.spectrum = {{period_s}, {summary.spectrum.at(period_s)}};
  return summary;
}

// Relative error with which a kept ordinate next to the period is met when it is left out: of wider gaps, so more than that
// at the period itself.
double missed(const motion::ResponseSpectrum& spectrum, double period_s) {
  std::vector<double> periods = spectrum.period_s(), ordinates = spectrum.sa_mps2();
  const auto above = std::lower_bound(periods.begin() + 1, periods.end() - 2, period_s) - periods.begin();
  periods.erase(periods.begin() + above);
  ordinates.erase(ordinates.begin() + above);
  const motion::ResponseSpectrum without(std::move(periods), std::move(ordinates));
  const auto i = static_cast<std::size_t>(above);
  return std::abs(without.at(spectrum.period_s()[i]) / spectrum.sa_mps2()[i] - 1);
}

// Of the pulse in a record; nan where there is none.
double pulse_period_s(const motion::MotionSummary& record) {
  return record.pulse.period_s > 0 ? record.pulse.period_s : std::numeric_limits<double>::quiet_NaN();
}

std::string interpolation_told(const IntensityPart& part, double period_s, const MotionSummaries& motions) {
  double sum = 0, largest = 0;
  int count = 0;
  for (const motion::MotionSummary& summary : motions) {
    if (summary.is_pulse || summary.spectrum.holds(period_s) || summary.spectrum.period_s().size() < 4) continue;
    const double error = missed(summary.spectrum, period_s);
    sum += error;
    largest = std::max(largest, error);
    ++count;
  }
  if (count == 0) return "";
  return fmt::format(
      "{} at {} s is interpolated between the periods that are kept of the {} records (a kept one beside it, "
      "left out, is met to {:.2g} % on the average and {:.2g} % at worst): take a kept one, such as any "
      "hundredth of a second up to 1 s, for none",
      part.name, sampling::number_text(period_s), count, 100 * sum / count, 100 * largest);
}

// record.COLUMN of tables without that column.
void refuse_columns_that_no_table_has(const std::string& name, const MotionSummaries& motions) {
  const std::string prefix = "record.";
  if (!name.starts_with(prefix)) return;
  std::vector<std::string> columns;
  for (const motion::MotionSummary& summary : motions)
    for (const auto& [column, value] : summary.given) {
      if (prefix + column == name) return;
      if (std::find(columns.begin(), columns.end(), prefix + column) == columns.end())
        columns.push_back(prefix + column);
    }
  throw Error(fmt::format(
      "{} is not in the tables of records of this sweep ({}): name another intensity, or add the "
      "column and sweep again",
      name, columns.empty() ? "they give none" : "they give " + fmt::format("{}", fmt::join(columns, ", "))));
}

}  // namespace

const std::vector<std::string>& SampleIntensity::columns() {
  static const std::vector<std::string> names = {"motion",          "scale",         "pulse_period_s",
                                                 "block_alpha_rad", "block_p_radps", "friction_mu_k"};
  return names;
}

SampleIntensity::SampleIntensity(const IntensityPart& part, const MotionSummaries& motions)
    : measure_(intensity::find(part.name)), parameter_(intensity::parameter_of(measure_, part.period_s)) {
  refuse_columns_that_no_table_has(part.name, motions);
  for (const motion::MotionSummary& floor : motions) {
    const motion::MotionSummary& summary = measure_.of_the_ground ? motion::ground_of(floor) : floor;
    if (!measure_.parameter) {
      motions_.push_back(summary);
      continue;
    }
    const std::vector<double>& kept = summary.spectrum.period_s();
    if (!summary.is_pulse && (kept.empty() || parameter_ < kept.front() || parameter_ > kept.back()))
      throw Error(
          fmt::format("no intensity {} at {} s (of the records of this sweep it is kept from {} to {} s): name "
                      "a period within them, or run the study with this one",
                      part.name, parameter_, kept.empty() ? 0 : kept.front(), kept.empty() ? 0 : kept.back()));
    motions_.push_back(with_one_period(summary, parameter_));
  }
  if (measure_.parameter)
    interpolation_ = interpolation_told(part, parameter_, motions);  // those of the ground are among them
}

std::vector<double> SampleIntensity::operator()(const Table& rows) const {
  std::vector<std::size_t> at;
  for (const std::string& name : columns()) at.push_back(column_index(rows.columns, name));
  std::vector<double> values;
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    const double index = rows.at(row, at[motion_index]), period = rows.at(row, at[pulse_period]);
    if (!(index >= 0 && index < static_cast<double>(motions_.size())))
      throw Error(fmt::format("a sample cannot be used (its motion is {}, of {}): the samples are damaged", index,
                              motions_.size()),
                  Exit::data);
    values.push_back(measure_.value({.motion = motions_[static_cast<std::size_t>(index)],
                                     .scale = rows.at(row, at[scale]),
                                     .stretch = std::isnan(period) ? 1 : period,
                                     .alpha_rad = rows.at(row, at[alpha]),
                                     .p_radps = rows.at(row, at[p]),
                                     .mu_k = rows.at(row, at[mu_k]),
                                     .parameter = parameter_}));
  }
  return values;
}

Table SampleIntensity::beside(Table rows) const {
  const std::vector<double> intensity = (*this)(rows);
  const std::size_t before = rows.columns.size();
  const std::size_t motion = column_index(rows.columns, "motion"),
                    period = column_index(rows.columns, "pulse_period_s");
  Table wider{std::move(rows.columns), {}};
  wider.columns.push_back({motion_pulse_column, "s", "period T_p of the motion's pulse: its own, given or identified"});
  wider.columns.push_back({"im_" + measure_.name, measure_.unit, measure_.summary});
  wider.values.reserve(intensity.size() * (before + 2));
  for (std::size_t row = 0; row < intensity.size(); ++row) {
    const auto first = rows.values.begin() + static_cast<std::ptrdiff_t>(row * before);
    wider.values.insert(wider.values.end(), first, first + static_cast<std::ptrdiff_t>(before));
    const double own = first[static_cast<std::ptrdiff_t>(period)];
    const auto index = static_cast<std::size_t>(first[static_cast<std::ptrdiff_t>(motion)]);
    wider.values.push_back(std::isnan(own) ? pulse_period_s(motions_[index]) : own);
    wider.values.push_back(intensity[row]);
  }
  return wider;
}

}  // namespace freestand::study
