// Integrators of Model::bouc_wen: a block that only slides, on an elastoplastic contact (bouc_wen_contact.hpp).
//
// What a Response says of it:
//   peak_slip_m             max |u|, the elastic part included
//   residual_slip_m         u when the ringing on the contact has died out, which takes endless time (bouc_wen_ring.hpp)
//   slid_path_m             integral of |u_p'|, the plastic part of the motion, until nothing is left but ringing
//   peak_acceleration_mps2  max of sqrt((mu g' z)^2 + v^2)
//   events                  changes between rest (elastic) and slide; the contact slides when more than three quarters
//                           of a further displacement would be plastic, q > 3/4 in loading, until the motion turns. (A
//                           block that stops on the contact and springs back does not come so far.)
//   outcome                 at_rest when it never slid in this sense; what moved elastically is reported all the same
//   end_time_s              when nothing was left but ringing
// A floor that falls faster than g' = 0 lets go of the block: no force acts then, and z follows u as before.
//
// Effects (bouc_wen_laws.hpp) act on the friction, as forces, or as contents that move; walls and legs do not go with the
// model. With them, or on a tilted floor, there is no closed form of the ringing: the sample ends when two swings in a row
// slip less than a millionth of u_y each, and the residual slip is the middle of the last one.
#pragma once

#include <freestand/simulate.hpp>

#include "dynamics/bouc_wen_contact.hpp"
#include "dynamics/laws.hpp"

namespace freestand::dynamics {

bool admissible_bouc_wen(const Specimen&, const Shaking&, const FloorInput&, const Settings&);
inline bool admissible_bouc_wen(const Setup& setup, const Settings& settings) {
  return admissible_bouc_wen(setup.specimen, setup.shaking, setup.floor, settings);
}

// Taylor steps from knot to knot, and closed forms for what follows the motion.
Response respond_bouc_wen(const Setup& setup, const Settings& settings, History* history);

// SUNDIALS ARKODE, implicit (the contact is stiff), stopped at every knot, at every turn and zero of z.
Response respond_bouc_wen_reference(const Setup& setup, const Settings& settings, History* history);

}  // namespace freestand::dynamics
