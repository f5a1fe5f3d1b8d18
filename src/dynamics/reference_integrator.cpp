// The reference: SUNDIALS ARKODE, explicit Runge-Kutta of order 5 in short steps, with root finding, restarted at every
// knot of the floor motion and at every event. ARKODE finds a root on an interpolant of its step, and sees only roots
// at which a witness changes sign between two steps. So an event is located again by Newton's method on the integrated
// state itself, and the stationary points of the slip speed are roots too: a slip that stops and goes on within one
// step shows as a negative speed there. A step at whose end the mode does not hold is gone through again in shorter ones.
//
// It shares the equations of motion, the mode logic and the impact laws with the integrator of the sweep, and nothing
// of how that one moves through time or finds its events.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dynamics/arkode.hpp"
#include "dynamics/bouc_wen.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/reference_state.hpp"
#include "dynamics/simulate.hpp"

namespace freestand::dynamics {
namespace {

constexpr int witness_slots = 12 + max_kinks;
constexpr int stationary_u = witness_slots, stationary_theta = witness_slots + 1, stationary_w = witness_slots + 2;
constexpr int root_count = witness_slots + 3;

class ReferenceIntegrator {
 public:
  ReferenceIntegrator(const Setup& setup, const Settings& settings, History* history)
      : trajectory_(setup, settings, history),
        longest_step_(0.006 / setup.specimen.block.p_radps()),
        round_off_(1e-12 * setup.specimen.block.size_m()) {
    SUNContext context = nullptr;
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    context_.reset(context);
    y_.reset(N_VNew_Serial(state_size, context));
    N_VConst(0, y_.get());
    stepper_ = make_arkode(settings.tolerance, &derivative, y_.get(), context, this);
    check(ERKStepRootInit(stepper_.get(), root_count, &roots), "ERKStepRootInit");
    int direction[root_count] = {};
    std::fill(direction, direction + witness_slots, -1);
    check(ERKStepSetRootDirection(stepper_.get(), direction), "ERKStepSetRootDirection");
    check(ERKStepSetNoInactiveRootWarn(stepper_.get()), "ERKStepSetNoInactiveRootWarn");
    locator_ = make_arkode(settings.tolerance, &derivative, y_.get(), context, this);
    output_step_ = history && history->step_s > 0 ? history->step_s : 0;
  }

  Response run() {
    for (trajectory_.stop_when_done(); !trajectory_.finished(); trajectory_.stop_when_done()) {
      if (trajectory_.waits())
        trajectory_.wait();
      else if (!resolve_if_violated())
        integrate_leg();
    }
    return trajectory_.result();
  }

 private:
  // A jump of the floor's acceleration may end the mode at once.
  bool resolve_if_violated() {
    FirstEvent now(0, rig().rest_rotation);
    const auto floor = trajectory_.cursor.local<judge_order>();
    bool forces = true;
    with_arc(floor, [&](const auto& arc) {
      forces = has_forces(arc);
      for_each_witness(trajectory_.rig, trajectory_.state, arc, now);
    });
    if (now.found().any || !forces) trajectory_.resolve(forces ? now.found().witness : Witness::regular);
    return now.found().any || !forces;
  }

  // What no longer holds at the end of a step, by more than round-off of metres, seconds and radians; null: nothing.
  const Witness* violated(double tau) {
    double g[root_count];
    if (tau != seen_at_) roots(tau, y_.get(), g, this);
    const auto found = std::find_if(seen_.begin(), seen_.end(), [&](double x) { return x < -round_off_; });
    return found == seen_.end() ? nullptr : &slots_[event_at(static_cast<int>(found - seen_.begin()))];
  }

  // To the next knot, output time or event.
  void integrate_leg() {
    floor_ = trajectory_.cursor.local<judge_order>();
    if (passed_over_s_ == 0 && trajectory_.state.pivot != 0) look_out_for_the_floor();
    const double h = leg_length();
    const bool to_knot = h == trajectory_.cursor.left();
    if (h > 0) {
      record(h);
      if (h > instant_ && !go(h)) return;
    }
    trajectory_.cursor.advance(h);
    if (to_knot) trajectory_.next_segment();
  }

