// The equations of motion with effects: contact.hpp's, with the friction factor F, the added force X and moment T, the
// share M of the mass that moves sideways with the block, legs, and states of the effects' own.
//
//   f_x = M (w' + r_y theta'' - r_x omega^2 + a) - X,   f_y = g' - r_x theta'' - r_y omega^2;   g' less the laws' lift Y
//   k^2 theta'' = r_x f_y - r_y f_x + T
//
//   rock        (k^2 + r_x^2 + M r_y^2) theta'' = r_x (g' - r_y omega^2) - r_y (M (a - r_x omega^2) - X) + T
//   slide-rock  f_x = -sigma mu F f_y:  (k^2 + r_x q) theta'' = n q + T,  q = r_x + sigma mu F r_y,  n = g' - r_y omega^2
//   on legs     w is the speed of the block's base, over the legs; the foot under them moves by w - y', y the deflection.
//               stuck: y' = w and f_x = -(W^2 y + 2 z W w);  slipping: f_x = -sigma mu F f_y and y' follows from the legs.
//               (k^2 + r_x^2) theta'' = r_x (g' - r_y omega^2) - r_y f_x + T when stuck
//   then        w' = (f_x + X)/M - a - r_y theta'' + r_x omega^2
//   leaning     an edge at height e stays at a wall, w + e omega = 0, whose push adds X_w to X and l X_w to T, l = e - r_y:
//               stuck: nothing moves, e X_w = r_y (M a - X) - r_x g' - T;
//               slipping: (k^2 + r_x q + l (M l + sigma mu F r_x)) theta'' = n q + T + l A,  X_w = A - (M l + sigma mu F r_x) theta'',
//               A = M (a - r_x omega^2 - e' omega) - X + sigma mu F n
//   F of f_y    slide-rock is an equation for f_y: f_y = n - r_x theta'', k^2 theta'' = r_x f_y + sigma mu F(f_y) r_y f_y + T.
//               The corner is let go where the block without it would leave the floor: n = r_x T/k^2. There f_y need not vanish.
#pragma once

#include <type_traits>

#include "dynamics/equation.hpp"
#include "dynamics/law_place.hpp"
#include "dynamics/leaning.hpp"

namespace freestand::dynamics {

template <int N, class Real = double, class Numbers = OwnNumbers, class Kind = AnyKind>
class LawStep : OwnStanding<Real>, LawPlace<N, Real, Numbers, Kind> {
  using Place = LawPlace<N, Real, Numbers, Kind>;
  using Place::force_, Place::factor_from_tape, Place::forces_of_laws, Place::see_normal;
  using Place::laws_, Place::at_, Place::numbers_, Place::floor_, Place::legs_, Place::y_, Place::values_;
  using Place::omega2_, Place::rx_omega2_, Place::sine_, Place::cosine_;
  using Place::turns, Place::slips, Place::value;

  static constexpr bool single = std::is_same_v<Real, double>;

 public:
  // A foot under legs that is slower does not slip [m/s]. In a minute it would slip 6e-9 m; the round-off of its speed, that of a force over
  // 2 z W, is 4e-15 m/s on legs of 2 Hz with z = 0.01.
  static constexpr double foot_zero = 1e-10;

  // One sample.
  LawStep(const Rig& rig, const State& state, double time, const Floor<double, N>& floor)
      : OwnStanding<Real>{standing_of(rig, state, time)},
        Place(*rig.laws, this->own, {rig.laws->tape, state.sides}, {state.pivot != 0, state.sigma != 0}, floor),
        rig_(&rig),
        state_(&state) {
    prepare();
    leans_ = turns() && state.at_wall();
    rocks_plainly_ = rocks_plainly_ && !leans_;
    friction_sees_force_ = friction_sees_force_ && !leans_;
    if (leans_) leaning_.lever = lever_over_corner(rig, state.pivot, state.wall, state.edge);
  }

  // Samples of one kind that have the laws' tape in common, but for its numbers. Those for which Laws::in_packs() holds. `at` and
  // `floor` are read anew by every run().
  LawStep(const Laws& laws, const Standing<Real>& at, const Numbers& numbers, const Kind& kind,
          const Floor<Real, N>& floor)
      : Place(laws, at, numbers, kind, floor) {
    prepare();
  }
  LawStep(const LawStep&) = delete;
  LawStep& operator=(const LawStep&) = delete;

