#include "study/until.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace freestand::study {
namespace {

std::string place_of(const fragility::HalfWidth& width) {
  const std::string axis = width.axis.empty() ? "" : fmt::format(" and {} of {:.3g}", width.axis, width.on_axis);
  return fmt::format("{} at an intensity of {:.3g}{}", width.edp, width.im, axis);
}

// A half width is known, and wanted, of all points together; with relative errors alone it is that of each.
std::string at_once(const Study& study, const fragility::HalfWidth& width) {
  if (!wanted(study, {}).at_once() || width.points < 2) return "";
  return fmt::format(" at all {} points at once", width.points);
}

// Where errors are relative the widest band may be wide enough, and a narrower one not.
std::string farthest_told(const Study& study, const fragility::HalfWidth& width) {
  if (!study.until->relative_error || width.edp.empty()) return "";
  return fmt::format(", and where most is missing ({}) to +-{:.3g}, which is {:.2g} times what is wanted",
                     place_of(width), width.farthest, width.times_wanted);
}

// "+-0.020", "20 % of P down to 0.001", or both.
std::string wanted_text(const UntilPart& until, const std::string& half_width) {
  const std::string width = fmt::format(fmt::runtime(half_width), until.half_width);
  if (!until.relative_error) return width;
  const std::string relative =
      fmt::format("a standard error of {:.3g} % of P down to {:g}", 100 * *until.relative_error, until.down_to);
  return until.half_width < 0.5 ? width + " and " + relative : relative;
}

// What would help: more samples, or only more records.
std::string helps(const Study& study, const fragility::Outlook& outlook, const Drawn& drawn) {
  if (std::isinf(outlook.samples))
    return fmt::format(
        "it would stay at +-{:.2g} however many samples are made of these records: take more records, or wider bins",
        outlook.stays);
  const auto at_most = static_cast<std::int64_t>(study.until->at_most);
  // Of a bin that was passed over no more is known than that its samples are of some of those drawn.
  const char* kind = outlook.at_least ? "more than " : drawn.alike < drawn.samples ? "up to some " : "some ";
  std::string told = fmt::format("{}{:.2g} samples are needed", kind, outlook.samples);
  if (outlook.samples > static_cast<double>(at_most) || (outlook.at_least && drawn.samples == at_most))
    told += fmt::format(": raise at_most from {}{}, or take wider bins", at_most,
                        study.keep.one_in == 1 ? "" : " and sweep anew (to what is only counted none is added)");
  return told + (outlook.at_least ? " (some points have no band yet, and may need many more)" : "");
}

// Where no sample fell.
std::string empty_told(const fragility::HalfWidth& width, const Drawn& drawn) {
  if (width.empty_bins.empty()) return "";
  return fmt::format(
      "none of the {} samples drawn lies in the bins of intensity about {:.3g}: they are left empty, and not waited "
      "for",
      drawn.samples, fmt::join(width.empty_bins, ", "));
}

std::string samples_told(const fragility::Result& result, const Drawn& drawn) {
  if (drawn.samples == result.samples) return fmt::format("{} samples", result.samples);
  return fmt::format("{} samples, {} of them counted", drawn.samples, result.samples);
}

}  // namespace

fragility::Wanted wanted(const Study& study, const Drawn& drawn) {
  fragility::Wanted wanted{.half_width = study.until->half_width,
                           .at_most = static_cast<double>(study.until->at_most),
                           .minimum_samples = study.fragility.minimum_samples,
                           .drawn = static_cast<double>(drawn.samples)};
  if (study.until->relative_error)
    wanted.relative_error = *study.until->relative_error, wanted.down_to = study.until->down_to;
  return wanted;
}

