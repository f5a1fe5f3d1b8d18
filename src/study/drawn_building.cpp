#include "study/drawn_building.hpp"

#include "study/keyed_draw.hpp"

namespace freestand::study {

motion::Building drawn(const BuildingPart& part, std::uint64_t seed, const std::string& record) {
  const auto draw = [&](const Quantity& quantity) {
    return keyed_draw(seed, random::stable_hash(record), part.name, quantity);
  };
  motion::Building building = part;
  if (part.drawn_period) building.period_s = draw(*part.drawn_period);
  if (part.drawn_damping) building.damping = draw(*part.drawn_damping);
  return building;
}

}  // namespace freestand::study
