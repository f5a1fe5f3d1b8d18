#include "study/known.hpp"

#include "edp/edp.hpp"
#include "intensity/intensity.hpp"

namespace freestand::study {

Known registries() {
  Known known;
  for (const auto& edp : edp::all())
    known.edps.push_back({edp.name, edp.binary, edp.default_capacities, edp.by_default, edp.still, edp.wants});
  for (const auto* measure : intensity::all()) {
    KnownIntensity intensity{measure->name, "", 0};
    if (measure->parameter) {
      intensity.parameter = measure->parameter->name;
      intensity.fallback = measure->parameter->fallback;
    }
    known.intensities.push_back(std::move(intensity));
  }
  return known;
}

Study parse_stored(const std::string& expanded, const std::filesystem::path& origin) {
  return parse_study(expanded, origin, registries(), Files::ignore);
}

}  // namespace freestand::study
