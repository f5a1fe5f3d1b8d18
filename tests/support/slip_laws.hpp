// Effects of the floor and of a slip that packs of samples know. Friction that follows the slip: of its speed, in two shapes: a drop p0 of
// the coefficient over a speed p1 [m/s]; of its path: p0 of it is left after a path p1 [m]; of its direction: an excess p0 against slips to
// the right; and of all three. A spring p0 [1/s2] and a drag p1 [1/s] along the floor.
#pragma once

#include <cmath>
#include <freestand/specimen.hpp>

#include "base/units.hpp"
#include "dynamics/effect.hpp"
#include "support/keyed_random.hpp"

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

inline const dynamics::Effect pulled{
    .name = "pulled", .force = [](const dynamics::At& at, const auto& p) { return -p[0] * at.u - p[1] * at.v; }};

inline const dynamics::Effect slope{.name = "slope", .floor = [](dynamics::FloorInput& floor, const auto& p) {
                                      floor.push_mps2 += standard_gravity_mps2 * std::sin(p[0]);
                                      floor.gravity_factor *= std::cos(p[0]);
                                    }};

// What the samples of a block have besides. Laws of the speed fall, or rise, in two shapes that come in turns.
enum class With { nothing, speed, path, spring, drag, spring_and_drag, direction, all_of_slip, slope };

inline EffectUse effect_with(With with, std::size_t i) {
  KeyedRandom random(171, i);
  const double drop = random.uniform(-0.3, 0.6), speed = random.log_uniform(0.02, 0.5);
  switch (with) {
    case With::speed:
      return {i % 3 == 0 ? &rational : &exponential, {drop, speed}};
    case With::path:
      return {&worn, {1 - drop, speed}};
    case With::spring:
      return {&pulled, {random.log_uniform(0.5, 100), 0}};
    case With::drag:
      return {&pulled, {0, random.log_uniform(0.1, 10)}};
    case With::spring_and_drag:
      return {&pulled, {random.log_uniform(0.5, 100), random.log_uniform(0.1, 10)}};
    case With::direction:
      return {&one_sided, {0.8 * drop}};
    case With::all_of_slip:
      return {&of_all, {0.8 * drop, speed}};
    default:
      return {&slope, {0.1 * drop}};
  }
}
inline bool has_sides(With with) { return with >= With::direction; }

}  // namespace freestand::test
