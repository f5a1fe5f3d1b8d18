#include "study/until.hpp"

#include <fmt/format.h>

#include <cmath>

namespace freestand::study {
namespace {

std::string place_of(const fragility::HalfWidth& width) {
  if (width.edp.empty()) return "";
  const std::string axis = width.axis.empty() ? "" : fmt::format(" and {} of {:.3g}", width.axis, width.on_axis);
  return fmt::format(", {} at an intensity of {:.3g}{} the least", width.edp, width.im, axis);
}

// What would help: more samples, or only more records.
std::string helps(const Study& study, const fragility::Outlook& outlook) {
  if (std::isinf(outlook.samples))
    return fmt::format(
        "it would stay at +-{:.2g} however many samples are made of these records: take more records, or wider bins",
        outlook.stays);
  return fmt::format("some {:.2g} samples are needed: raise at_most from {}, or take wider bins", outlook.samples,
                     study.until->at_most);
}

}  // namespace

fragility::Wanted wanted(const Study& study) {
  return {study.until->half_width, static_cast<double>(study.until->at_most), study.fragility.minimum_samples};
}

std::string round_told(const Study& study, const fragility::Result& result) {
  const fragility::HalfWidth reached = fragility::half_width(result, wanted(study));
  std::string text = fmt::format("{} samples: the surface is known to +-{:.3f} (wanted +-{:.3f})", result.samples,
                                 reached.largest, study.until->half_width);
  if (reached.largest <= study.until->half_width) return text;
  const fragility::Outlook outlook = fragility::outlook(result, wanted(study));
  if (outlook.samples <= static_cast<double>(study.until->at_most))
    return text + fmt::format("; some {:.2g} samples are needed", outlook.samples);
  return text + "; " + helps(study, outlook);
}

std::string not_reached(const Study& study, const fragility::Result& result) {
  if (!study.until) return "";
  const fragility::HalfWidth reached = fragility::half_width(result, wanted(study));
  if (reached.largest <= study.until->half_width) return "";
  return fmt::format(
      "the surface was to be known to +-{:.3g}, and after {} samples, the most that until allows, it is known to "
      "+-{:.3g}{} ({})",
      study.until->half_width, result.samples, reached.largest, place_of(reached),
      helps(study, fragility::outlook(result, wanted(study))));
}

void tell_until(const Study& study, const fragility::Result& result, nlohmann::ordered_json& summary) {
  if (!study.until) return;
  const fragility::HalfWidth reached = fragility::half_width(result, wanted(study));
  const fragility::Outlook outlook = fragility::outlook(result, wanted(study));
  const std::string warning = not_reached(study, result);
  nlohmann::ordered_json widest = {{"edp", reached.edp}, {"im", reached.im}, {"capacity", reached.capacity}};
  if (!reached.axis.empty()) widest[reached.axis] = reached.on_axis;
  summary["until"] = {{"half_width_wanted", study.until->half_width},
                      {"half_width_reached", reached.largest},
                      {"reached", warning.empty()},
                      {"samples", result.samples},
                      {"at_most", study.until->at_most},
                      {"widest", widest},
                      {"stays_above", outlook.stays},
                      {"samples_needed", nullptr},
                      {"rare_cells", reached.rare_cells}};
  if (std::isfinite(outlook.samples)) summary["until"]["samples_needed"] = std::round(outlook.samples);
  if (warning.empty()) return;
  summary["warnings"].push_back(warning);
  fmt::print(stderr, "{}\n", warning);
}

}  // namespace freestand::study
