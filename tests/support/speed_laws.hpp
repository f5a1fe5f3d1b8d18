// Friction that follows the slip speed, in two shapes: a drop p0 of the coefficient over a speed p1 [m/s].
#pragma once

#include "dynamics/effect.hpp"

namespace freestand::test {

inline const dynamics::Effect exponential{.name = "exponential", .friction = [](const dynamics::At& at, const auto& p) {
                                            return 1.0 - p[0] * (1.0 - exp(-at.speed / p[1]));
                                          }};
inline const dynamics::Effect rational{.name = "rational", .friction = [](const dynamics::At& at, const auto& p) {
                                         return (p[1] + (1 - p[0]) * at.speed) / (p[1] + at.speed);
                                       }};

}  // namespace freestand::test
