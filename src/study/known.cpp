#include "study/known.hpp"

#include "edp/edp.hpp"
#include "intensity/intensity.hpp"

namespace freestand::study {

Known registries() {
  Known known;
  for (const auto& edp : edp::all())
    known.edps.push_back(
        {edp.name, edp.binary, edp.default_capacities, edp.by_default, edp.still, edp.wants, {}, edp.censored});
  for (const auto* measure : intensity::all()) known.intensities.push_back(known_intensity(*measure));
  return known;
}

KnownIntensity known_intensity(const intensity::Measure& measure) {
  if (!measure.parameter) return {measure.name, "", 0};
  return {measure.name, measure.parameter->name, measure.parameter->fallback};
}

Study parse_stored(const std::string& expanded, const std::filesystem::path& origin) {
  return parse_study(expanded, origin, registries(), Files::ignore);
}

}  // namespace freestand::study
