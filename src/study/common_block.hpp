// The `block:` above the entries of a catalogue: what an entry does not say itself.
#pragma once

#include <yaml-cpp/yaml.h>

namespace freestand::study {

// The keys of `own`, and those of `common` that it neither has nor says in another way (slenderness_rad and size_m for width_m and
// height_m, gyration_radius_m for inertia_kgm2). Keys keep the lines on which they stand. Both are mappings.
YAML::Node joined_block(const YAML::Node& own, const YAML::Node& common);

// The common block as one that can be checked by itself: with sides, where it leaves them to the entries, and then without what depends
// on them. As it is where it is no mapping.
YAML::Node block_to_check(const YAML::Node& common);

}  // namespace freestand::study
