#include "study/drawn_building.hpp"

#include "base/random.hpp"

namespace freestand::study {

motion::Building drawn(const BuildingPart& part, std::uint64_t seed, const std::string& record) {
  const auto draw = [&](const Quantity& quantity) {
    const bool joint = std::holds_alternative<sampling::Posterior>(quantity.value);  // one row for all its columns
    const std::string stream = part.name + "." + (joint ? quantity.stream() : quantity.name);
    return quantile(quantity.value, random::uniform(seed, random::stable_hash(record), random::stable_hash(stream)));
  };
  motion::Building building = part;
  if (part.drawn_period) building.period_s = draw(*part.drawn_period);
  if (part.drawn_damping) building.damping = draw(*part.drawn_damping);
  return building;
}

}  // namespace freestand::study
