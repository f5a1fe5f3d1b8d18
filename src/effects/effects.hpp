// The catalogue of effects: ONE FILE PER EFFECT in this folder. A file declares its effect once:
//
//   const Register here{{.name = "viscous_drag", .law = "...", .parameters = {...}, .force = [](const At& at, ...) {...}}};
//
// and from that come the keys of a study and their validation, the sampling dimensions, `freestand effects`, the
// attributes of the results, the candidates of the diagnosis and the rows of the report. dynamics/effect.hpp says what
// a declaration may contain.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/registry.hpp"
#include "base/units.hpp"
#include "dynamics/effect.hpp"

namespace freestand::effects {

using dynamics::At;
using dynamics::Effect;
using dynamics::FloorInput;
using dynamics::Legs;
using dynamics::Parameters;
using dynamics::Value;
using dynamics::Walls;
using Register = Registered<Effect>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// All effects, sorted by name.
const std::vector<Effect>& all();

// The effect of that name; null: there is none.
const Effect* find(const std::string& name);

}  // namespace freestand::effects
