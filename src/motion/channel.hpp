// A motion's segments as polynomials, for the files of this folder.
#pragma once

#include <algorithm>
#include <freestand/floor_motion.hpp>

#include "motion/peaks.hpp"
#include "motion/polynomial.hpp"

namespace freestand::motion {

// Acceleration of segment i in the time since its start.
inline Polynomial segment(const FloorMotion& motion, const MotionValues& coefficients, std::size_t i) {
  Polynomial p;
  p.degree = motion.degree;
  const std::size_t terms = static_cast<std::size_t>(motion.degree) + 1;
  for (std::size_t k = 0; k < terms; ++k) p.c[k] = coefficients[i * terms + k];
  return p;
}

// The channels that a motion has: what is done to a record is done to each.
inline std::vector<MotionValues*> channels(FloorMotion& motion) {
  std::vector<MotionValues*> there;
  for (MotionValues* channel : {&motion.horizontal_mps2, &motion.vertical_mps2})
    if (!channel->empty()) there.push_back(channel);
  return there;
}

// The segment in which a time within the motion lies.
inline std::size_t segment_at(const FloorMotion& motion, double t) {
  const auto next = std::upper_bound(motion.knot_s.begin(), motion.knot_s.end() - 1, t);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - motion.knot_s.begin() - 1, 0));
}

inline double length(const FloorMotion& motion, std::size_t i) { return motion.knot_s[i + 1] - motion.knot_s[i]; }

inline const MotionValues& coefficients(const FloorMotion& motion, Channel channel) {
  return channel == Channel::horizontal ? motion.horizontal_mps2 : motion.vertical_mps2;
}

}  // namespace freestand::motion
