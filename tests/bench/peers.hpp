// What the program is measured against: the same samples by other means.
#pragma once

#include <string>

#include "peer_block.hpp"

namespace freestand::bench {

// SUNDIALS CVODE, Adams, one sample at a time: root finding for events, stop at every knot of the record.
class CvodePeer {
 public:
  explicit CvodePeer(double tolerance);
  ~CvodePeer();
  CvodePeer(const CvodePeer&) = delete;
  CvodePeer& operator=(const CvodePeer&) = delete;
  PeerResponse operator()(const Specimen& specimen, const Shaking& shaking);

 private:
  struct Solver;
  Solver* solver_;
};

// Boost.odeint's runge_kutta_dopri5, and its runge_kutta_fehlberg78, inlined: so many equal steps per knot (shorter where
// an event cuts one), events located by the Illinois method on the polynomial of the step, quiet waits skipped knot by knot.
struct OdeintSteps {
  int per_knot = 1;
  double tolerance = 1e-9;  // of peers that choose their steps, relative and absolute
  double root_s = 1e-13;    // width to which an event is located
};
using Peer = PeerResponse (*)(const Specimen&, const Shaking&, const OdeintSteps&);
PeerResponse dopri5_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps);
PeerResponse fehlberg78_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps);

// dopri5 under a pulse by its formula (pulse_formula.hpp), its steps chosen by odeint's control of their error; stops at the pulse's end.
PeerResponse pulse_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps);

// dopri5 in the same way under one effect, whose law is written by hand (peer_laws.hpp). Null where there is none.
Peer law_peer(const std::string& effect);

// dopri5 in the same way where the floor moves in both horizontal directions (peer_plane.cpp).
PeerResponse plane_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps);

// The same two on model bouc_wen: dopri5 with its step chosen by its error, and CVODE, BDF where the contact is stiff.
PeerResponse odeint_bouc_wen(const Specimen& specimen, const Shaking& shaking);
PeerResponse cvode_bouc_wen(const Specimen& specimen, const Shaking& shaking);

}  // namespace freestand::bench
