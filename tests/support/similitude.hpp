// Similitude [KM05 ch. 7]: lengths / 4 go with times / 2. Then velocities are halved, accelerations, angles and
// coefficients stay, and a run at both scales gives one dimensionless answer: slip over size, rotation, outcome, counts,
// accelerations. A parameter scales by its unit: m 1/4, m/s 1/2, Hz and 1/s 2, rad and 1 not at all. Mass goes with the
// cube of the length (same density).
//
// All these factors are powers of two, which rounding does not see. So where nothing in a program has a length or a time
// of its own, both answers are the same to the bit, whatever the chaos of the case.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "base/units.hpp"
#include "dynamics/effect.hpp"
#include "support/random_cases.hpp"
#include "support/repeats.hpp"
#include "support/solvers.hpp"

namespace freestand::test {

struct Scale {
  double length, time;
  double mass() const { return length * length * length; }
};
inline const Scale report_scale{1.0 / 4, 1.0 / 2};

// How the parameter of an effect scales.
inline double factor_of(const std::string& unit, const Scale& scale) {
  const std::map<std::string, double> factors = {{"1", 1},
                                                 {"", 1},
                                                 {"rad", 1},
                                                 {"m", scale.length},
                                                 {"m/s", scale.length / scale.time},
                                                 {"Hz", 1 / scale.time},
                                                 {"1/s", 1 / scale.time}};
  return factors.at(unit);
}

inline Block scaled(Block block, const Scale& scale) {
  for (double* length : {&block.left_m, &block.right_m, &block.height_m}) *length *= scale.length;
  block.gyration2_m2 *= scale.length * scale.length;
  block.mass_kg *= scale.mass();
  return block;
}

inline Specimen scaled(Specimen specimen, const Scale& scale) {
  specimen.block = scaled(specimen.block, scale);
  specimen.bouc_wen.yield_displacement_m *= scale.length;
  for (EffectUse& use : specimen.effects)
    for (std::size_t i = 0; i < use.parameters.size(); ++i)
      use.parameters[i] *= factor_of(use.effect->parameters.at(i).unit, scale);
  return specimen;
}

inline FloorMotion scaled(FloorMotion motion, const Scale& scale) {
  for (double& knot : motion.knot_s) knot *= scale.time;
  for (MotionValues* channel : {&motion.horizontal_mps2, &motion.vertical_mps2})
    for (std::size_t i = 0; i < channel->size(); ++i)
      (*channel)[i] /= std::pow(scale.time, static_cast<double>(i % (static_cast<std::size_t>(motion.degree) + 1)));
  index_runs(motion);
  return motion;
}

inline Settings scaled(Settings settings, const Scale& scale) {
  settings.free_vibration_s *= scale.time;
  return settings;
}

// The answer of the small specimen, as the large one would give it.
inline Response enlarged(Response response, const Scale& scale) {
  for (double* length : {&response.peak_slip_m, &response.residual_slip_m, &response.slid_path_m})
    *length /= scale.length;
  response.end_time_s /= scale.time;
  return response;
}

struct Pair {
  std::string text;
  Specimen large, small;
  std::shared_ptr<const FloorMotion> large_motion, small_motion;
  Shaking large_shaking, small_shaking;

  // Over which slips are dimensionless.
  double length() const {
    return large.model == Model::bouc_wen ? large.bouc_wen.yield_displacement_m : large.block.size_m();
  }
};

inline Pair pair_of(const std::string& text, const Specimen& specimen, const std::shared_ptr<const FloorMotion>& motion,
                    const Shaking& shaking, const Scale& scale) {
  Pair pair{text,    specimen, scaled(specimen, scale), motion, std::make_shared<FloorMotion>(scaled(*motion, scale)),
            shaking, shaking};
  pair.small_shaking.motion = pair.small_motion.get();
  return pair;
}

inline Pair pair_of(const RandomCase& c, const Scale& scale) {
  return pair_of(c.text(), c.specimen, c.motion, c.shaking, scale);
}

struct Answers {
  Response large, small;  // the small one enlarged
};

using Solve = Response (*)(const Specimen&, const Shaking&, const Settings&, History*);

inline Answers solve(Solve solver, const Pair& pair, const Scale& scale, const Settings& settings = {}) {
  return {solver(pair.large, pair.large_shaking, settings, nullptr),
          enlarged(solver(pair.small, pair.small_shaking, scaled(settings, scale), nullptr), scale)};
}

inline bool same_bits(const Answers& both) {
  const Response &a = both.large, &b = both.small;
  return a.outcome == b.outcome && a.peak_slip_m == b.peak_slip_m && a.residual_slip_m == b.residual_slip_m &&
         a.slid_path_m == b.slid_path_m && a.peak_rotation_rad == b.peak_rotation_rad &&
         a.residual_rotation_rad == b.residual_rotation_rad && a.peak_acceleration_mps2 == b.peak_acceleration_mps2 &&
         a.connection_failed == b.connection_failed && a.impacts == b.impacts && a.events == b.events &&
         a.end_time_s == b.end_time_s;
}

// Dimensionless: slips over the size, accelerations over g.
inline double difference(const Response& a, const Response& b, double size_m) {
  if (a.outcome != b.outcome || a.connection_failed != b.connection_failed)
    return std::numeric_limits<double>::infinity();
  const double slip =
      std::max({std::abs(a.peak_slip_m - b.peak_slip_m), std::abs(a.residual_slip_m - b.residual_slip_m),
                std::abs(a.slid_path_m - b.slid_path_m)}) /
      std::max(size_m, a.peak_slip_m);
  const double rotation = std::abs(a.peak_rotation_rad - b.peak_rotation_rad);
  const double acceleration = std::abs(a.peak_acceleration_mps2 - b.peak_acceleration_mps2) / standard_gravity_mps2;
  return std::max({slip, rotation, acceleration});
}

inline std::string text_of(const Answers& both) {
  char line[300];
  const Response &a = both.large, &b = both.small;
  std::snprintf(line, sizeof line,
                " %s/%s slip %.12g/%.12g path %.12g/%.12g rotation %.12g/%.12g acceleration %.12g/%.12g events %d/%d "
                "end %.12g/%.12g",
                name(a.outcome), name(b.outcome), a.peak_slip_m, b.peak_slip_m, a.slid_path_m, b.slid_path_m,
                a.peak_rotation_rad, b.peak_rotation_rad, a.peak_acceleration_mps2, b.peak_acceleration_mps2, a.events,
                b.events, a.end_time_s, b.end_time_s);
  return line;
}

// How many cases a test looks at.
inline int cases(int usual) { return long_tests() ? 20 * usual : usual; }

}  // namespace freestand::test
