#include "study/risk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <nlohmann/json.hpp>

#include "base/folder.hpp"
#include "decision/annual_rate.hpp"
#include "edp/edp.hpp"
#include "fragility/warnings.hpp"
#include "intensity/intensity.hpp"
#include "io/fragility_file.hpp"
#include "io/output_folder.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "study/build_catalogue.hpp"
#include "study/damage_states.hpp"
#include "study/read_parts.hpp"
#include "study/target.hpp"

namespace freestand::study {
namespace {

using Json = nlohmann::ordered_json;
using decision::By;

const std::string of_records = "record.";

// Intensities that have a unit are something of the motion alone, and have hazard curves; so may one that came with the records.
std::vector<std::string> measures(const fragility::Result& swept) {
  std::vector<std::string> names;
  for (const intensity::Measure* measure : intensity::all())
    if (measure->unit != "1") names.push_back(measure->name);
  for (const intensity::Measure* measure : intensity::of_the_ground()) names.push_back(measure->name);
  for (const char* of_ground : {"pga_g", "pgv_mps", "pgd_m", "sa_g"}) names.push_back(of_records + of_ground);
  if (std::find(names.begin(), names.end(), swept.im_name) == names.end() && swept.im_unit != "1")
    names.push_back(swept.im_name);
  return names;
}

// A sweep to fit anew: the folder itself, unless it holds a fit alone.
std::string to_fit(const std::filesystem::path& folder) {
  return is_there(folder / "samples.h5") || is_there(folder / "tally.h5")
             ? folder.string()
             : std::string("SWEEP");
}

io::FragilityFile fragility_of(const std::filesystem::path& folder) {
  refuse_database(folder);
  const std::filesystem::path file = folder / "fragility.h5";
  if (!is_there(file))
    throw Error(
        fmt::format(
            "{} has no fragility.h5 (it is no fitted sweep): give the folder of `freestand run`, or fit it first",
            folder.string()),
        Exit::data);
  return io::read_fragility(file);
}

// The period of the sweep's intensity, which the curve must share.
double period_of(const io::FragilityFile& fragility, const RiskOptions& options, const decision::HazardCurve& hazard) {
  const std::string& im = fragility.result.im_name;
  const intensity::Measure& measure = intensity::find(im);
  if (!measure.parameter) return 0;
  const FragilityPart part = parse_stored(fragility.provenance.study, options.folder).fragility;
  const double period = part.im.period_s.value_or(measure.parameter->fallback);
  if (hazard.period_s > 0 && std::abs(hazard.period_s / period - 1) > 1e-6)
    throw Error(fmt::format(
        "{} is of {} at {} s, the sweep was fitted over it at {} s: fit the sweep at {} s, or give the curve at {} s",
        options.hazard.string(), im, hazard.period_s, period, hazard.period_s, period));
  return period;
}

// Demands that every block which overturned is beyond.
std::vector<std::string> with_overturned(const io::FragilityFile& fragility, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const edp::Edp& demand : edp::all())
    if (demand.censored) names.push_back(demand.name);
  for (std::string& state : DamageStates(parse_stored(fragility.provenance.study, folder)).with_overturned())
    names.push_back(std::move(state));
  return names;
}

void refuse_another_intensity(const decision::HazardCurve& hazard, const io::FragilityFile& fragility,
                              const RiskOptions& options) {
  const fragility::Result& swept = fragility.result;
  const Study study = parse_stored(fragility.provenance.study, options.folder);
  if (hazard.measure == swept.im_name && is_of_a_floor(swept.im_name, study))
    throw Error(
        fmt::format("{0}:1: the curve is over {1}, and {2} was fitted over the {1} of the floor on which the equipment "
                    "stands (a hazard curve is "
                    "of the ground under the building): fit the sweep over ground.{1} (freestand fit {3} --im "
                    "ground.{1} -o FOLDER)",
                    options.hazard.string(), hazard.measure, options.folder.string(), to_fit(options.folder)));
  if (hazard.measure == swept.im_name || "ground." + hazard.measure == swept.im_name) return;
  if (swept.im_name == of_records + hazard.measure)
    throw Error(fmt::format(
        "{0}:1: the curve is over {1}, but {2} was fitted over {3} (the {1} of the motion under the equipment is "
        "another one, on "
        "a floor): where the curve is of the ground, as that of the table of records is, name its column {3}",
        options.hazard.string(), hazard.measure, options.folder.string(), swept.im_name));
  const bool said = hazard.measure.find('.') != std::string::npos;  // whose it is
  const std::string wanted = said || !in_a_building(study) ? hazard.measure : "ground." + hazard.measure;
  throw Error(fmt::format(
      "{}:1: the curve is over {}, but {} was fitted over {}: fit the sweep over {} (freestand fit {} --im {} -o "
      "FOLDER){}{}",
      options.hazard.string(), hazard.measure, options.folder.string(), swept.im_name, wanted, to_fit(options.folder),
      wanted,
      said || in_a_building(study)
          ? ""
          : fmt::format(", or, for equipment on a floor of a building and a curve "
                        "of the ground, give the records a building, or fit over {0}{1} out of the table of "
                        "records, with the curve's column called {0}{1}",
                        of_records, hazard.measure),
      swept.im_unit == "1" ? "" : fmt::format(", or give a curve over {}", swept.im_name)));
}

Json estimate_json(const decision::Rate& rate) {
  return {{"annual_rate", rate.value}, {"lower", rate.lower}, {"upper", rate.upper}};
}

const char* name(By by) { return by == By::function ? "function" : "counts"; }

Json row_json(const decision::RiskRow& row, const std::vector<double>& years) {
  Json json{{"edp", row.edp}, {"unit", row.unit}, {"capacity", row.capacity}, {"title", title(row)}};
  json["recommended"] = name(row.recommended);
  json["why"] = row.why;
  json["refused"] = row.refused;
  const decision::Rate told = row.refused.empty() ? row.rate() : decision::Rate{};
  json.update(estimate_json(told));
  json["in_years"] = Json::array();
  for (const double n : years)
    json["in_years"].push_back({{"years", n},
                                {"probability", decision::probability_in_years(told.value, n)},
                                {"lower", decision::probability_in_years(told.lower, n)},
                                {"upper", decision::probability_in_years(told.upper, n)}});
  json["by_function"] = estimate_json(row.by_function);
  json["by_counts"] = estimate_json(row.by_counts);
  if (std::isfinite(row.upper_if_falling)) json["upper_if_falling"] = row.upper_if_falling;
  json["outside_sweep"] = row.outside_sweep;
  json["outside_hazard"] = row.outside_hazard;
  json["median_im"] = row.median_im;
  json["median_beyond_hazard"] = std::isinf(row.median_im);
  json["share_by_im"] = row.share;
  return json;
}

std::string rate_cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

std::string cells(const decision::Rate& rate) {
  return fmt::format("{},{},{}", rate_cell(rate.value), rate_cell(rate.lower), rate_cell(rate.upper));
}

}  // namespace

