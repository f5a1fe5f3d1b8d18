// Friction that follows the slip. Of its speed, in two shapes: a drop p0 of the coefficient over a speed p1 [m/s]; of its path: p0 of it is
// left after a path p1 [m]; of its direction: an excess p0 against slips to the right; and of all three.
#pragma once

#include "dynamics/effect.hpp"

namespace freestand::test {

inline const dynamics::Effect exponential{.name = "exponential", .friction = [](const dynamics::At& at, const auto& p) {
                                            return 1.0 - p[0] * (1.0 - exp(-at.speed / p[1]));
                                          }};
inline const dynamics::Effect rational{.name = "rational", .friction = [](const dynamics::At& at, const auto& p) {
                                         return (p[1] + (1 - p[0]) * at.speed) / (p[1] + at.speed);
                                       }};
inline const dynamics::Effect worn{.name = "worn", .friction = [](const dynamics::At& at, const auto& p) {
                                     return p[0] + (1.0 - p[0]) * exp(-at.path / p[1]);
                                   }};
inline const dynamics::Effect one_sided{
    .name = "one_sided", .friction = [](const dynamics::At& at, const auto& p) { return 1.0 + p[0] * at.sigma; }};
inline const dynamics::Effect of_all{.name = "of_all", .friction = [](const dynamics::At& at, const auto& p) {
                                       return (1.0 + p[0] * at.sigma) * (0.7 + 0.3 * exp(-at.speed / p[1])) /
                                              (1.0 + 0.5 * at.path);
                                     }};

}  // namespace freestand::test
