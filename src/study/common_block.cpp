#include "study/common_block.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace freestand::study {
namespace {

using Keys = std::vector<std::string>;

bool has(const YAML::Node& map, const std::string& key) { return static_cast<bool>(map[key]); }

bool has_any(const YAML::Node& map, const Keys& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return has(map, key); });
}

// Two ways to say one thing.
struct Either {
  Keys one, other;
};
const Either ways[] = {{{"width_m", "height_m"}, {"slenderness_rad", "size_m"}},
                       {{"gyration_radius_m"}, {"inertia_kgm2"}}};

bool said_otherwise(const YAML::Node& own, const std::string& key) {
  const auto is_of = [&](const Keys& keys) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  return std::any_of(std::begin(ways), std::end(ways), [&](const Either& way) {
    return (is_of(way.one) && has_any(own, way.other)) || (is_of(way.other) && has_any(own, way.one));
  });
}

}  // namespace

YAML::Node joined_block(const YAML::Node& own, const YAML::Node& common) {
  YAML::Node block(YAML::NodeType::Map);
  for (const auto& pair : own) block.force_insert(pair.first, pair.second);
  for (const auto& pair : common)
    if (const std::string key = pair.first.Scalar(); !has(own, key) && !said_otherwise(own, key))
      block.force_insert(pair.first, pair.second);
  return block;
}

YAML::Node block_to_check(const YAML::Node& common) {
  if (!common.IsMap()) return common;
  const bool slender = has_any(common, ways[0].other);
  const Keys sides = slender ? ways[0].other : ways[0].one;
  if (std::all_of(sides.begin(), sides.end(), [&](const std::string& key) { return has(common, key); })) return common;
  YAML::Node block(YAML::NodeType::Map);
  const Keys of_sides = {"centre_height_m", "gyration_radius_m", "inertia_kgm2"};
  for (const auto& pair : common)
    if (std::find(of_sides.begin(), of_sides.end(), pair.first.Scalar()) == of_sides.end())
      block.force_insert(pair.first, pair.second);
  return joined_block(block, slender ? YAML::Load("{slenderness_rad: {uniform: [0.3, 0.4]}, size_m: {uniform: [1, 2]}}")
                                     : YAML::Load("{width_m: {uniform: [0.5, 0.6]}, height_m: {uniform: [1, 2]}}"));
}

}  // namespace freestand::study
