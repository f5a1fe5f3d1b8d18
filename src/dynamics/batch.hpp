// Blocks of samples in packs. A kernel is compiled once per instruction set (dynamics/pack/*.cpp, namespaces v2, v3,
// v4 after the levels of x86-64, or `own`) and picked at run time; FREESTAND_ISA=v2|v3|v4|scalar forces one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <span>

#include "base/motion_table.hpp"
#include "dynamics/bouc_wen_contact.hpp"
#include "dynamics/law_rows.hpp"
#include "dynamics/plane_march.hpp"
#include "dynamics/slip_law.hpp"

namespace freestand::dynamics {

// One sample as the kernels read it. Of a slope of the floor, vertical shaking, a law of friction, and spring with drag at most one.
struct BatchCase {
  const MotionTable* table;
  double scale;               // of the record
  double vertical_scale;      // of its vertical channel; 0: it does not shake vertically
  double right, left, h, k2;  // [m], [m2]
  double mu_s, mu_k;
  double g, along;  // gravity across the floor, and along it
  double factor;    // times Housner's rate; 1 where Coulomb's law holds
  double rest_rotation, told_rotation, free_vibration_s;
  BoucWenContact contact;  // model bouc_wen
  double tolerance;
  bool coulomb;        // impact law
  const SlipLaw* law;  // of friction, times mu_s and mu_k; null: there is none. None with Coulomb's impacts
  double stiffness = 0,
         drag = 0;  // along the floor, per mass: of the slip u of the middle of the base, and of u' [1/s2], [1/s]
};

// Computes `count` samples; sets declined[i] where sample i needs the text for single samples.
using BatchKernel = void (*)(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined);

struct BatchKernels {
  const char* name;
  BatchKernel slide;
  BatchKernel rock, rock_coarse, slide_rock,
      slide_rock_coarse;  // steps short against the block's own time, and longer ones
  // Friction follows the slip; all cases of a call have laws of one shape.
  BatchKernel slide_rock_by_slip, slide_rock_by_slip_coarse;
  BatchKernel slide_rock_shaken, slide_rock_shaken_coarse;  // the floor shakes vertically
  BatchKernel slide_rock_pulled, slide_rock_pulled_coarse;  // by a spring, or a drag, along the floor
  BatchKernel bouc_wen;                                     // with kappa = 0
  const LawMarch (*under_laws)[2], (*on_pulses)[2];         // [turns][slips]
  const PlaneMarch (*in_plane)[2];                          // [elliptic friction][the floor shakes vertically]
  int lanes;                                                // of a pack
};

// Those that respond_batch takes: the widest that this machine has, or what FREESTAND_ISA asks for if it has that. Null:
// none, every sample is computed alone.
const BatchKernels* batch_kernels();

// Samples on floors that move along a line, as respond_batch; says how many were computed alone. histories: one of each sample, or none.
std::size_t respond_and_count(std::span<const Specimen>, std::span<const Shaking>, const Settings&, std::span<Response>,
                              std::span<History> histories = {});

}  // namespace freestand::dynamics
