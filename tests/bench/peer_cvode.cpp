#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "peers.hpp"

namespace freestand::bench {
namespace {

constexpr int roots = 7;  // s theta, sigma w, grip, fy, tipping; omega and u' for the peaks

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE failed");
}

}  // namespace

struct CvodePeer::Solver {
  SUNContext context = nullptr;
  N_Vector y = nullptr, tolerances = nullptr;
  SUNNonlinearSolver fixed_point = nullptr;
  void* cvode = nullptr;
  const PeerBlock* block = nullptr;
  const PeerRecord* record = nullptr;
  PeerState now;
  int knot = 0;

  double acceleration(double t) const { return record->at(knot) + record->slope(knot) * (t - knot * record->dt); }
  PeerState state(const double* y_) const { return {now.mode, now.s, now.sigma, y_[0], y_[1], y_[2], y_[3]}; }

  static int rates(double t, N_Vector y_, N_Vector dy, void* user) {
    const Solver& me = *static_cast<Solver*>(user);
    const double *y = N_VGetArrayPointer(y_), a = me.acceleration(t);
    double* d = N_VGetArrayPointer(dy);
    d[0] = y[1];
    d[2] = y[3];
    switch (me.now.mode) {
      case PeerMode::slide:
        d[0] = d[1] = 0;
        d[3] = -a - me.now.sigma * me.block->mu_at(y[3]) * PeerBlock::g;
        break;
      case PeerMode::rock:
        d[1] = me.block->rock_alpha(me.now.s, y[0], a);
        d[2] = d[3] = 0;
        break;
      default:
        const PeerForces f = me.block->slide_rock_forces(me.now.s, me.now.sigma, y[0], y[1], y[3], a);
        d[1] = f.alpha;
        d[3] = f.slip_acceleration;
    }
    return 0;
  }

  static int witnesses(double t, N_Vector y_, double* g, void* user) {
    const Solver& me = *static_cast<Solver*>(user);
    const double* y = N_VGetArrayPointer(y_);
    std::fill(g, g + roots, 1.0);
    const PeerMode mode = me.now.mode;
    if (mode != PeerMode::slide) {
      g[0] = me.now.s * y[0];
      g[5] = y[1];
    }
    if (mode != PeerMode::rock) g[1] = me.now.sigma * y[3];
    if (mode == PeerMode::slide && me.block->can_rock && me.block->drop > 0)
      g[4] = me.block->b - me.block->mu_at(y[3]) * me.block->h;
    if (mode == PeerMode::rock && me.block->can_slip) {
      const PeerForces f = me.block->rock_forces(me.now.s, y[0], y[1], me.acceleration(t));
      g[2] = me.block->mu_s * f.fy - std::abs(f.fx);
    }
    if (mode == PeerMode::slide_rock) {
      g[3] = me.block->slide_rock_forces(me.now.s, me.now.sigma, y[0], y[1], y[3], me.acceleration(t)).fy;
      g[6] = me.block->slip_rate(me.state(y));
    }
    return 0;
  }

  void restart(double t) {
    double* values = N_VGetArrayPointer(y);
    values[0] = now.theta, values[1] = now.omega, values[2] = now.xi, values[3] = now.w;
    check(CVodeReInit(cvode, t, y));
    check(CVodeSetStopTime(cvode, (knot + 1) * record->dt));
  }

  PeerResponse run();
  void observe(PeerResponse& response, double t);
};

void CvodePeer::Solver::observe(PeerResponse& response, double t) {
  const double* values = N_VGetArrayPointer(y);
  now.theta = values[0], now.omega = values[1], now.xi = values[2], now.w = values[3];
  response.rotation_rad = std::max(response.rotation_rad, std::abs(now.theta));
  response.slip_m = std::max(response.slip_m, std::abs(block->slip(now)));
  const double a = acceleration(t);
  PeerForces f{0, 0, block->mu_at(now.w) * PeerBlock::g, PeerBlock::g};
  if (now.mode == PeerMode::rock) f = block->rock_forces(now.s, now.theta, now.omega, a);
  if (now.mode == PeerMode::slide_rock) f = block->slide_rock_forces(now.s, now.sigma, now.theta, now.omega, now.w, a);
  response.acceleration_mps2 = std::max(response.acceleration_mps2, std::hypot(f.fx, f.fy - PeerBlock::g));
}

