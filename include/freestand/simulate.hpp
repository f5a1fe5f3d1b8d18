// One sample: a specimen and a floor motion in, a response out.
#pragma once

#include <freestand/floor_motion.hpp>
#include <freestand/response.hpp>
#include <freestand/specimen.hpp>
#include <limits>
#include <span>

namespace freestand {

struct Settings {
  double tolerance = 1e-9;       // local error of the dimensionless state, one step
  double free_vibration_s = 60;  // integration goes on until the block is at rest, at most this long after the motion
  int event_limit = 100000;
  bool slip_by_side = false;  // the peak slip to each side too; then only samples with laws go in packs
  // The acceleration of the block's point at this height over the base, above the middle of its width, is followed too; nan:
  // of none. Then no sample goes in packs.
  double acceleration_height_m = std::numeric_limits<double>::quiet_NaN();
  // The peaks of the forces of the floor, of a chain and on what moves inside are followed too, and how legs flex; not of model bouc_wen, nor in the
  // plane. Then no sample goes in packs.
  bool contact_forces = false;
};

// Taylor integrator of the sweep. Never throws, never allocates unless `history` is given. What cannot be integrated (a
// size that is not above zero, mu_s below mu_k, an impact factor above 1, laws that find no room together) is not_finite,
// here and below.
Response respond(const Specimen&, const Shaking&, const Settings& = {}, History* history = nullptr);

// The same for many samples at once, in packs as wide as the machine's instruction set; what no pack covers is computed
// one by one. The answer to a sample depends on that sample alone, to the bit, and is the same with any instruction set.
// All spans are equally long. Packs keep the tolerance as well as single samples do: at 1e-9 the median error of a peak is
// below 1e-12 of it, below 1e-9 where friction follows the slip and with Bouc-Wen's contact. The latter go one by one at
// tolerances below 1e-10, others below 1e-13. Pulses, and records under the other effects, have the bits of single samples.
void respond_batch(std::span<const Specimen>, std::span<const Shaking>, const Settings&, std::span<Response>);

// The same with the histories of all, each in its own steps: responses and histories of respond() with a history, to the
// bit. On records samples with laws go in packs, others one by one.
void respond_batch(std::span<const Specimen>, std::span<const Shaking>, const Settings&, std::span<Response>,
                   std::span<History>);

// Where the motion has a second horizontal channel, a block of model slide is followed in the plane of the floor, one by one:
// slips and accelerations are the sizes of vectors. Other models and effects along one line are not_finite there.

// Event-driven reference on SUNDIALS ARKODE (explicit Runge-Kutta, order 5) with root finding; stops at every knot of
// the motion. Slow and exact. Of no motion in the plane, and of no block beside a neighbour or on legs
// that give way.
Response respond_reference(const Specimen&, const Shaking&, const Settings& = {}, History* history = nullptr);

}  // namespace freestand
