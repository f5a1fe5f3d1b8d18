// What `freestand im` and `freestand edp` tell, from the registries.
#pragma once

#include <functional>
#include <string>

namespace freestand::study {

struct MeasurePages {
  // Of one of them, or the list of all for an empty name. Throw Error for a name that there is not.
  std::function<std::string(const std::string&name)> page, json;
};

MeasurePages intensities_catalogue();
MeasurePages demands_catalogue();

}  // namespace freestand::study
