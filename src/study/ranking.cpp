#include "study/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/key_names.hpp"
#include "edp/edp.hpp"
#include "intensity/intensity.hpp"
#include "motion/record_table.hpp"
#include "study/fragility_changes.hpp"
#include "study/intensities.hpp"
#include "study/motion_summaries.hpp"
#include "study/swept_study.hpp"

namespace freestand::study {
namespace {

using fragility::RankedDemand;
using fragility::RankedIm;
using nlohmann::ordered_json;

constexpr std::int64_t rows_of_a_block = 2048;
constexpr double usual_periods_s[] = {0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3};

bool same(const IntensityPart& a, const IntensityPart& b) { return a.name == b.name && a.period_s == b.period_s; }

// What tables of records give of any motion.
std::vector<std::string> given_columns(const MotionSummaries& summaries) {
  std::vector<std::string> columns;
  for (const motion::MotionSummary& summary : summaries)
    for (const auto& [column, value] : summary.given)
      if (!std::isnan(value) && std::find(columns.begin(), columns.end(), column) == columns.end())
        columns.push_back(column);
  return columns;
}

// Is it an intensity, or a property of the record such as its magnitude?
bool scales(const std::string& column) {
  const auto number = motion::record_number(column);
  return number && number->power > 0;
}

// What is ranked. pta_g is pga_g under another name.
std::vector<IntensityPart> candidates(const Study& study, const MotionSummaries& summaries) {
  std::vector<IntensityPart> parts;
  for (const std::string& column : given_columns(summaries))
    if (scales(column)) parts.push_back({"record." + column});
  const auto add = [&](const intensity::Measure& measure) {
    if (!measure.parameter)
      parts.push_back({measure.name});
    else
      for (const double period : usual_periods_s) parts.push_back({measure.name, measure.parameter->name, period});
  };
  for (const intensity::Measure* measure : intensity::all())
    if (measure->name != "pta_g") add(*measure);
  if (std::any_of(summaries.begin(), summaries.end(), [](const auto& summary) { return summary.ground != nullptr; }))
    for (const intensity::Measure* measure : intensity::of_the_ground()) add(*measure);
  const IntensityPart& own = study.fragility.im;
  const bool there =
      std::any_of(parts.begin(), parts.end(), [&](const IntensityPart& part) { return same(part, own); });
  if (!there && own.name != "pta_g") parts.push_back(own);
  return parts;
}

// Pulses by their table, not their closed form: a rank does not hang on the sixth digit.
MotionSummaries quick(MotionSummaries summaries) {
  for (motion::MotionSummary& summary : summaries) summary.unit_pulse.reset();
  return summaries;
}

fragility::RankingOptions options_of(const Study& study, const std::vector<IntensityPart>& parts,
                                     const std::vector<int>& motion_group, const MotionSummaries& summaries) {
  fragility::RankingOptions options;
  for (const IntensityPart& part : parts) options.ims.push_back(short_name(part));
  for (const std::string& name : study.fragility.edp) {
    const edp::Edp& edp = edp::find(name);
    options.edps.push_back({edp.name, edp.binary, edp.binary ? 0 : study.fragility.still.at(name), edp.censored});
  }
  options.motion_group = motion_group;
  fragility::MotionProperty of_records{"record_pulse_period_s"};
  bool records = false, pulses = false;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const double period = summaries[i].pulse.period_s;
    of_records.value.push_back(period > 0 ? period : fragility::unknown);
    (motion_group[i] < 0 ? pulses : records) = true;
  }
  if (records) options.properties.push_back(std::move(of_records));
  for (const std::string& column : given_columns(summaries)) {
    if (scales(column)) continue;
    fragility::MotionProperty& property =
        options.properties.emplace_back(fragility::MotionProperty{"record_" + column});
    for (const motion::MotionSummary& summary : summaries) property.value.push_back(summary.given_value(column));
    property.logarithm = unit_of(column) != "1" || column.ends_with("_km");  // a magnitude is one
  }
  if (pulses) options.properties.push_back({.name = "pulse_period_s", .of_pulses = true, .value = {}});
  return options;
}

ordered_json number_json(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(); }

std::string cell(double x) { return std::isfinite(x) ? fmt::format("{}", x) : ""; }

// Is the difference to the best one more than chance (twice its standard error)?
bool clearly_behind(const RankedIm& im) { return im.behind > 2 * im.behind_se; }

std::string figure(const RankedDemand& demand, const RankedIm& im) {
  return fmt::format("{:.3g}{}", im.value, std::isfinite(im.value_se) ? fmt::format(" +- {:.1g}", im.value_se) : "") +
         (demand.binary ? " of the deviance explained" : " scatter of ln demand");
}

std::string one_line(const RankedDemand& demand, const Study& study) {
  const RankedIm& best = demand.ims.front();
  std::string equals;
  for (const RankedIm& im : demand.ims)
    if (&im != &best && std::isfinite(im.value) && !clearly_behind(im)) equals += (equals.empty() ? "" : ", ") + im.im;
  const std::string own = short_name(study.fragility.im);
  std::string text = fmt::format("best intensity for {}: {} ({})", demand.edp, best.im, figure(demand, best));
  if (!equals.empty()) text += fmt::format(", not parted from it by these motions: {}", equals);
  for (const RankedIm& im : demand.ims)
    if (im.im == own && own != best.im && std::isfinite(im.value))
      text += fmt::format("; {}, which this fit is over, has {:.3g}", own, im.value);
  return text + "\n";
}

std::string table(const RankedDemand& demand) {
  std::string text = fmt::format("\n{}\n  {:<24} {:>9} {:>8} {:>9} {:>8}  {}\n", demand.edp, "intensity",
                                 demand.binary ? "explained" : "scatter", "+-", "behind", "+-",
                                 demand.binary ? "parts pairs" : "left dependence on (p)");
  for (const RankedIm& im : demand.ims) {
    text += fmt::format("  {:<24} {:>9.3g} {:>8.1g} {:>9.2g} {:>8.1g}  ", im.im, im.value, im.value_se, im.behind,
                        im.behind_se);
    if (demand.binary) text += fmt::format("{:.3f}", im.parts);
    for (const auto& s : im.sufficiency) text += fmt::format("{} {:+.2g} ({:.2g})  ", s.property, s.slope, s.p);
    text += "\n";
  }
  return text;
}

}  // namespace

