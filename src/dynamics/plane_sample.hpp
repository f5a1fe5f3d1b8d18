// One block that slides in the plane of its floor, from event to event (plane_slide.hpp).
#pragma once

#include <freestand/simulate.hpp>

#include "dynamics/laws.hpp"
#include "dynamics/plane_history.hpp"
#include "dynamics/plane_step.hpp"

namespace freestand::dynamics {

class PlaneSample {
 public:
  PlaneSample(const Setup& setup, const Settings& settings, History* history);

  bool elliptic() const { return state_.grip.ratio != 1; }
  bool shaken() const { return road_.shaken(); }
  bool goes_on() const { return !finished_; }
  // One step, or one stretch of rest or flight.
  void turn();
  // It slips, in the middle of a record, and its next step is a regular one (PlaneStep).
  bool marches();
  int steps() const { return steps_; }  // within the segment
  void marched(int steps);
  PlaneState<double>& state() { return state_; }
  // To the start of the next segment.
  void next_segment();
  bool motion_over() const { return road_.over(); }
  Response result();

 private:
  void look();
  double end_s() const { return shaking_.duration_s() + settings_.free_vibration_s; }
  double time() const { return road_.start() + state_.offset; }
  void enter_segment();
  void advance(double tau);

  Series<double, 2> grip() const;
  ZeroTolerance grip_zero() const;
  void pass_over_quiet();
  void rest();

  void slide();
  bool ends_within(double limit);
  void come_to_rest(double tau);
  bool may_follow(double limit);
  bool follows_drive(double limit);
  double cut(const DrivenSlip&, double limit) const;
  template <bool is_elliptic, bool is_shaken>
  using Step = PlaneStep<double, OnePlane, is_elliptic, is_shaken>;
  template <class Use>
  auto with_step(Use&& use);
  void step_in_s(double limit);

  void take_off();
  void fly();
  void land();

  void observe_felt(double tau);
  void observe_friction(double tau);
  void observe_place(const SlipSeries<double>& slip, double h);

  void change(Mode to, bool impact = false);
  void stop(Outcome outcome);
  void stop_when_done();

  const Shaking shaking_;
  const Settings settings_;
  const double mu_s_, g_, force_zero_, instant_s_;
  const PlaneVector axis_;  // of the ellipse, along which a, u and w have their x
  PlaneRoad road_;
  PlaneState<double> state_;
  PlaneFloor floor_{};  // at this instant
  double left_ = 0;     // to the next knot, or to the end of the time given [s]
  Mode mode_ = Mode::rest;
  double y_ = 0, vy_ = 0;  // height over the floor in flight
  Response response_;
  PlaneHistory history_;
  Outcome outcome_ = Outcome::moved;
  bool finished_ = false, moved_ = false;
  int steps_ = 0, changes_ = 0;
};

}  // namespace freestand::dynamics