  // A hop that a step would pass over, down and up again, is gone through in short steps, until long after it should have ended.
  void look_out_for_the_floor() {
    with_arc(floor_at(0), [&](const auto& arc) {
      const double fall = 2 * fall_time(trajectory_.state.pivot, arc.theta);
      if (fall > shortest_ && fall < longest_step_) passed_over_s_ = fall;
    });
  }

  // One leg of length h. False: an event, or a stationary point, ended it early; or an event was passed over, and the leg ends
  // before the step in which it was: the next leg is that step, in shorter ones.
  bool go(double h) {
    void* ark = stepper_.get();
    const double step = std::min(h, passed_over_s_ > 0 ? passed_over_s_ / 8 : longest_step_);
    passed_over_s_ = 0;
    off_wall_ = touches_wall(rig(), trajectory_.state) ? 0.5 * touching(rig()) : 0;
    start_at(ark, 0, h, step);
    watch_ = {true, true, true};
    double g[root_count];
    roots(0, y_.get(), g, this);
    for (int i = 0; i < 3; ++i) watch_[i] = std::abs(g[witness_slots + i]) > 1e-9;  // not where the leg starts at one
    observe(0);
    double enough = -1e300;  // a slip speed, above which its extremes are not watched
    for (double tau = 0; tau < h;) {
      const double before = tau, path = trajectory_.peaks.response().slid_path_m;
      const State from = trajectory_.state;
      const int flag = ERKStepEvolve(ark, h, y_.get(), &tau, ARK_ONE_STEP);
      // The laws lead no further than this, or jump.
      if (flag == ARK_RHSFUNC_FAIL || flag == ARK_RTFUNC_FAIL || flag == ARK_ERR_FAILURE) {
        end_before(from, before, path, std::min(step, h - before));
        if (!rig().laws)
          trajectory_.stop(Outcome::not_finite);
        else if (passed_over_s_ <= shortest_)
          trajectory_.resolve(Witness::regular);
        return false;
      }
      check(flag, "ERKStepEvolve");
      int found[root_count] = {};
      if (flag == ARK_ROOT_RETURN) check(ERKStepGetRootInfo(ark, found), "ERKStepGetRootInfo");
      auto slot = static_cast<int>(std::find(found, found + witness_slots, -1) - found);
      const bool slips = slot < witness_slots && slots_[slot] == Witness::slipping;
      if (slips && slip_speed(rig(), from) == 0 && tau <= shortest_) {  // round-off of a slip that starts
        restart(ark, tau, h);
        continue;
      }
      if (slot < witness_slots)
        tau = locate(slot, from, before, tau, h);
      else if (flag == ARK_ROOT_RETURN && !integrate_again(from, before, tau))
        integrate_again(from, before, tau = before);
      arrive(from, tau);
      if (slot < witness_slots && is_kink(slots_[slot]) && slip_ends_now()) slot = slot_of(Witness::slipping);
      // A steady slip slower than the errors of the steps is turned by them, not by the motion: at the place there is no zero.
      if (slips && tau > before + instant_ && !ends_at(slot, tau)) {
        restart(ark, tau, h);
        continue;
      }
      if (const Witness* met = slot < witness_slots ? &slots_[slot] : violated(tau)) {
        if (slot == witness_slots && tau - before > shortest_) {
          end_before(from, before, path, tau - before);  // it was passed over
        } else {
          trajectory_.cursor.advance(tau);
          trajectory_.resolve(*met);
        }
        return false;
      }
      // Where a law makes the slip steady at once, errors of the steps turn its speed again and again. After an extreme that has kept
      // half of it none is watched, as long as a step starts and ends above a half and loses less in its time: a cubic then has no zero.
      const double speed = trajectory_.state.sigma * slip_speed(rig(), trajectory_.state);
      if (found[stationary_w] && std::count(found, found + root_count, 0) == root_count - 1 &&
          speed > 0.5 * from.sigma * slip_speed(rig(), from)) {
        enough = 0.5 * speed;
        watch_[2] = false;
        restart(ark, tau, h);
      } else if (flag == ARK_ROOT_RETURN || speed < enough + std::abs(slip_rate_) * (tau - before)) {
        trajectory_.cursor.advance(tau);  // a stationary point: the next leg starts there
        return false;
      }
    }
    return true;
  }