RiskAnswer risk(const RiskOptions& options) {
  for (const double n : options.years)
    if (!(n > 0) || !std::isfinite(n))
      throw Error(fmt::format("--years {} (a time is positive): give years, as 50", n));
  if (is_folder(options.hazard))
    throw Error(fmt::format("{} is a folder (a hazard curve is a file): give hazard.csv", options.hazard.string()),
                Exit::data);
  if (!is_there(options.hazard))
    throw Error(fmt::format("{} cannot be read (no such file): check the path", options.hazard.string()), Exit::data);
  const io::FragilityFile fragility = fragility_of(options.folder);
  const decision::HazardCurve hazard =
      decision::parse_hazard(read_text(options.hazard), options.hazard.string(), measures(fragility.result));
  refuse_another_intensity(hazard, fragility, options);
  RiskAnswer answer{hazard, decision::risk(fragility.result, hazard, with_overturned(fragility, options.folder)),
                    fragility.provenance.study_name, period_of(fragility, options, hazard),
                    target_told(parse_stored(fragility.provenance.study, options.folder))};
  if (const std::string few = fragility::told_of_motions(fragility.result); !few.empty())
    answer.risk.warnings.insert(answer.risk.warnings.begin(), few);
  if (answer.period_s > 0 && hazard.period_s == 0)
    answer.risk.warnings.push_back(
        fmt::format("{} tells no period: its {} is taken to be at {} s, as the sweep's (a column period_s says it)",
                    options.hazard.string(), hazard.measure, answer.period_s));
  return answer;
}

Json risk_json(const RiskAnswer& answer, const RiskOptions& options) {
  const decision::Risk& risk = answer.risk;
  Json json{{"format", risk_format},
            {"sweep", std::filesystem::absolute(options.folder).filename().string()},
            {"study_name", answer.study_name},
            {"command", options.command},
            {"target", answer.target},
            {"im", risk.im},
            {"im_unit", risk.im_unit},
            {"period_s", answer.period_s > 0 ? Json(answer.period_s) : Json()},
            {"confidence", risk.confidence},
            {"hazard", {{"im", answer.hazard.im}, {"annual_rate", answer.hazard.annual_rate}}},
            {"swept", {risk.im_least, risk.im_most}},
            {"years", options.years},
            {"im_edge", risk.edge},
            {"demands", Json::array()}};
  for (const decision::RiskRow& row : risk.rows) json["demands"].push_back(row_json(row, options.years));
  json["warnings"] = risk.warnings;
  return json;
}

std::string risk_csv(const RiskAnswer& answer, const RiskOptions& options) {
  std::string text = "edp,unit,capacity,annual_rate,annual_rate_lower,annual_rate_upper";
  for (const double n : options.years)
    text += fmt::format(",probability_{0}y,probability_{0}y_lower,probability_{0}y_upper", n);
  text +=
      ",recommended,by_function,by_function_lower,by_function_upper,by_counts,by_counts_lower,by_counts_upper,outside_"
      "sweep,"
      "outside_hazard,median_im\n";
  for (const decision::RiskRow& row : answer.risk.rows) {
    const decision::Rate told = row.refused.empty() ? row.rate() : decision::Rate{};
    text += fmt::format("{},{},{},{}", row.edp, row.unit, rate_cell(row.capacity), cells(told));
    for (const double n : options.years)
      for (const double rate : {told.value, told.lower, told.upper})
        text += fmt::format(",{}", rate_cell(decision::probability_in_years(rate, n)));
    text += fmt::format(",{},{},{},{},{},{}\n", name(row.recommended), cells(row.by_function), cells(row.by_counts),
                        rate_cell(row.outside_sweep), rate_cell(row.outside_hazard), rate_cell(row.median_im));
  }
  return text;
}

void write_risk(const RiskAnswer& answer, const RiskOptions& options) {
  std::error_code ignored;
  if (std::filesystem::equivalent(options.output, options.folder, ignored))
    throw Error(fmt::format("{} is the sweep itself (its results would be replaced): name another folder with -o",
                            options.output.string()));
  io::take_output_folder(options.output, io::existing(options.overwrite),
                         {.writes = {"risk.csv", "risk.json"}, .reads = {options.hazard}});
  io::write_result(options.output / "risk.csv", risk_csv(answer, options));
  io::write_result(options.output / "risk.json", io::json_text(risk_json(answer, options)));
}

}  // namespace freestand::study