RankingCounts::RankingCounts(const Study& study, const Target& target, const std::vector<int>& motion_group,
                             const MotionSummaries& with_pulses)
    : target_(target), tally_([&] {
        const MotionSummaries summaries = quick(with_pulses);
        const std::vector<IntensityPart> parts = candidates(study, summaries);
        for (const IntensityPart& part : parts) intensities_.emplace_back(part, summaries);
        return options_of(study, parts, motion_group, summaries);
      }()) {}

std::vector<std::string> RankingCounts::columns() const {
  std::vector<std::string> names = SampleIntensity::columns();
  names.push_back("outcome");
  for (const auto& edp : tally_.options().edps) names.push_back("edp_" + edp.name);
  return names;
}

void RankingCounts::add(const Table& rows, std::int64_t first) {
  const auto end = static_cast<std::size_t>(
      std::clamp<std::int64_t>(most_ranked_samples - first, 0, static_cast<std::int64_t>(rows.rows())));
  if (end == 0) return;
  std::vector<std::vector<double>> values;
  for (const SampleIntensity& intensity : intensities_) values.push_back(intensity(rows));
  const std::size_t outcome = column_index(rows.columns, "outcome"), motion = column_index(rows.columns, "motion"),
                    period = column_index(rows.columns, "pulse_period_s");
  std::vector<std::size_t> edp_column;
  for (const auto& edp : tally_.options().edps) edp_column.push_back(column_index(rows.columns, "edp_" + edp.name));
  std::vector<double> im(intensities_.size()), edp(edp_column.size());
  for (std::size_t row = 0; row < end; ++row) {
    const auto ended = static_cast<Outcome>(rows.at(row, outcome));
    if (!target_.keeps(static_cast<std::uint64_t>(first) + row)) continue;
    if (ended != Outcome::at_rest && ended != Outcome::moved && ended != Outcome::overturned) continue;
    for (std::size_t k = 0; k < im.size(); ++k) im[k] = values[k][row];
    for (std::size_t e = 0; e < edp.size(); ++e) edp[e] = rows.at(row, edp_column[e]);
    tally_.add({.index = static_cast<std::uint64_t>(first) + row,
                .motion = static_cast<int>(rows.at(row, motion)),
                .overturned = ended == Outcome::overturned,
                .pulse_period_s = rows.at(row, period),
                .im = im,
                .edp = edp});
  }
}

