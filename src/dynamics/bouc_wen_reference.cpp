// The reference of model bouc_wen: SUNDIALS ARKODE, explicit Runge-Kutta of order 5 with root finding, restarted at every
// knot of the floor motion and at every turn and zero of z. It integrates the law as it is printed, u_y and z not scaled,
// and follows each swing through its yield; only where 1 - (beta + gamma)|z|^n is below round-off, and the law no longer
// moves z but would be stiff, z is held.
//
// It shares with the integrator of the sweep what is told of a sample, and the closed form of the ringing after the
// motion, but no step and no search for events. ARKODE finds a root on an interpolant of its step; so the event is
// located again by Newton's method on the integrated state itself. The stationary points of u' are roots too, so that no
// two turns hide within one step.
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <memory>

#include "dynamics/bouc_wen.hpp"
#include "dynamics/bouc_wen_trajectory.hpp"

namespace freestand::dynamics {
namespace {

enum : int { u, v, z, path, own, state_size = own + max_states };  // own: states of effects
enum : int { turns, accelerates, crosses_zero, kinks, root_count = kinks + max_kinks };

struct Delete {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
  void operator()(_generic_N_Vector* vector) const { N_VDestroy(vector); }
  void operator()(void* memory) const { ERKStepFree(&memory); }
};

void check(int flag, const char* what) {
  if (flag < 0)
    throw Error(std::string("the reference integrator failed (SUNDIALS ") + what + " returned " + std::to_string(flag) +
                    "): loosen the tolerance",
                Exit::data);
}

class Reference {
 public:
  Reference(const Setup& setup, const Settings& settings, History* history)
      : trajectory_(setup, settings, history),
        law_(setup.specimen.bouc_wen),
        mu_(setup.specimen.friction.mu_k),
        strongest_(std::pow(law_.gamma + law_.beta, -1 / law_.exponent)),
        rate_(std::sqrt(std::max(mu_, 1e-3) * trajectory_.gravity / law_.yield_displacement_m)) {
    SUNContext context = nullptr;
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    context_.reset(context);
    y_.reset(N_VNew_Serial(state_size, context));
    tolerances_.reset(N_VNew_Serial(state_size, context));
    N_VConst(0, y_.get());
    stepper_ = make_arkode(settings);
    locator_ = make_arkode(settings);
    check(ERKStepRootInit(stepper_.get(), root_count, &roots), "ERKStepRootInit");
    int direction[root_count] = {};
    std::fill(direction + kinks, direction + root_count, -1);
    check(ERKStepSetRootDirection(stepper_.get(), direction), "ERKStepSetRootDirection");
    check(ERKStepSetNoInactiveRootWarn(stepper_.get()), "ERKStepSetNoInactiveRootWarn");
  }

  Response run() {
    while (!trajectory_.finished()) {
      floor_ = trajectory_.cursor.local<max_floor_degree>();
      if (sigma_ != 0 || set_out())
        go();
      else
        stand();
    }
    return trajectory_.result();
  }

 private:
  using Arkode = std::unique_ptr<void, Delete>;

