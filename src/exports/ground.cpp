#include "exports/ground.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>
#include <string_view>

namespace freestand::exports {
namespace {

constexpr std::string_view of_records = "record.", under_building = "ground.";

bool is_of_records(const Intensity& im) { return im.name.starts_with(of_records); }

bool is_under_building(const Intensity& im) { return im.name.starts_with(under_building); }

}  // namespace

std::string ground_name(const Intensity& im) {
  if (im.of_a_floor)
    throw Error(
        fmt::format("{0} is that of the floor on which the equipment stands (hazard is known for the ground, under the "
                    "building): fit the sweep "
                    "over ground.{0}, and export that",
                    im.name));
  if (is_under_building(im)) return im.name.substr(under_building.size());
  const std::string name = is_of_records(im) ? im.name.substr(of_records.size()) : im.name;
  if (is_of_records(im) && name == "pta_g") return im.name;  // of a floor
  if (name == "sa_g" && !(im.period_s > 0))
    throw Error(fmt::format(
        "{} tells no period (a spectral acceleration has one): add --period with that of the table, in s", im.name));
  return name;
}

std::string of_the_ground(const Intensity& im, const char* target) {
  if (is_of_records(im))
    return fmt::format(
        "{} is what the table of records gives, at the scale of each sample; {} takes it for that of the ground",
        im.name, target);
  if (is_under_building(im))
    return fmt::format("{} is that of the ground under the building, at the scale of each sample, as {} takes it",
                       im.name, target);
  return fmt::format(
      "the intensity is that of the motion under the equipment, {}'s that of the ground: they are the same "
      "where the equipment stands on the ground; on a floor, give the records a building, or fit over an intensity of "
      "the ground that the table of records gives, as record.pga_g",
      target);
}

}  // namespace freestand::exports