PeerResponse CvodePeer::Solver::run() {
  PeerResponse response;
  now = {};
  knot = 0;
  const double dt = record->dt, quiet = block->quiet;
  const int last = record->count + static_cast<int>(60 / dt);
  for (double t = 0; knot < last;) {
    if (now.mode == PeerMode::rest) {
      for (; knot < record->count; t = ++knot * dt) {
        const double here = acceleration(t), end = acceleration((knot + 1) * dt);
        response.acceleration_mps2 =
            std::max(response.acceleration_mps2, std::min(quiet, std::max(std::abs(here), std::abs(end))));
        if (std::abs(here) <= quiet && std::abs(end) <= quiet) continue;
        if (std::abs(here) <= quiet) t += ((end > 0 ? quiet : -quiet) - here) / record->slope(knot);
        break;
      }
      if (knot >= record->count) return response;
      ++response.events;
      block->leave_rest(now, acceleration(t));
      restart(t);
    }
    const int flag = CVode(cvode, (knot + 1) * dt, y, &t, CV_NORMAL);
    check(flag);
    observe(response, t);
    if (std::abs(now.theta) > pi / 2) {
      response.overturned = true;
      ++response.events;
      return response;
    }
    if (flag == CV_ROOT_RETURN) {
      int found[roots];
      check(CVodeGetRootInfo(cvode, found));
      const PeerEvent kinds[] = {PeerEvent::impact, PeerEvent::stop, PeerEvent::grip, PeerEvent::lift, PeerEvent::tip};
      for (int i = 0; i < 5; ++i) {
        if (!found[i]) continue;
        if (!block->resolve(kinds[i], now, acceleration(t), response)) return response;
        if (now.mode != PeerMode::rest) restart(t);
        break;
      }
    } else {
      ++knot;
      t = knot * dt;
      if (knot == record->count)
        restart(t);
      else
        check(CVodeSetStopTime(cvode, (knot + 1) * dt));
    }
  }
  return response;
}

CvodePeer::CvodePeer(double tolerance) : solver_(new Solver) {
  Solver& s = *solver_;
  check(SUNContext_Create(nullptr, &s.context));
  s.y = N_VNew_Serial(4, s.context);
  N_VConst(0, s.y);
  s.cvode = CVodeCreate(CV_ADAMS, s.context);
  check(CVodeInit(s.cvode, &Solver::rates, 0, s.y));
  check(CVodeSStolerances(s.cvode, tolerance, tolerance));
  check(CVodeSetUserData(s.cvode, &s));
  s.fixed_point = SUNNonlinSol_FixedPoint(s.y, 0, s.context);
  check(CVodeSetNonlinearSolver(s.cvode, s.fixed_point));
  check(CVodeRootInit(s.cvode, roots, &Solver::witnesses));
  int direction[roots] = {-1, -1, -1, -1, -1, 0, 0};
  check(CVodeSetRootDirection(s.cvode, direction));
  check(CVodeSetNoInactiveRootWarn(s.cvode));
  check(CVodeSetMaxNumSteps(s.cvode, 100000));
}

CvodePeer::~CvodePeer() {
  CVodeFree(&solver_->cvode);
  SUNNonlinSolFree(solver_->fixed_point);
  N_VDestroy(solver_->y);
  SUNContext_Free(&solver_->context);
  delete solver_;
}

PeerResponse CvodePeer::operator()(const Specimen& specimen, const Shaking& shaking) {
  const PeerBlock block(specimen, 1e-9);
  const PeerRecord record(shaking);
  solver_->block = &block;
  solver_->record = &record;
  return solver_->run();
}

}  // namespace freestand::bench
