// The trajectory of one sample on a Bouc-Wen contact, from turn to turn: what both scalar integrators share. They differ in
// how they move between events.
#pragma once

#include <freestand/simulate.hpp>
#include <limits>
#include <optional>

#include "dynamics/bouc_wen_contact.hpp"
#include "dynamics/bouc_wen_laws.hpp"
#include "dynamics/floor_cursor.hpp"
#include "dynamics/output_times.hpp"
#include "dynamics/roots.hpp"
#include "dynamics/step_watch.hpp"

namespace freestand::dynamics {

class BoucWenTrajectory {
 public:
  BoucWenTrajectory(const Setup& setup, const Settings& settings, History* history);

  const Settings settings;
  const Shaking shaking;
  const double gravity, push;  // across and along the floor [m/s2]
  const bool vertical;
  const BoucWenContact contact;
  const std::optional<Laws> laws;  // of effects within the equations of motion
  const double instant_s;          // what is closer together happens at once: events are located no better
  FloorCursor cursor;

  // The state. Signs: positive to the right.
  double slip = 0;         // u_p [m]
  double zeta = 0, v = 0;  // [1], [m/s]
  double q = 0;            // |zeta|^n while yielding or returning
  int direction = 0;       // of the motion, or of the motion that is about to begin; 0: none
  ContactPhase phase = ContactPhase::elastic;
  BoucWenLawState law_state;
  StepWatch watch;

  bool finished() const { return finished_; }
  double displacement() const { return slip + contact.yield * zeta; }
  double force_zero() const { return 1e-11 * gravity; }  // accelerations below are round-off [m/s2]
  bool simple() const { return !vertical && !laws && push == 0; }
  double time_left() const;  // to the next knot, or to the end of the sample [s]

  void set_out(int towards);  // v = 0, and the motion begins
  void pass();                // |zeta| = contact.linear
  void saturate();            // zeta = 1
  void turn();                // v = 0
  void stand(double tau);     // nothing moves for so long
  void next_segment();

  // Goes to the instant tau of the arc; history and peaks are taken from the arc.
  template <int N>
  void arrive(const BoucWenArc<N>& arc, const Floor<double, N>& floor, double tau);

  Response result();

  // For what moves without an arc.
  double next_output() const;  // time since now [s]; infinite without a history
  template <class Point>
  void record(double tau, Point&& point);  // point(t since now) -> HistoryPoint
  void observe_acceleration(double horizontal, double lift);
  void observe_slip(double u);
  void add_path(double length) { response_.slid_path_m += length; }
  double path() const { return response_.slid_path_m; }
  void begin_slide(double time);
  void check();  // ends the sample when its time is over or its state is no number
  void give_up() { finish(Outcome::step_limit); }

 private:
  void event(double time, Mode from, Mode to);
  void finish(Outcome failure);
  void ring();
  bool settled();

  History* history_;
  Response response_;
  OutputTimes times_{history_};
  long turns_ = 0;
  bool slides_ = false, moved_ = false, finished_ = false;
  double last_slide_s_ = 0, last_turn_u_ = 0, last_turn_slip_ = 0;
  double last_swing_slip_ = std::numeric_limits<double>::infinity();
  std::optional<double> residual_;
  Outcome failure_ = Outcome::moved;
};

template <class Point>
void BoucWenTrajectory::record(double tau, Point&& point) {
  times_.within(cursor.time(), tau, [&](double t) { history_->points.push_back(point(t)); });
}

template <int N>
void BoucWenTrajectory::arrive(const BoucWenArc<N>& arc, const Floor<double, N>& floor, double tau) {
  const double s = direction;
  const bool loading = phase == ContactPhase::yielding || phase == ContactPhase::sliding;
  record(tau, [&](double t) {
    const double z = arc.zeta.at(t);
    return HistoryPoint{cursor.time() + t,
                        floor.a.at(t) - push,
                        slip + s * (arc.slip.at(t) + contact.yield * z),
                        s * arc.v.at(t),
                        0,
                        0,
                        loading && z > contact.sliding ? Mode::slide : Mode::rest,
                        -s * arc.hold.at(t) - push,
                        floor.g.at(t) - gravity,
                        -s * arc.hold.at(t),
                        floor.g.at(t)};
  });
  if (!simple()) {
    Series<double, N> square, along = arc.hold, lift = floor.g;
    along[0] += s * push;
    if (sign_after(floor.g, {0, force_zero()}) <= 0) lift = Series<double, N>::zero();
    lift[0] -= gravity;
    for (int k = 0; k <= N; ++k) square[k] = product(along, along, k) + product(lift, lift, k);
    const double peak = response_.peak_acceleration_mps2;
    response_.peak_acceleration_mps2 = std::sqrt(max_abs(square, tau, peak * peak));
  }
  const double slid = arc.slip.at(tau);
  response_.slid_path_m += std::fabs(slid);
  slip += s * slid;
  const double before = arc.zeta[0], after = arc.zeta.at(tau);
  zeta = phase == ContactPhase::sliding ? s : s * after;
  v = s * arc.v.at(tau);
  if (phase == ContactPhase::yielding && before <= contact.sliding && after > contact.sliding) {
    double at = tau;
    Series<double, N> below = scaled(-1.0, arc.zeta);
    below[0] += contact.sliding;
    if (history_) first_root(below, tau, {0, 0.0}, at);
    begin_slide(cursor.time() + at);
  }
  if (phase == ContactPhase::yielding || phase == ContactPhase::returning) q = contact.q(zeta);
  cursor.advance(tau);
  if (tau > instant_s) law_state.left_kinks();
  check();
}

}  // namespace freestand::dynamics
