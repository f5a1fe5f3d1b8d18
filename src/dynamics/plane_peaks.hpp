// The peaks of one block that slides in the plane: of the size of its slip, and of its total acceleration.
#pragma once

#include <algorithm>
#include <cmath>
#include <freestand/response.hpp>

#include "dynamics/plane_slip.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {

class PlanePeaks {
 public:
  PlanePeaks(double g, double mu_k) : g_(g), mu_k_(mu_k) {}

  Response& response() { return response_; }

  // At rest the block has the acceleration of the floor; slipping, that of friction; falling, that of gravity. For the time tau.
  void observe_rest(const PlaneFloor& floor, double tau) {
    PlaneSeries squared = squared_lift(floor);
    for (int k = 0; k <= plane_order; ++k)
      squared[k] += product(floor.ax, floor.ax, k) + product(floor.ay, floor.ay, k);
    observe_acceleration(squared, tau);
  }
  void observe_friction(const SlipSeries& slip, double h) { observe_acceleration(slip.felt2, h); }
  void observe_friction(const PlaneFloor& floor, double tau) {
    PlaneSeries squared = squared_lift(floor);
    for (int k = 0; k <= plane_order; ++k) squared[k] += mu_k_ * mu_k_ * product(floor.g, floor.g, k);
    observe_acceleration(squared, tau);
  }
  void observe_fall() { response_.peak_acceleration_mps2 = std::fmax(response_.peak_acceleration_mps2, g_); }

  // Along a series to its place h.
  void observe_slip(const SlipSeries& slip, double h) {
    const double path = slip.path.at(h);
    response_.slid_path_m += path;
    if (std::hypot(slip.ux[0], slip.uy[0]) + path > response_.peak_slip_m) observe_place(slip, h);
  }
  void observe_flight(const SlipSeries& slip, double h) { observe_place(slip, h); }
  // What `end` covers is within the tolerance, or a straight line.
  void observe_end(const SlipEnd& end, const PlaneVector& to) {
    response_.slid_path_m += end.path_m;
    response_.peak_slip_m = std::fmax(response_.peak_slip_m, size(to));
  }

 private:
  void observe_place(const SlipSeries& slip, double h) {
    const double peak = response_.peak_slip_m;
    PlaneSeries squared;
    for (int k = 0; k <= plane_order; ++k) squared[k] = product(slip.ux, slip.ux, k) + product(slip.uy, slip.uy, k);
    response_.peak_slip_m = std::fmax(peak, std::sqrt(max_of(squared, h, peak * peak)));
  }
  PlaneSeries squared_lift(const PlaneFloor& floor) const {
    PlaneSeries lift = floor.g, squared;
    lift[0] -= g_;
    for (int k = 0; k <= plane_order; ++k) squared[k] = product(lift, lift, k);
    return squared;
  }
  void observe_acceleration(const PlaneSeries& squared, double tau) {
    const double peak = response_.peak_acceleration_mps2;
    if (surely_within(squared, tau, peak * peak)) return;
    response_.peak_acceleration_mps2 = std::sqrt(max_of(squared, tau, peak * peak));
  }

  double g_, mu_k_;
  Response response_;
};

}  // namespace freestand::dynamics