  // The leg ends where a step began that passed over an event.
  void end_before(const State& from, double tau, double path, double step) {
    trajectory_.state = from;
    trajectory_.peaks.response().slid_path_m = path;
    trajectory_.cursor.advance(tau);
    passed_over_s_ = step;
  }

  void start_at(void* ark, double tau, double end, double step) {
    write(trajectory_.state);
    check(ERKStepSetMaxStep(ark, step), "ERKStepSetMaxStep");
    check(ERKStepSetInitStep(ark, std::min(end - tau, step)), "ERKStepSetInitStep");
    restart(ark, tau, end);
  }

  void restart(void* ark, double tau, double end) {
    check(ERKStepReset(ark, tau, y_.get()), "ERKStepReset");
    check(ERKStepSetStopTime(ark, end), "ERKStepSetStopTime");
  }

  // The state at the end of a step.
  void arrive(const State& from, double tau) {
    trajectory_.state = read(y_.get());
    trajectory_.left_instant(tau);
    if (trajectory_.rig.laws)
      trajectory_.peaks.response().slid_path_m += trajectory_.state.path - from.path;
    else if (from.sigma != 0)
      trajectory_.peaks.response().slid_path_m += std::abs(trajectory_.state.xi - from.xi);
    observe(tau);
  }

  // Leaves in y the state at tau, integrated anew from the start of the step. False: the laws do not lead so far.
  bool integrate_again(const State& from, double before, double tau) {
    trajectory_.state = from;
    write(from);
    if (!(tau > before + instant_)) return true;
    start_at(locator_.get(), before, tau, longest_step_);
    double reached = 0;
    const int flag = ERKStepEvolve(locator_.get(), tau, y_.get(), &reached, ARK_NORMAL);
    if (flag == ARK_RHSFUNC_FAIL || flag == ARK_ERR_FAILURE) return false;
    check(flag, "ERKStepEvolve");
    return true;
  }

  // Newton's method on the witness, and halfway back from where the laws do not lead. Behind the end of a slip laws see a
  // speed of zero, and no force on a corner that was let go: a kink there is that end.
  double locate(int& slot, const State& from, double before, double tau, double h) {
    constexpr int rounds = 8, halvings = 50;
    double g[root_count];
    for (int i = 0; i < halvings; ++i) {
      double next = 0.5 * (before + tau);
      if (integrate_again(from, before, tau)) {
        roots(tau, y_.get(), g, this);
        slot = event_at(slot);
        if (slip_is_over_ && is_kink(slots_[slot]) && g[slot] == 0) slot = slot_of(Witness::slipping);
        const double newton = tau - g[slot] / rate_[slot];
        if (newton > before && newton <= h) next = newton;
        if (i >= rounds || !(std::abs(next - tau) > 1e-15)) return tau;
      }
      tau = next;
    }
    integrate_again(from, before, before);
    return before;
  }

  // A condition that the end of the slip meets comes after it.
  bool slip_ends_now() const {
    const double speed = trajectory_.state.sigma * slip_speed(rig(), trajectory_.state),
                 loss = -trajectory_.state.sigma * slip_rate_;
    constexpr double located = 4;  // instants
    return trajectory_.state.sigma != 0 && speed <= loss * located * rig().instant_s;
  }

  int event_at(int slot) const { return let_go_ && is_kink(slots_[slot]) ? slot_of(Witness::pressed) : slot; }
  int slot_of(Witness witness) const {
    return static_cast<int>(std::find(slots_, slots_ + witness_slots, witness) - slots_);
  }

  // Whether the witness is zero within the time that is told from nothing; Newton's method has gone there.
  bool ends_at(int slot, double tau) {
    double g[root_count];
    return roots(tau, y_.get(), g, this) != 0 || !(std::abs(g[slot]) > shortest_ * std::abs(rate_[slot]));
  }