  Arkode make_arkode(const Settings& settings) {
    Arkode arkode(ERKStepCreate(&derivative, 0, y_.get(), context_.get()));
    if (!arkode)
      throw Error("the reference integrator cannot start (SUNDIALS has no memory): free some memory", Exit::data);
    void* ark = arkode.get();
    check(ERKStepSetTableNum(ark, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
    const double tolerance = std::max(settings.tolerance, 1e-12);
    double* absolute = N_VGetArrayPointer(tolerances_.get());
    absolute[u] = absolute[path] = tolerance * law_.yield_displacement_m;
    absolute[v] = tolerance * law_.yield_displacement_m * rate_;
    absolute[z] = tolerance;
    for (int i = 0; i < max_states; ++i) absolute[own + i] = absolute[v];
    check(ERKStepSVtolerances(ark, tolerance, tolerances_.get()), "ERKStepSVtolerances");
    check(ERKStepSetUserData(ark, this), "ERKStepSetUserData");
    check(ERKStepSetMaxNumSteps(ark, 1000000), "ERKStepSetMaxNumSteps");
    // Peaks of the acceleration that are not at turns are taken at the ends of steps: one of a circular frequency w is low by (w h)^2/8 of
    // itself at most. That is 1/800 of the ringing; of floors and laws up to 25 Hz 5e-4 s leave 1/1300.
    check(ERKStepSetMaxStep(ark, std::min(0.1 / rate_, trajectory_.simple() ? 1e9 : 5e-4)), "ERKStepSetMaxStep");
    return arkode;
  }

  double a(double tau) const { return floor_.a.at(tau); }
  double hold(double tau) const { return mu_ * std::max(0.0, floor_.g.at(tau)); }

  // The direction in which the block leaves a turn: that of its first acceleration that is not zero. False: none. What
  // changes slowly, the floor and the states of effects, is looked at again a microsecond later.
  bool set_out() {
    const double zero = trajectory_.force_zero();
    sigma_ = 0;
    side_ = (trajectory_.zeta > 0) - (trajectory_.zeta < 0);
    write();
    double rates[state_size], later[state_size];
    derivatives(0, N_VGetArrayPointer(y_.get()), rates);
    double push = rates[v];
    if (std::abs(push) <= zero) {
      constexpr double soon = 1e-6;
      std::copy_n(N_VGetArrayPointer(y_.get()), static_cast<int>(state_size), later);
      for (int i = own; i < state_size; ++i) later[i] += soon * rates[i];
      derivatives(soon, later, rates);
      push = std::abs(rates[v]) <= 1e-3 * zero ? 0 : rates[v];
    }
    sigma_ = (push > 0) - (push < 0);
    trajectory_.direction = sigma_;
    side_ = z_now() == 0 ? sigma_ : z_now() > 0 ? 1 : -1;
    trajectory_.law_state.side = side_;
    held_ = sigma_ * z_now() >= strongest_;
    if (side_ == sigma_ && std::abs(trajectory_.zeta) > trajectory_.contact.sliding)
      trajectory_.begin_slide(trajectory_.cursor.time());
    return sigma_ != 0;
  }
  // Nothing moves; looked at again at least every millisecond where a law may begin to, and where the floor lets go or
  // comes back.
  void stand() {
    record();
    double h = std::min(trajectory_.time_left(), trajectory_.next_output()), at = 0;
    if (trajectory_.laws && !trajectory_.cursor.motion_over()) h = std::min(h, 1e-3);
    const ZeroTolerance zero{0, trajectory_.force_zero()};
    const double side = sign_after(floor_.g, zero) > 0 ? 1 : -1;
    if (trajectory_.vertical && first_root(scaled(side, floor_.g), std::min(h, 1e3), zero, at) && at > 0)
      h = std::min(h, at);
    trajectory_.stand(h);
  }
  double z_now() const { return trajectory_.zeta * strongest_; }

  // To the next knot, output time or event.
  void go() {
    record();
    const double h = std::min(trajectory_.time_left(), trajectory_.next_output());
    const bool to_knot = h == trajectory_.cursor.left();
    write();
    leave_kinks();
    start_at(stepper_.get(), 0, h);
    for (double tau = 0; tau < h;) {
      const double before = tau;
      N_Vector from = N_VClone(y_.get());
      N_VScale(1, y_.get(), from);
      int flag = ERKStepEvolve(stepper_.get(), h, y_.get(), &tau, ARK_ONE_STEP);
      check(flag, "ERKStepEvolve");
      int found[root_count] = {};
      if (flag == ARK_ROOT_RETURN) check(ERKStepGetRootInfo(stepper_.get(), found), "ERKStepGetRootInfo");
      int event = found[turns] ? turns : found[crosses_zero] ? crosses_zero : root_count;
      for (int j = 0; j < max_kinks; ++j)
        if (event == root_count && found[kinks + j]) event = kinks + j;
      if (flag == ARK_ROOT_RETURN) tau = locate(event, from, before, tau, h);
      N_VDestroy(from);
      if (arrive(tau, before, event)) return;
      if (flag == ARK_ROOT_RETURN) start_at(stepper_.get(), tau, h);
    }
    trajectory_.cursor.advance(h);
    trajectory_.check();
    if (to_knot) trajectory_.next_segment();
  }

  // Turns the kinks on which the leg starts and beyond which it goes: ARKODE sees no root on which it starts. Where it goes shows after
  // a millionth of the ringing's own time. Three steps by the midpoint rule: from rest, on a floor that begins to move, the first one
  // finds a speed, the second one a displacement, the third one what follows it.
  void leave_kinks() {
    if (!trajectory_.laws) return;
    constexpr int steps = 3;
    const double soon = 1e-6 / rate_, h = soon / steps, *now = N_VGetArrayPointer(y_.get());
    double rates[state_size], middle[state_size], later[state_size];
    std::copy(now, now + state_size, later);
    for (int step = 0; step < steps; ++step) {
      derivatives(step * h, later, rates);
      for (int i = 0; i < state_size; ++i) middle[i] = later[i] + 0.5 * h * rates[i];
      derivatives((step + 0.5) * h, middle, rates);
      for (int i = 0; i < state_size; ++i) later[i] += h * rates[i];
    }
    for (int j = 0; j < trajectory_.laws->tape.kink_count(); ++j)
      if (kink(j, 0, now) <= 0 && kink(j, soon, later) < 0) trajectory_.law_state.turn_kink(j);
  }

  // Records what is due now.
  void record() {
    constexpr double now = 1e-9;
    trajectory_.record(now, [&](double t) {
      const bool slides = sigma_ * trajectory_.zeta > trajectory_.contact.sliding;
      double rates[state_size];
      derivatives(0, N_VGetArrayPointer(y_.get()), rates);
      const double held = rates[v] + a(0);
      return HistoryPoint{trajectory_.cursor.time() + t,
                          a(t) - trajectory_.push,
                          trajectory_.displacement(),
                          trajectory_.v,
                          0,
                          0,
                          slides ? Mode::slide : Mode::rest,
                          held - trajectory_.push,
                          floor_.g.at(t) - trajectory_.gravity,
                          held,
                          floor_.g.at(t)};
    });
  }

  void start_at(void* ark, double tau, double end) {
    check(ERKStepReset(ark, tau, y_.get()), "ERKStepReset");
    check(ERKStepSetInitStep(ark, std::min(end - tau, 0.01 / rate_)), "ERKStepSetInitStep");
    check(ERKStepSetStopTime(ark, end), "ERKStepSetStopTime");
  }

  void integrate_again(N_Vector from, double before, double tau) {
    N_VScale(1, from, y_.get());
    double reached = before;
    if (!(tau > before)) return;
    start_at(locator_.get(), before, tau);
    check(ERKStepEvolve(locator_.get(), tau, y_.get(), &reached, ARK_NORMAL), "ERKStepEvolve");
  }

  // Newton's method on u' or z, bisection on the argument of a kink, each time integrated anew from the start of the
  // step. Leaves the state there in y.
  double locate(int event, N_Vector from, double before, double tau, double h) {
    if (event >= kinks && event < root_count) {
      // ARKODE's cubic misses a root by a fraction of the fourth power of rate times step, (0.1)^4 at most: 1e-3 is more.
      double low = before, high = std::min(h, tau + 1e-3 * (tau - before));
      for (int i = 0; i < 60 && high - low > 1e-16; ++i) {
        tau = 0.5 * (low + high);
        integrate_again(from, before, tau);
        (kink(event - kinks, tau, N_VGetArrayPointer(y_.get())) > 0 ? low : high) = tau;
      }
      integrate_again(from, before, high);
      return high;
    }
    for (int i = 0; i < 10; ++i) {
      integrate_again(from, before, tau);
      if (event == root_count) break;
      double rates[state_size];
      derivatives(tau, N_VGetArrayPointer(y_.get()), rates);
      const int which = event == turns ? v : z;
      const double newton = tau - N_VGetArrayPointer(y_.get())[which] / rates[which];
      const double next = newton > before && newton <= h ? newton : 0.5 * (before + tau);
      if (!(std::abs(next - tau) > 1e-16 * (1 / rate_ + tau))) break;
      tau = next;
    }
    return tau;
  }

  // The state at the end of a step. True: an event, the leg is over.
  bool arrive(double tau, double before, int event) {
    const double* y = N_VGetArrayPointer(y_.get());
    const double earlier = std::abs(trajectory_.zeta);
    trajectory_.add_path(y[path] - path_);
    path_ = y[path];
    trajectory_.v = y[v];
    trajectory_.zeta = y[z] / strongest_;
    trajectory_.slip = y[u] - law_.yield_displacement_m * y[z];
    for (int i = 0; i < max_states; ++i) trajectory_.law_state.states[static_cast<std::size_t>(i)] = y[own + i];
    if (tau - before > trajectory_.instant_s) trajectory_.law_state.left_kinks();
    const double half = trajectory_.contact.sliding;
    if (side_ == sigma_ && earlier <= half && std::abs(trajectory_.zeta) > half)
      trajectory_.begin_slide(trajectory_.cursor.time() + 0.5 * (before + tau));
    if (!trajectory_.simple()) {
      double rates[state_size];
      derivatives(tau, y, rates);
      trajectory_.observe_acceleration(rates[v] + a(tau) - trajectory_.push,
                                       std::max(0.0, floor_.g.at(tau)) - trajectory_.gravity);
    }
    const bool saturates = side_ == sigma_ && !held_ && held_is_right(y[z]);
    if (event == root_count && !saturates) return false;
    trajectory_.cursor.advance(tau);
    if (event == turns) {
      trajectory_.turn();
      sigma_ = 0;
    } else if (event == crosses_zero) {
      side_ = trajectory_.law_state.side = sigma_;
    } else if (event < root_count) {
      trajectory_.law_state.turn_kink(event - kinks);
    } else {
      held_ = true;
    }
    return true;
  }

  // z rounds off to 1e-16 of itself, and its n-th power, n up to 100, to 1e-14.
  bool held_is_right(double z_value) const {
    return 1 - (law_.gamma + law_.beta) * std::pow(std::abs(z_value), law_.exponent) < 1e-14;
  }

  void write() {
    double* y = N_VGetArrayPointer(y_.get());
    y[u] = trajectory_.displacement();
    y[v] = trajectory_.v;
    y[z] = z_now();
    path_ = y[path] = 0;
    for (int i = 0; i < max_states; ++i) y[own + i] = trajectory_.law_state.states[static_cast<std::size_t>(i)];
  }

  void derivatives(double tau, const double* y, double* rates) const {
    const double yields =
        held_ ? 1 : (law_.beta + law_.gamma * sigma_ * side_) * std::pow(std::max(0.0, side_ * y[z]), law_.exponent);
    rates[u] = y[v];
    rates[v] = -a(tau) - hold(tau) * y[z];
    std::fill(rates + own, rates + state_size, 0.0);
    if (trajectory_.laws)
      with_laws(tau, y, [&](double hold, const auto& laws) {
        rates[v] = -a(tau) - hold;
        for (int i = 0; i < trajectory_.laws->states; ++i) rates[own + i] = laws.state_rate(i);
      });
    rates[z] = y[v] * (1 - yields) / law_.yield_displacement_m;
    rates[path] = std::abs(y[v] * yields);
  }

  // use(what holds the block back [m/s2], the laws at this instant).
  template <class Use>
  void with_laws(double tau, const double* y, Use&& use) const {
    const double s = sigma_ == 0 ? 1 : sigma_;
    BoucWenArc<1> arc{};
    arc.v[0] = s * y[v];
    arc.zeta[0] = s * y[z] / strongest_;
    const BoucWenStart start{trajectory_.cursor.time() + tau, y[u] - law_.yield_displacement_m * y[z],
                             trajectory_.path() + y[path] - path_, s > 0 ? 1 : -1, false};
    const Series<double, 1> force{hold(tau) * strongest_, 0}, g{floor_.g.at(tau), 0};
    BoucWenLawState state = trajectory_.law_state;
    for (int i = 0; i < max_states; ++i) state.states[static_cast<std::size_t>(i)] = y[own + i];
    BoucWenLawHold<1> laws(*trajectory_.laws, state, start, trajectory_.contact, arc, force, g);
    use(s * laws(0), laws);
  }

  // The argument of kink j, positive on its present side.
  double kink(int j, double tau, const double* y) const {
    double argument = 1;
    if (trajectory_.laws && j < trajectory_.laws->tape.kink_count() && trajectory_.law_state.watches(j) &&
        !trajectory_.laws->tape.latched(j, trajectory_.law_state.sides))
      with_laws(tau, y, [&](double, const auto& laws) { argument = laws.kink_now(j); });
    return argument;
  }

  static int derivative(double tau, N_Vector y, N_Vector rates, void* self) {
    static_cast<Reference*>(self)->derivatives(tau, N_VGetArrayPointer(y), N_VGetArrayPointer(rates));
    return 0;
  }

  static int roots(double tau, N_Vector y, double* g, void* self) {
    const auto& me = *static_cast<Reference*>(self);
    const double* state = N_VGetArrayPointer(y);
    g[turns] = state[v];
    double rates[state_size];
    me.derivatives(tau, state, rates);
    g[accelerates] = rates[v];
    g[crosses_zero] = me.side_ == me.sigma_ ? 1 : state[z];
    for (int j = 0; j < max_kinks; ++j) g[kinks + j] = me.kink(j, tau, state);
    return 0;
  }

  BoucWenTrajectory trajectory_;
  const BoucWen law_;
  double mu_, strongest_, rate_;  // strongest_: largest |z|; rate_: of the elastic ringing [rad/s]
  Floor<double, max_floor_degree> floor_{};
  int sigma_ = 0, side_ = 0;  // signs of u' and z
  bool held_ = false;
  double path_ = 0;  // since the start of the leg [m]
  std::unique_ptr<_SUNContext, Delete> context_;
  std::unique_ptr<_generic_N_Vector, Delete> y_, tolerances_;
  Arkode stepper_, locator_;
};

}  // namespace

Response respond_bouc_wen_reference(const Setup& setup, const Settings& settings, History* history) {
  if (!admissible_bouc_wen(setup, settings)) return Response{.outcome = Outcome::not_finite};
  return Reference(setup, settings, history).run();
}

}  // namespace freestand::dynamics
