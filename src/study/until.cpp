#include "study/until.hpp"

#include <fmt/format.h>

#include "fragility/fit.hpp"

namespace freestand::study {

std::string not_reached(const Study& study, const fragility::Result& result) {
  if (!study.until) return "";
  const fragility::HalfWidth reached = fragility::half_width(result);
  if (reached.largest <= study.until->half_width) return "";
  const std::string where =
      reached.edp.empty() ? "" : fmt::format(", {} at an intensity of {:.3g} the least", reached.edp, reached.im);
  return fmt::format(
      "the surface was to be known to +-{:.3g}, and after {} samples, the most that until allows, it is known to "
      "+-{:.3g}{}: raise at_most, take more records, or wider bins",
      study.until->half_width, result.samples, reached.largest, where);
}

void tell_until(const Study& study, const fragility::Result& result, nlohmann::ordered_json& summary) {
  if (!study.until) return;
  const fragility::HalfWidth reached = fragility::half_width(result);
  const std::string warning = not_reached(study, result);
  summary["until"] = {{"half_width_wanted", study.until->half_width},
                      {"half_width_reached", reached.largest},
                      {"reached", warning.empty()},
                      {"samples", result.samples},
                      {"at_most", study.until->at_most},
                      {"widest", {{"edp", reached.edp}, {"im", reached.im}, {"capacity", reached.capacity}}}};
  if (warning.empty()) return;
  summary["warnings"].push_back(warning);
  fmt::print(stderr, "{}\n", warning);
}

}  // namespace freestand::study
