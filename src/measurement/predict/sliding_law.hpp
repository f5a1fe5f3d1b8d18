// The friction that a model amounts to while its block slides flat, evaluated from what its effects declare. Whatever
// the effects are, it is what recover() finds in a history that this model made:
//
//   mu_eff = -sigma (u'' + a)/g'      u'' + a = (X - sigma mu_k F N)/M - push
//
// with F, X, M and push as in dynamics/effect.hpp, and N the model's own normal force over the mass.
#pragma once

#include <freestand/specimen.hpp>
#include <optional>

#include "dynamics/laws.hpp"

namespace freestand::measurement {

// An instant of a slip.
struct Sliding {
  double speed_mps = 0, path_m = 0, sigma = 1, position_m = 0;
  double vertical_mps2 = 0;  // of the floor, up positive
  double time_s = 0;
};

class SlidingLaw {
 public:
  explicit SlidingLaw(const Specimen&);

  // Share of the floor's vertical acceleration that the model takes.
  double vertical_scale() const { return floor_.vertical_scale; }
  // g' [m/s2], by which forces are made friction: of the floor's motion as far as the model takes it.
  double gravity_mps2(double vertical_mps2) const;
  // mu_eff [1]; nan where a law looks at more than a slip shows: states of its own, legs under the block.
  double friction(const Sliding&) const;

 private:
  double mu_k_;
  dynamics::FloorInput floor_;
  std::optional<dynamics::Laws> laws_;
  bool known_ = true;
};

}  // namespace freestand::measurement