  double leg_length() const {
    double h = std::min(trajectory_.left(), passed_over_s_ > 0 ? passed_over_s_ : 300 * longest_step_);
    if (output_step_ > 0) {
      const double next = (std::floor(trajectory_.cursor.time() / output_step_ + 1e-6) + 1) * output_step_;
      h = std::min(h, next - trajectory_.cursor.time());
    }
    return h;
  }

  void record(double h) {
    const double start = trajectory_.cursor.time();
    with_arc(floor_, [&](const auto& arc) { trajectory_.recorder.record(trajectory_.state, arc, floor_, start, h); });
  }

  // Calls use(arc) with the series of the state's mode, of its order in the floor given.
  template <int N, class Use>
  void with_arc(const Floor<double, N>& floor, Use&& use, double tau = 0) const {
    const double time = trajectory_.cursor.time() + tau;
    if (trajectory_.state.mode == Mode::flight)
      with_flight_arc<N>(trajectory_.rig, trajectory_.state, time, floor, use);
    else
      with_contact_arc<N>(trajectory_.rig, trajectory_.state, time, floor, use);
  }

  // Extremes at the present point; root finding stops the integration at the stationary ones.
  void observe(double tau) {
    const Floor<double, 2> floor = floor_at(tau);
    const double time = trajectory_.cursor.time() + tau;
    if (trajectory_.state.mode == Mode::flight)
      with_flight_arc<2>(trajectory_.rig, trajectory_.state, time, floor, [&](const auto& arc) {
        trajectory_.peaks.observe(trajectory_.rig, trajectory_.state, arc, 0);
      });
    else
      with_contact_arc<2>(trajectory_.rig, trajectory_.state, time, floor, [&](const auto& arc) {
        if (trajectory_.state.sigma != 0) trajectory_.state.foot = slip_speed(arc)[0];
        trajectory_.peaks.observe(trajectory_.rig, trajectory_.state, arc, 0);
      });
  }

  // Floor about tau, to first order.
  Floor<double, 2> floor_at(double tau) const {
    return {{floor_.a.at(tau), dynamics::derivative(floor_.a).at(tau), 0},
            {floor_.g.at(tau), dynamics::derivative(floor_.g).at(tau), 0}};
  }

  State read(N_Vector y) const { return state_of(N_VGetArrayPointer(y), trajectory_.state); }
  void write(const State& s) { numbers_of(s, N_VGetArrayPointer(y_.get())); }

  static int derivative(double tau, N_Vector y, N_Vector rate, void* self) {
    auto& me = *static_cast<ReferenceIntegrator*>(self);
    const State s = me.read(y);
    double* d = N_VGetArrayPointer(rate);
    const auto floor = me.floor_at(tau);
    const double time = me.trajectory_.cursor.time() + tau;
    if (s.mode == Mode::flight)
      with_flight_arc<2>(me.rig(), s, time, floor, [&](const auto& f) {
        const double rates[plain_size] = {f.theta[1], f.omega[1], f.x[1], f.vx[1], f.y[1], f.vy[1]};
        std::copy(rates, rates + plain_size, d);
        law_rates(f, me.states(), d + plain_size);
      });
    else
      with_contact_arc<2>(me.rig(), s, time, floor, [&](const auto& arc) {
        const double rates[plain_size] = {arc.theta[1], arc.omega[1], arc.xi[1], arc.w[1], 0, 0};
        std::copy(rates, rates + plain_size, d);
        law_rates(arc, me.states(), d + plain_size);
      });
    return std::all_of(d, d + state_size, [](double x) { return std::isfinite(x); }) ? 0 : -1;
  }