std::string round_told(const Study& study, const fragility::Result& result, const Drawn& drawn) {
  const fragility::HalfWidth reached = fragility::half_width(result, wanted(study, drawn));
  std::string text =
      fmt::format("{}: the surface is known to +-{:.3g}{}{} (wanted {})", samples_told(result, drawn), reached.largest,
                  at_once(study, reached), farthest_told(study, reached), wanted_text(*study.until, "+-{:.3f}"));
  if (const std::string empty = empty_told(reached, drawn); !empty.empty()) text += "; " + empty;
  if (reached.times_wanted <= 1) return text;
  return text + "; " + helps(study, fragility::outlook(result, wanted(study, drawn)), drawn);
}

std::string not_reached(const Study& study, const fragility::Result& result, const Drawn& drawn) {
  if (!study.until) return "";
  const fragility::HalfWidth reached = fragility::half_width(result, wanted(study, drawn));
  if (reached.times_wanted <= 1) return "";
  const fragility::Outlook outlook = fragility::outlook(result, wanted(study, drawn));
  const bool all = drawn.samples == static_cast<std::int64_t>(study.until->at_most);
  return fmt::format("the surface was to be known to {}, and after {}{} it is known to +-{:.3g}{} ({})",
                     wanted_text(*study.until, "+-{:.3g}" + at_once(study, reached)), samples_told(result, drawn),
                     all                           ? ", the most that until allows,"
                     : std::isinf(outlook.samples) ? ", where more would hardly help,"
                                                   : "",
                     reached.farthest, reached.edp.empty() ? "" : fmt::format(", {} the least", place_of(reached)),
                     helps(study, outlook, drawn));
}

std::string passed_over_told(const Drawn& drawn) {
  if (drawn.samples == drawn.alike) return "";
  return fmt::format(
      "from sample {} of {} on only those were integrated that lie in bins which were not known well enough: surfaces "
      "over this "
      "intensity hold, bin by bin; shares of all samples (how they ended, regressions over all bins) lean towards "
      "those bins, and so "
      "does a fragility function that is not adequate",
      drawn.alike, drawn.samples);
}

void tell_until(const Study& study, const fragility::Result& result, const Drawn& drawn,
                nlohmann::ordered_json& summary) {
  if (!study.until) return;
  const fragility::HalfWidth reached = fragility::half_width(result, wanted(study, drawn));
  const fragility::Outlook outlook = fragility::outlook(result, wanted(study, drawn));
  const std::string warning = not_reached(study, result, drawn);
  nlohmann::ordered_json farthest = {{"edp", reached.edp}, {"im", reached.im}, {"capacity", reached.capacity}};
  if (!reached.axis.empty()) farthest[reached.axis] = reached.on_axis;
  farthest["half_width"] = reached.farthest;
  nlohmann::ordered_json& until = summary["until"];
  until["half_width_wanted"] = nullptr;
  if (wanted(study, {}).at_once()) until["half_width_wanted"] = study.until->half_width;
  if (study.until->relative_error) {
    until["relative_error_wanted"] = *study.until->relative_error;
    until["down_to"] = study.until->down_to;
  }
  until["half_width_reached"] = reached.largest;
  until["points"] = reached.points;
  until["times_wanted"] = std::isfinite(reached.times_wanted) ? nlohmann::ordered_json(reached.times_wanted) : nullptr;
  until["reached"] = warning.empty();
  until["samples"] = result.samples;
  until["drawn"] = drawn.samples;
  until["alike"] = drawn.alike;
  until["at_most"] = study.until->at_most;
  until["farthest"] = farthest;
  until["stays_above"] = outlook.stays;
  until["samples_needed"] = nullptr;
  until["rare_cells"] = reached.rare_cells;
  until["empty_bins"] = reached.empty_bins;
  if (const std::string empty = empty_told(reached, drawn); !empty.empty()) summary["warnings"].push_back(empty);
  if (std::isfinite(outlook.samples)) until["samples_needed"] = std::round(outlook.samples);
  if (warning.empty()) return;
  summary["warnings"].push_back(warning);
  fmt::print(stderr, "{}\n", warning);
}

}  // namespace freestand::study
