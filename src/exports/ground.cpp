#include "exports/ground.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>
#include <string_view>

namespace freestand::exports {
namespace {

constexpr std::string_view of_records = "record.";

bool is_of_records(const Intensity& im) { return im.name.starts_with(of_records); }

}  // namespace

std::string ground_name(const Intensity& im) {
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
  return fmt::format(
      "the intensity is that of the motion under the equipment, {}'s that of the ground: they are the same "
      "where the equipment stands on the ground; on a floor, fit over an intensity of the ground that the table "
      "of records gives, as record.pga_g",
      target);
}

}  // namespace freestand::exports
