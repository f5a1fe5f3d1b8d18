// Synthetic motions of a study: from the number of a realisation to its parameters and its motion.
//
// Realisation n is a pure function of the seed, the name of its set and n: of each parameter one uniform (a stream of its own, so that
// one more parameter changes no other), and the white noise. Draws are independent, whatever the design of the samples: the
// motions are the unit of the statistics, which take them as independent of each other.
#pragma once

#include <cstdint>

#include "motion/synthetic.hpp"
#include "study/study.hpp"

namespace freestand::study {

// n = 0 ... part.count - 1.
motion::SyntheticParameters synthetic_parameters(const SyntheticPart&, std::uint64_t seed, std::uint64_t n);

// Named after its set and number, "synthetic 17". Throws Error (Exit::usage) where there is no such motion.
FloorMotion realisation(const SyntheticPart&, std::uint64_t seed, std::uint64_t n);

// What a realisation brings for intensities: its parameters, record.significant_5_95_expected_s and the like; record.arias_expected_mps for the
// expected Arias intensity, which its own is not.
std::vector<motion::RecordNumber> synthetic_numbers(const SyntheticPart&);
std::vector<double> synthetic_values(const motion::SyntheticParameters&);  // of these, in their order

// "" where every realisation can be made; else which one cannot, and why.
std::string refusal(const SyntheticPart&, std::uint64_t seed);

}  // namespace freestand::study
