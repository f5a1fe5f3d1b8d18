// Numbers of what a study makes once and not for each sample, a building or a synthetic motion: drawn by a key of their own.
#pragma once

#include <cstdint>
#include <string>

#include "base/random.hpp"
#include "study/study.hpp"

namespace freestand::study {

// Uniform in (0, 1): a pure function of the seed, the key of the one that is made, the name of its set, and the parameter's.
inline double keyed_uniform(std::uint64_t seed, std::uint64_t key, const std::string& set,
                            const std::string& parameter) {
  return random::uniform(seed, key, random::stable_hash(set + "." + parameter));
}

// Columns of one table of joint draws share their uniform, so that a row stays together.
inline double keyed_draw(std::uint64_t seed, std::uint64_t key, const std::string& set, const Quantity& quantity) {
  const bool joint = std::holds_alternative<sampling::Posterior>(quantity.value);
  return quantile(quantity.value, keyed_uniform(seed, key, set, joint ? quantity.stream() : quantity.name));
}

}  // namespace freestand::study
