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
#include "dynamics/bouc_wen_life.hpp"

namespace freestand::dynamics {
namespace {

enum : int { u, v, z, path, state_size };
enum : int { turns, accelerates, crosses_zero, root_count };

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
      : life_(setup, settings, history),
        law_(setup.specimen.bouc_wen),
        mu_(setup.specimen.friction.mu_k),
        strongest_(std::pow(law_.gamma + law_.beta, -1 / law_.exponent)),
        rate_(std::sqrt(std::max(mu_, 1e-3) * life_.gravity / law_.yield_displacement_m)) {
    SUNContext context = nullptr;
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    context_.reset(context);
    y_.reset(N_VNew_Serial(state_size, context));
    tolerances_.reset(N_VNew_Serial(state_size, context));
    N_VConst(0, y_.get());
    stepper_ = make_arkode(settings);
    locator_ = make_arkode(settings);
    check(ERKStepRootInit(stepper_.get(), root_count, &roots), "ERKStepRootInit");
    check(ERKStepSetNoInactiveRootWarn(stepper_.get()), "ERKStepSetNoInactiveRootWarn");
  }

  Response run() {
    while (!life_.finished()) {
      floor_ = life_.cursor.local<max_floor_degree>();
      if (sigma_ == 0 && !set_out())
        life_.stand();
      else
        go();
    }
    return life_.result();
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
    check(ERKStepSVtolerances(ark, tolerance, tolerances_.get()), "ERKStepSVtolerances");
    check(ERKStepSetUserData(ark, this), "ERKStepSetUserData");
    check(ERKStepSetMaxNumSteps(ark, 1000000), "ERKStepSetMaxNumSteps");
    // Peaks of vertical shaking are taken at the ends of steps.
    check(ERKStepSetMaxStep(ark, std::min(0.1 / rate_, life_.vertical ? 5e-4 : 1e9)), "ERKStepSetMaxStep");
    return arkode;
  }

  double a(double tau) const { return floor_.a.at(tau); }
  double hold(double tau) const { return mu_ * std::max(0.0, floor_.g.at(tau)); }

  // The direction in which the block leaves a turn: that of its first acceleration that is not zero. False: none.
  bool set_out() {
    const double zero = life_.force_zero();
    double push = -(floor_.a[0] + hold(0) * z_now());
    for (int k = 1; std::abs(push) <= zero && k <= max_floor_degree; ++k) {
      push = -(floor_.a[k] + (floor_.g[0] > 0 ? mu_ * floor_.g[k] * z_now() : 0));
      if (std::abs(push) <= zero * std::pow(1000.0, k)) push = 0;
    }
    sigma_ = (push > 0) - (push < 0);
    life_.direction = sigma_;
    side_ = z_now() == 0 ? sigma_ : z_now() > 0 ? 1 : -1;
    held_ = sigma_ * z_now() >= strongest_;
    if (side_ == sigma_ && std::abs(life_.zeta) > life_.contact.sliding) life_.begin_slide(life_.cursor.time());
    return sigma_ != 0;
  }
  double z_now() const { return life_.zeta * strongest_; }

  // To the next knot, output time or event.
  void go() {
    record();
    const double h = std::min(life_.time_left(), life_.next_output());
    const bool to_knot = h == life_.cursor.left();
    write();
    start_at(stepper_.get(), 0, h);
    for (double tau = 0; tau < h;) {
      const double before = tau;
      N_Vector from = N_VClone(y_.get());
      N_VScale(1, y_.get(), from);
      int flag = ERKStepEvolve(stepper_.get(), h, y_.get(), &tau, ARK_ONE_STEP);
      check(flag, "ERKStepEvolve");
      int found[root_count] = {};
      if (flag == ARK_ROOT_RETURN) check(ERKStepGetRootInfo(stepper_.get(), found), "ERKStepGetRootInfo");
      const int event = found[turns] ? turns : found[crosses_zero] ? crosses_zero : root_count;
      if (flag == ARK_ROOT_RETURN) tau = locate(event, from, before, tau, h);
      N_VDestroy(from);
      if (arrive(tau, before, event)) return;
      if (flag == ARK_ROOT_RETURN) start_at(stepper_.get(), tau, h);
    }
    life_.cursor.advance(h);
    life_.check();
    if (to_knot) life_.next_segment();
  }