  static int roots(double tau, N_Vector y, double* g, void* self) {
    auto& me = *static_cast<ReferenceIntegrator*>(self);
    const State s = me.read(y);
    const auto floor = me.floor_at(tau);
    std::fill(g, g + root_count, 1.0);
    int slot = 0;
    me.slip_is_over_ = me.let_go_ = false;
    const auto fill = [&](Witness witness, const Series<double, 2>& series, ZeroTolerance) {
      const bool over_floor = witness == Witness::above_right || witness == Witness::above_left;
      me.slots_[slot] = witness;
      me.rate_[slot] = series[1];
      if (witness == Witness::pressed) me.let_go_ = series[0] < me.rig().force_zero;
      g[slot++] = series[0] + (is_clearance(witness) ? me.off_wall_ : over_floor ? me.off_floor_ : 0);
    };
    const double time = me.trajectory_.cursor.time() + tau;
    if (s.mode == Mode::flight) {
      with_flight_arc<2>(me.rig(), s, time, floor, [&](const auto& f) { for_each_witness(me.rig(), s, f, fill); });
      const double d = 0.5 * (me.rig().right - me.rig().left);
      const double lever = me.rig().h * std::cos(s.theta) + d * std::sin(s.theta);
      if (me.watch_[0]) g[stationary_u] = s.vx - lever * s.omega;
    } else {
      with_contact_arc<2>(me.rig(), s, time, floor, [&](const auto& arc) {
        me.slip_is_over_ = s.sigma * slip_speed(arc)[0] < 0;
        for_each_witness(me.rig(), s, arc, fill);
        if (me.watch_[0]) g[stationary_u] = midpoint(me.rig(), s, arc)[1];
        if (me.watch_[1] && s.pivot != 0) g[stationary_theta] = s.omega;
        me.slip_rate_ = slip_speed(arc)[1];
        if (me.watch_[2] && s.sigma != 0) g[stationary_w] = me.slip_rate_;
      });
    }
    // A search between values that are none, or infinite, would not end.
    constexpr double largest = std::numeric_limits<double>::max();
    for (double* each = g; each < g + root_count; ++each) *each = std::clamp(*each, -largest, largest);
    std::copy(g, g + witness_slots, me.seen_.begin());
    me.seen_at_ = tau;
    return std::none_of(g, g + root_count, [](double x) { return std::isnan(x); }) ? 0 : -1;
  }

  const Rig& rig() const { return trajectory_.rig; }
  int states() const { return rig().laws ? rig().laws->states : 0; }

  Integration trajectory_;
  double longest_step_;
  double round_off_;                        // of lengths [m]
  double off_floor_ = 0.1 * round_off_;     // where a corner that takes off starts, as `off_wall_`
  double instant_ = 1e-12 * longest_step_;  // shorter than ARKODE can tell from nothing [s]
  double shortest_ = 1e-7 * longest_step_;  // of a step that is gone through again for an event that it passed over [s]
  double output_step_ = 0;
  double passed_over_s_ = 0;  // length of the step in which the last leg passed over an event, or the next one may
  double off_wall_ = 0;  // an edge at a wall starts its leg so far off it: ARKODE sees no root that a leg starts on [m]
  std::array<bool, 3> watch_{};
  Floor<double, judge_order> floor_{};
  Witness slots_[witness_slots]{};
  double rate_[witness_slots]{};
  std::array<double, witness_slots> seen_{};    // witnesses at the point where they were last asked for
  double seen_at_ = -1;                         // its time within the leg [s]
  double slip_rate_ = 0;                        // there [m/s2]
  bool slip_is_over_ = false, let_go_ = false;  // there
  std::unique_ptr<_SUNContext, Delete> context_;
  std::unique_ptr<_generic_N_Vector, Delete> y_;
  Arkode stepper_, locator_;
};

}  // namespace

Response respond_reference_on_line(const Specimen& specimen, const Shaking& shaking, const Settings& settings,
                                   History* history) {
  const Setup setup = set_up(specimen, shaking);
  if (specimen.model == Model::bouc_wen) return respond_bouc_wen_reference(setup, settings, history);
  const bool alone = !specimen.neighbour && !specimen.legs && admissible(setup, settings);
  return alone ? ReferenceIntegrator(setup, settings, history).run() : Response{.outcome = Outcome::not_finite};
}

}  // namespace freestand::dynamics
