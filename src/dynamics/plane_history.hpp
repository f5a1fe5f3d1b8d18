// The history of one block that slides in the plane: points at a constant step, read off the series of each step.
#pragma once

#include <algorithm>
#include <freestand/floor_motion.hpp>
#include <freestand/response.hpp>

#include "dynamics/output_times.hpp"
#include "dynamics/plane_slip.hpp"

namespace freestand::dynamics {

class PlaneHistory {
 public:
  // axis: direction in which what is given here has its x.
  PlaneHistory(History* history, const Shaking& shaking, const PlaneVector& axis)
      : history_(history), shaking_(shaking), axis_(axis), times_(history) {
    if (!history_) return;
    history_->points.clear();
    history_->events.clear();
    history_->cross = true;
  }

  bool wanted() const { return times_.wanted(); }

  void event(const Event& event) {
    if (history_) history_->events.push_back(event);
  }

  // A step along a series up to its place h, which is tau later than `start`.
  void along(const SlipSeries<double>& slip, const PlaneFloor& floor, double start, double h, double tau, Mode mode) {
    each_point(start, tau, [&](double t) {
      const double s = slip.in_time ? t : place_in_series(slip, t, h);
      point(start + t, floor, t, {slip.ux.at(s), slip.uy.at(s)}, {slip.wx.at(s), slip.wy.at(s)}, mode);
    });
  }

  // The end of a slip, shorter than what the tolerance sees while the floor shakes; afterwards along a straight line.
  void end(const PlaneFloor& floor, const PlaneVector& u, const PlaneVector& w, const PlaneVector& covers, double start,
           double tau) {
    each_point(start, tau, [&](double t) {
      const double left = 1 - t / tau, covered = 1 - left * left;
      point(start + t, floor, t, {u.x + covered * covers.x, u.y + covered * covers.y}, {left * w.x, left * w.y},
            Mode::slide);
    });
  }

  void rest(const PlaneFloor& floor, const PlaneVector& u, double start, double tau) {
    each_point(start, tau, [&](double t) { point(start + t, floor, t, u, {}, Mode::rest); });
  }

  // The last state, held to the end of the motion.
  void hold(const PlaneVector& u, Mode mode) {
    times_.up_to(shaking_.duration_s(), [&](double t) {
      add(t, {horizontal_acceleration(shaking_, t), cross_acceleration(shaking_, t)}, back(u), {}, mode);
    });
  }

 private:
  template <class Point>
  void each_point(double start, double tau, Point&& point) {
    times_.within(start, tau, [&](double t) { point(std::fmin(t, tau)); });
  }

  void point(double time, const PlaneFloor& floor, double t, const PlaneVector& u, const PlaneVector& w, Mode mode) {
    add(time, back(floor.later(t).a), back(u), back(w), mode);
  }

  void add(double time, const PlaneVector& a, const PlaneVector& u, const PlaneVector& w, Mode mode) {
    HistoryPoint point{time, a.x, u.x, w.x, 0, 0, mode};
    point.cross_slip_m = u.y;
    point.cross_slip_velocity_mps = w.y;
    point.floor_cross_acceleration_mps2 = a.y;
    history_->points.push_back(point);
  }

  PlaneVector back(const PlaneVector& x) const { return turned_back(x, axis_); }

  History* history_;
  const Shaking& shaking_;
  const PlaneVector axis_;
  OutputTimes times_;
};

}  // namespace freestand::dynamics