  const LawArc<N, Real>& run() {
    begin();
    if (turns() && !slips() && rocks_plainly_) {
      rock();
    } else {
#pragma GCC unroll 16
      for (int k = 0; k < N; ++k) coefficient(k);
    }
    finish();
    return y_;
  }

  // Lanes whose forces were found: others have to be looked at alone.
  auto has_found_forces() const { return feedback_.found(); }

  const LawArc<N, Real>& accelerations() {  // alone: coefficients 1 of the speeds
    begin();
    coefficient(0);
    return y_;
  }

 private:
  void prepare() {
    if (laws_.moment < 0) y_.moment = Series<Real, N>::zero();
    if (turns() && !slips() && rocks_plainly_) y_.path = y_.foot = y_.n = y_.d = Series<Real, N>::zero();
    if (laws_.friction < 0) {
      factor_ = Series<Real, N>::zero();
      factor_[0] = Real(1.0);
    }
  }

  void begin() {
    Place::begin();
    const auto& [c, h, k2] = at_.body;
    if (whole_) over_inertia_ = Real(1.0) / (k2 + c * c + h * h);
  }

  // Stuck on a corner, all of the mass moving with the block, the terms in omega^2 cancel in
  //   (k^2 + r^2) theta'' = r_x g' - r_y (a - X) + T,   and   f_x = r_x'' + a - X,  f_y = r_y'' + g'.
  void rock() {
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) {
      this->inputs(k);
      forces_of_laws(k);
      Real numerator = y_.moment[k];
      if constexpr (single)
        numerator = product(y_.rx, floor_.g, k) - product(y_.ry, floor_.a, k) + numerator;
      else
        numerator =
            product<Kind::vertical_degree>(y_.rx, floor_.g, k) - product<Kind::degree>(y_.ry, floor_.a, k) + numerator;
      if (laws_.force >= 0) numerator = numerator + product(y_.ry, force_, k);
      y_.alpha[k] = numerator * over_inertia_;
      integrate_coefficient(y_, Real(0.0), k);
    }
    const Real beyond_x = product(y_.ry, y_.omega, N), beyond_y = -product(y_.rx, y_.omega, N);  // of r', coefficient N
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) {
      const Real more(k + 1.0), rate(k + 2.0);
      y_.ax[k] = more * (k < N - 1 ? rate * y_.rx[k + 2] : beyond_x) + floor_.a[k];
      y_.fy[k] = more * (k < N - 1 ? rate * y_.ry[k + 2] : beyond_y) + floor_.g[k];
      y_.fx[k] = laws_.force < 0 ? y_.ax[k] : y_.ax[k] - force_[k];
      if (laws_.reads(Input::normal)) see_normal(k, y_.fy[k] * Real(1 / standard_gravity_mps2));
    }
  }

  [[gnu::always_inline]] void coefficient(int k) {
    this->kinematics(k);
    forces(k);
    integrate(k);
  }

  // On a corner laws may depend on the normal force, which depends on them.
  [[gnu::always_inline]] void forces(int k) {
    if (sees_force_) return act_for_normal(k);
    const bool seen = laws_.reads(Input::normal);
    if (seen && laws_.lift >= 0) see_normal(k, y_.n[k] * Real(1 / standard_gravity_mps2)), forces_of_laws(k);
    const Real normal = act(k, seen ? y_.n[k] * Real(1 / standard_gravity_mps2) : Real(0.0));
    if (seen) see_normal(k, normal);
  }

  // The normal force that the laws look at is the one that comes of them.
  [[gnu::noinline]] void act_for_normal(int k) {
    const Real none(0.0), guess = y_.n[0] * Real(1 / standard_gravity_mps2);
    const auto normal = [&](const Real& seen) { return act_alone(k, seen); };
    if (k > 0) return static_cast<void>(normal(let_go_ ? none : feedback_.next(k, normal)));
    if (!friction_sees_force_) return static_cast<void>(feedback_.first(guess, normal));
    if (laws_.moment >= 0 || laws_.lift >= 0) normal(none);
    const auto lets_go = y_.n[0] * at_.body.k2 < y_.rx[0] * y_.moment[0];
    if constexpr (single)
      if ((let_go_ = lets_go)) return static_cast<void>(normal(none));
    feedback_.first_upward(guess, normal, lets_go);
  }

  // Laws, contact forces and accelerations of order k for a normal force [m g]; the normal force that comes out.
  [[gnu::always_inline]] Real act(int k, const Real& normal) {
    if (laws_.reads(Input::normal)) see_normal(k, normal);
    if (friction_sees_force_) y_.fy[k] = Real(standard_gravity_mps2) * normal;
    forces_of_laws(k);
    if (!slips()) {
      stuck(k);
    } else {
      bool found = false;
      if constexpr (single)
        if (legs_ && laws_.friction >= 0 && laws_.tape.depends(laws_.friction, Input::speed)) {
          const auto foot = [&](double speed) { return slip_of_foot(k, speed); };
          k == 0 ? feedback_of_foot_.first(std::fmax(at_.sigma * at_.foot, 0.0), foot)
                 : foot(feedback_of_foot_.next(k, foot));
          found = true;
        }
      if (!found) slip(k);
    }
    if constexpr (single) {
      if (legs_ && k == 0 && std::abs(y_.foot[0]) < foot_zero * state_->doubt) y_.foot[0] = 0;
      if (let_go_) y_.foot[k] = k == 0 ? (legs_ ? at_.foot : at_.w) : 0.0;  // it stands on nothing that would tell
    }
    if (friction_sees_force_) return (y_.n[k] - product(y_.rx, y_.alpha, k)) * Real(1 / standard_gravity_mps2);
    return y_.fy[k] * Real(1 / standard_gravity_mps2);
  }
  // The same as a function of its own, for what few samples ask: the compiler has it once for all orders.
  [[gnu::noinline]] Real act_alone(int k, const Real& normal) { return act(k, normal); }

  // The slip at a speed of order k that the laws see; the speed that comes out.
  Real slip_of_foot(int k, const Real& speed) {
    value(Input::speed)[k] = legs_ && (k == 0 ? speed : value(Input::speed)[0]) <= 0 ? 0.0 : speed;
    slip(k);
    return at_.sigma * y_.foot[k];
  }
  [[gnu::always_inline]] void slip(int k) {
    if (laws_.friction >= 0) factor_[k] = factor_from_tape(k);
    slipping(k);
  }

  // theta'' D = numerator, D[0..k] known.
  [[gnu::always_inline]] Real quotient(Real numerator, const Series<Real, N>& d, int k) {
    if (k == 0) over_d_ = Real(1.0) / d[0];
#pragma GCC unroll 16
    for (int i = 1; i <= k; ++i) numerator = numerator - d[i] * y_.alpha[k - i];
    return numerator * over_d_;
  }

  [[gnu::always_inline]] void stuck(int k) {
    if constexpr (single)
      if (leans_) return lean_stuck(k);
    const Real leg_force = legs_ ? -(W2() * y_.deflection[k] + zW2() * y_.w[k]) : Real(0.0);
    if (!turns()) {
      y_.alpha[k] = Real(0.0);
    } else {
      load_[k] = legs_ ? leg_force : of_mass(floor_.a[k] - rx_omega2_[k]) - force_[k];  // or f_x of the legs
      const Real numerator = product(y_.rx, y_.n, k) - product(y_.ry, load_, k) + y_.moment[k];
      if (whole_ && !legs_) {
        y_.alpha[k] = numerator * over_inertia_;
      } else {
        const Real moved = legs_ ? Real(0.0) : at_.mass;
        inertia_[k] = product(y_.rx, y_.rx, k) + moved * product(y_.ry, y_.ry, k) + (k == 0 ? at_.body.k2 : Real(0.0));
        y_.alpha[k] = quotient(numerator, inertia_, k);
      }
    }
    y_.fy[k] = turns() ? y_.n[k] - product(y_.rx, y_.alpha, k) : y_.n[k];
    const Real besides_w = own_acceleration(k);
    y_.fx[k] = legs_ ? leg_force : of_mass(besides_w) - force_[k];
    y_.ax[k] = per_mass(y_.fx[k] + force_[k]);
    acceleration_ = legs_ ? y_.ax[k] - besides_w : Real(0.0);
    y_.foot[k] = Real(0.0);
    deflection_rate_ = legs_ ? y_.w[k] : Real(0.0);
  }

  // What the wall would push if the block did not turn and nothing rubbed.
  void reach(int k) {
    leaning_.reach(k, sine_, cosine_, y_, at_.mass * (floor_.a[k] - rx_omega2_[k]) - force_[k], at_.mass);
  }
  void lean_stuck(int k) {
    reach(k);
    const double pushed = leaning_.pushed[k];
    const double push = (y_.ry[0] * pushed - y_.rx[0] * y_.n[k] - y_.moment[k]) / leaning_.height[0];
    y_.alpha[k] = 0;
    y_.fy[k] = y_.n[k];
    y_.fx[k] = pushed - push;
    y_.ax[k] = floor_.a[k];
    acceleration_ = y_.foot[k] = deflection_rate_ = 0;
    y_.wall_push[k] = -state_->wall * push;
  }

  // After q and the friction factor are known to order k.
  void lean_slipping(int k, double sigma_mu) {
    auto& [lever, height, height_rate, over_centre, pushed, inertia] = leaning_;
    friction_[k] = sigma_mu * factor_[k];
    reach(k);
    pushed[k] += product(friction_, y_.n, k);
    inertia[k] = at_.mass * over_centre[k] + product(friction_, y_.rx, k);
    y_.d[k] += product(over_centre, inertia, k);
    y_.alpha[k] = quotient(product(y_.n, q_, k) + y_.moment[k] + product(over_centre, pushed, k), y_.d, k);
    wall_force_ = pushed[k] - product(inertia, y_.alpha, k);
    y_.wall_push[k] = -state_->wall * wall_force_;
  }

  // Acceleration of the centre of mass, the floor's included, that is not w'.
  [[gnu::always_inline]] Real own_acceleration(int k) const {
    if (!turns()) return floor_.a[k];
    return product(y_.ry, y_.alpha, k) - rx_omega2_[k] + floor_.a[k];
  }

  [[gnu::always_inline]] void slipping(int k) {
    apply_factor(k);
    y_.ax[k] = per_mass(y_.fx[k] + force_[k] + wall_force_);
    acceleration_ = y_.ax[k] - own_acceleration(k);
    deflection_rate_ = legs_ ? (-y_.fx[k] - W2() * y_.deflection[k]) / zW2() : Real(0.0);
    y_.foot[k] = legs_ ? y_.w[k] - deflection_rate_ : y_.w[k];
  }

  // Contact forces and theta'' for the factor F whose coefficient k is in factor_.
  [[gnu::always_inline]] void apply_factor(int k) {
    const Real sigma_mu = at_.sigma * at_.mu_k;
    if (!turns()) {
      y_.alpha[k] = Real(0.0);
      y_.fy[k] = y_.n[k];
    } else if (friction_sees_force_) {
      y_.d[k] = k == 0 ? at_.body.k2 : Real(0.0);
      friction_[k] = sigma_mu * product(factor_, y_.fy, k);
      y_.alpha[k] =
          (product(y_.rx, y_.fy, k) + product(y_.ry, friction_, k) + y_.moment[k]) * (Real(1.0) / at_.body.k2);
    } else {
      q_[k] = y_.rx[k] + sigma_mu * with_factor(y_.ry, k);
      y_.d[k] = product(y_.rx, q_, k) + (k == 0 ? at_.body.k2 : Real(0.0));
      bool leans = false;
      if constexpr (single)
        if (leans_) lean_slipping(k, sigma_mu), leans = true;
      if (!leans) y_.alpha[k] = quotient(product(y_.n, q_, k) + y_.moment[k], y_.d, k);
      y_.fy[k] = y_.n[k] - product(y_.rx, y_.alpha, k);
    }
    y_.fx[k] = -(sigma_mu * with_factor(y_.fy, k));
  }

  Real with_factor(const Series<Real, N>& x, int k) const { return laws_.friction < 0 ? x[k] : product(factor_, x, k); }

  [[gnu::always_inline]] void integrate(int k) {
    const Real over(1.0 / (k + 1));
    if (laws_.states > 0) {
      value(Input::acceleration)[k] = y_.ax[k];
      laws_.tape.advance(laws_.friction_end, laws_.tape.size(), k, numbers_, values_);
      for (int i = 0; i < laws_.states; ++i) value(Input::state, i)[k + 1] = values_[laws_.rate[i]][k] * over;
    }
    y_.path[k + 1] = at_.sigma * y_.foot[k] * over;
    if (legs_) y_.deflection[k + 1] = deflection_rate_ * over;
    if (turns()) return integrate_coefficient(y_, acceleration_, k);
    y_.theta[k + 1] = y_.omega[k + 1] = y_.rx[k + 1] = y_.ry[k + 1] = Real(0.0);
    y_.xi[k + 1] = y_.w[k] * over;
    y_.w[k + 1] = acceleration_ * over;
  }

  void finish() {
    finish_arc(y_);
    y_.ax[N] = y_.foot[N] = y_.moment[N] = y_.lift[N] = Real(0.0);
    y_.friction = slips() ? factor_[0] : Real(1.0);
    y_.pressed = y_.fy;
    for (int k = 0; k < N && friction_sees_force_; ++k)
      y_.pressed[k] = y_.n[k] - product(y_.rx, y_.moment, k) / at_.body.k2;
    if (laws_.walls.any()) this->gaps();
    for (int i = 0; i < laws_.states; ++i) y_.states[i][N] = value(Input::state, i)[N];
    limits();
    kinks();
  }

  void kinks() {
    if constexpr (single) {
      Kinks now = *state_;
      now.sides = numbers_.sides();
      for (int j = 0; j < laws_.tape.kink_count(); ++j) y_.kink[j] = kink_argument(laws_.tape, now, j, values_);
    } else {
      for (int j = 0; j < laws_.tape.kink_count(); ++j) {
        y_.kink[j] = scaled(numbers_.on_side(j, Real(1.0), Real(-1.0)), values_[laws_.tape.kink_argument(j)]);
        y_.kink[j][0] = numbers_.unless_met(j, y_.kink[j][0]);
        y_.kink[j][N] = Real(0.0);
      }
    }
  }

  // Largest friction against a slip that is about to begin, to the left and to the right.
  void limits() {
    if (slips()) {
      y_.limit_right = y_.limit_left = Series<Real, N>::zero();
      return;
    }
    if (laws_.friction < 0) {
      y_.limit_right = y_.limit_left = scaled(at_.mu_s, y_.fy);
      return;
    }
    if (laws_.reads(Input::speed)) value(Input::speed) = Series<Real, N>::zero();
    y_.limit_right = limit(-1);
    y_.limit_left = laws_.tape.depends(laws_.friction, Input::sigma) ? limit(+1) : y_.limit_right;
  }

  Series<Real, N> limit(int sigma) {
    Series<Real, N> result;
    if (laws_.reads(Input::sigma)) value(Input::sigma)[0] = Real(double(sigma));
    if constexpr (single) numbers_.turn(laws_.sides_of_slip(numbers_.sides(), state_->turned, values_));
    if (!grip_changes_ && laws_.tape.kink_count() == 0) {  // kinks look at the whole series
      result = scaled(at_.mu_s * factor_from_tape(0), y_.fy);
    } else {
      for (int k = 0; k < N; ++k) {
        factor_[k] = factor_from_tape(k);
        result[k] = at_.mu_s * product(factor_, y_.fy, k);
      }
    }
    result[N] = Real(0.0);
    return result;
  }

  Real of_mass(const Real& x) const { return whole_ ? x : at_.mass * x; }
  Real per_mass(const Real& x) const { return whole_ ? x : x / at_.mass; }
  Real W2() const { return at_.leg_rate * at_.leg_rate; }
  Real zW2() const { return Real(2.0) * at_.leg_damping * at_.leg_rate; }
  const bool whole_ = laws_.carried_mass == 1;  // all of the mass moves with the block
  const bool grip_changes_ = laws_.grip_changes();
  // When it is stuck: nothing in the equations looks at forces or states, or pushes but laws.
  bool rocks_plainly_ = whole_ && !legs_ && laws_.states == 0 && laws_.lift < 0 && !laws_.sees_normal_force(false);
  // On a corner: the laws look at the normal force; friction does, of the corner that it slips on.
  bool sees_force_ = turns() && laws_.sees_normal_force(slips());
  bool friction_sees_force_ =
      sees_force_ && slips() && laws_.friction >= 0 && laws_.tape.depends(laws_.friction, Input::normal);
  Feedback<Numbers, Real> feedback_, feedback_of_foot_;
  Real over_inertia_, over_d_;  // 1/(k^2 + r^2); 1/D at the start
  Series<Real, N> factor_, load_, inertia_, q_, friction_;
  Real acceleration_ = Real(0.0), deflection_rate_ = Real(0.0), wall_force_ = Real(0.0);
  // Of a single sample.
  struct None {};
  const Rig* rig_ = nullptr;
  const State* state_ = nullptr;
  bool leans_ = false;   // an edge at a wall
  bool let_go_ = false;  // the corner that it slips on, by the floor
  [[no_unique_address]] std::conditional_t<single, Leaning<N>, None> leaning_;
};

}  // namespace freestand::dynamics