  // Records what is due now.
  void record() {
    constexpr double now = 1e-9;
    life_.record(now, [&](double t) {
      const bool slides = sigma_ * life_.zeta > life_.contact.sliding;
      return HistoryPoint{life_.cursor.time() + t,          a(t), life_.displacement(), life_.v, 0, 0,
                          slides ? Mode::slide : Mode::rest};
    });
  }

  void start_at(void* ark, double tau, double end) {
    check(ERKStepReset(ark, tau, y_.get()), "ERKStepReset");
    check(ERKStepSetInitStep(ark, std::min(end - tau, 0.01 / rate_)), "ERKStepSetInitStep");
    check(ERKStepSetStopTime(ark, end), "ERKStepSetStopTime");
  }

  // Newton's method on u' or z, each time integrated anew from the start of the step. Leaves the state there in y.
  double locate(int event, N_Vector from, double before, double tau, double h) {
    for (int i = 0; i < 10; ++i) {
      N_VScale(1, from, y_.get());
      double reached = before;
      if (tau > before) {
        start_at(locator_.get(), before, tau);
        check(ERKStepEvolve(locator_.get(), tau, y_.get(), &reached, ARK_NORMAL), "ERKStepEvolve");
      }
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
    const double earlier = std::abs(life_.zeta);
    life_.add_path(y[path] - path_);
    path_ = y[path];
    life_.v = y[v];
    life_.zeta = y[z] / strongest_;
    life_.slip = y[u] - law_.yield_displacement_m * y[z];
    const double half = life_.contact.sliding;
    if (side_ == sigma_ && earlier <= half && std::abs(life_.zeta) > half)
      life_.begin_slide(life_.cursor.time() + 0.5 * (before + tau));
    if (life_.vertical) life_.observe_acceleration(hold(tau) * y[z], std::max(0.0, floor_.g.at(tau)) - life_.gravity);
    const bool saturates = side_ == sigma_ && !held_ && held_is_right(y[z]);
    if (event == root_count && !saturates) return false;
    life_.cursor.advance(tau);
    if (event == turns) {
      life_.turn();
      sigma_ = 0;
    } else if (event == crosses_zero) {
      side_ = sigma_;
    } else {
      held_ = true;
    }
    return true;
  }

  bool held_is_right(double z_value) const {
    return 1 - (law_.gamma + law_.beta) * std::pow(std::abs(z_value), law_.exponent) < 1e-14;
  }

  void write() {
    double* y = N_VGetArrayPointer(y_.get());
    y[u] = life_.displacement();
    y[v] = life_.v;
    y[z] = z_now();
    path_ = y[path] = 0;
  }

  void derivatives(double tau, const double* y, double* rates) const {
    const double yields =
        held_ ? 1 : (law_.beta + law_.gamma * sigma_ * side_) * std::pow(std::max(0.0, side_ * y[z]), law_.exponent);
    rates[u] = y[v];
    rates[v] = -a(tau) - hold(tau) * y[z];
    rates[z] = y[v] * (1 - yields) / law_.yield_displacement_m;
    rates[path] = std::abs(y[v] * yields);
  }

  static int derivative(double tau, N_Vector y, N_Vector rates, void* self) {
    static_cast<Reference*>(self)->derivatives(tau, N_VGetArrayPointer(y), N_VGetArrayPointer(rates));
    return 0;
  }

  static int roots(double tau, N_Vector y, double* g, void* self) {
    const auto& me = *static_cast<Reference*>(self);
    const double* state = N_VGetArrayPointer(y);
    g[turns] = state[v];
    g[accelerates] = me.a(tau) + me.hold(tau) * state[z];
    g[crosses_zero] = me.side_ == me.sigma_ ? 1 : state[z];
    return 0;
  }

  BoucWenLife life_;
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
