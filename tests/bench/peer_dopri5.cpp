#include "dopri5.hpp"
#include "odeint_sample.hpp"

namespace freestand::bench {

PeerResponse dopri5_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps) {
  return OdeintSample<Dopri5, RecordSteps>(specimen, {shaking, steps.per_knot}, steps).run();
}

}  // namespace freestand::bench