Ranking RankingCounts::ranking(std::span<const std::int64_t> words, std::int64_t alike, std::int64_t swept) const {
  return {std::min(alike, most_ranked_samples), swept,
          rank(fragility::RankingTally::from_words(tally_.options(), words))};
}

Ranking rank_intensities(const parallel::Communicator& world, const Study& study, const Target& target,
                         const io::SampleReader& reader) {
  RankingCounts counts(study, target, reader.motions().group, motion_summaries(reader.motions()));
  const std::int64_t alike = rows_alike(reader);
  const io::BlockLayout layout{std::min(alike, most_ranked_samples), rows_of_a_block};
  for (std::int64_t block = world.rank(); block < layout.blocks(); block += world.size())
    counts.add(reader.read(block * rows_of_a_block, layout.rows(block), counts.columns()), block * rows_of_a_block);
  parallel::Words words = counts.words();
  world.sum_in_place(words);
  if (!world.is_root()) return {};
  return counts.ranking(words, alike, reader.rows());
}

ordered_json ranking_json(const Ranking& ranking) {
  ordered_json json = {{"samples", ranking.samples}, {"swept", ranking.swept}, {"demands", ordered_json::object()}};
  for (const RankedDemand& demand : ranking.demands) {
    ordered_json ims = ordered_json::array();
    for (const RankedIm& im : demand.ims) {
      const char* figure = demand.binary ? "deviance_explained" : "scatter";
      ordered_json entry = {
          {"im", im.im}, {"samples", im.samples}, {"samples_with_im", im.with_im}, {figure, number_json(im.value)}};
      entry[std::string(figure) + "_se"] = number_json(im.value_se);
      entry["behind_best"] = number_json(im.behind);
      entry["behind_best_se"] = number_json(im.behind_se);
      if (demand.binary) {
        entry["parts_pairs"] = number_json(im.parts);
      } else {
        entry["slope"] = number_json(im.slope);
        entry["sufficiency"] = ordered_json::array();
        for (const auto& s : im.sufficiency)
          entry["sufficiency"].push_back({{"on", s.property},
                                          {"motions", s.motions},
                                          {"slope", number_json(s.slope)},
                                          {"slope_se", number_json(s.slope_se)},
                                          {"p", number_json(s.p)}});
      }
      ims.push_back(std::move(entry));
    }
    json["demands"][demand.edp] = std::move(ims);
  }
  return json;
}

std::string ranking_csv(const Ranking& ranking) {
  std::string text =
      "edp,rank,im,samples,samples_with_im,scatter,deviance_explained,se,behind_best,behind_best_se,slope,parts_pairs,"
      "left_on,left_"
      "motions,"
      "left_slope,left_slope_se,left_p\n";
  for (const RankedDemand& demand : ranking.demands)
    for (std::size_t i = 0; i < demand.ims.size(); ++i) {
      const RankedIm& im = demand.ims[i];
      const std::string head =
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", demand.edp, i + 1, im.im, im.samples, im.with_im,
                      demand.binary ? "" : cell(im.value), demand.binary ? cell(im.value) : "", cell(im.value_se),
                      cell(im.behind), cell(im.behind_se), cell(im.slope), cell(im.parts));
      if (im.sufficiency.empty()) text += head + ",,,,,\n";
      for (const auto& s : im.sufficiency)
        text +=
            fmt::format("{},{},{},{},{},{}\n", head, s.property, s.motions, cell(s.slope), cell(s.slope_se), cell(s.p));
    }
  return text;
}

std::string ranking_text(const Ranking& ranking, const Study& study, bool all) {
  std::string text;
  for (const RankedDemand& demand : ranking.demands) text += all ? table(demand) : one_line(demand, study);
  if (text.empty()) return text;
  const std::string which = ranking.samples < ranking.swept
                                ? fmt::format("of the first {} of {} samples", ranking.samples, ranking.swept)
                                : fmt::format("of all {} samples", ranking.samples);
  if (all)
    text += fmt::format("\n{}; standard errors and p values take motions, not samples, as the unit\n", which);
  else if (ranking.samples < ranking.swept)
    text += fmt::format("intensities are ranked by demands {}\n", which);
  return text;
}

}  // namespace freestand::study
