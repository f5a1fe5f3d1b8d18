// The equations of motion with effects: contact.hpp's, with the friction factor F, the added force X and moment T, the
// share M of the mass that moves sideways with the block, legs, and states of the effects' own.
//
//   f_x = M (w' + r_y theta'' - r_x omega^2 + a) - X,   f_y = g' - r_x theta'' - r_y omega^2
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

#include "dynamics/contact.hpp"
#include "dynamics/equation.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/wall.hpp"

namespace freestand::dynamics {

template <int N>
struct LawArc : Arc<double, N> {
  Series<double, N> ax;                       // absolute horizontal acceleration of the centre of mass [m/s2]
  Series<double, N> moment;                   // T [m2/s2]
  Series<double, N> limit_right, limit_left;  // largest |f_x| without slip, f_x to the right and to the left [m/s2]
  Series<double, N> foot;                     // slip speed of the contact [m/s]
  Series<double, N> path;                     // [m]
  Series<double, N> deflection;               // of the legs [m]
  Series<double, N> states[max_states];       // of the effects' own: `state_count` of them
  int state_count;
  Series<double, N> kink[max_kinks];  // arguments, positive on the present side
  Series<double, N> pressed;          // f_y, or what of it decides whether the corner is let go [m/s2]
  // With walls only.
  Series<double, N> right_gap, left_gap;  // between the wall there and the edge next to it [m]
  Series<double, N> wall_push;            // of the wall that the block leans on [m/s2]
};

// Whether an equation that has the laws in it has a solution: friction that looks at its own normal force may have none.
template <int N>
bool has_forces(const LawArc<N>& arc) {
  double sum = 0;
  for (int k = 0; k < N; ++k) sum += arc.fx[k] + arc.fy[k] + arc.alpha[k] + arc.foot[k];
  return std::isfinite(sum);
}
template <int N>
bool has_forces(const Arc<double, N>&) {
  return true;
}

template <int N>
class LawStep {
 public:
  LawStep(const Rig& rig, const State& state, double time, const Floor<double, N>& floor)
      : rig_(rig),
        laws_(*rig.laws),
        state_(state),
        floor_(floor),
        turns_(state.pivot != 0),
        leans_(turns_ && state.at_wall()),
        pivot_(turns_ ? state.pivot : 1),
        body_(rig.corner(pivot_)),
        legs_(laws_.legs.frequency_radps > 0),
        sides_(state.sides),
        friction_sees_force_(turns_ && !leans_ && state.sigma != 0 && laws_.friction >= 0 &&
                             laws_.tape.depends(laws_.friction, Input::normal)) {
    start_arc(y_, body_, state.theta, state.omega, state.xi, state.w);
    y_.path[0] = state.path;
    y_.deflection[0] = state.deflection;
    y_.state_count = laws_.states;
    for (int i = 0; i < laws_.states; ++i) value(Input::state, i)[0] = state.states[i];
    for (int k = 0; k <= N; ++k) {
      value(Input::t)[k] = k == 0 ? time : k == 1 ? 1.0 : 0.0;
      value(Input::side)[k] = k == 0 ? state.pivot : 0.0;
      value(Input::sigma)[k] = k == 0 ? state.sigma : 0.0;
      y_.moment[k] = 0;
    }
    factor_ = Series<double, N>::zero();
    if (laws_.friction < 0) factor_[0] = 1;
  }

  const LawArc<N>& run() {
    for (int k = 0; k < N; ++k) {
      kinematics(k);
      forces(k);
      integrate(k);
    }
    finish();
    return y_;
  }

 private:
  Series<double, N>& value(Input input, int offset = 0) { return values_[static_cast<int>(input) + offset]; }

  void kinematics(int k) {
    omega2_[k] = turns_ ? product(y_.omega, y_.omega, k) : 0.0;
    y_.n[k] = turns_ ? floor_.g[k] - product(y_.ry, omega2_, k) : floor_.g[k];
    y_.d[k] = 0;
    Series<double, N>&u = value(Input::u), &v = value(Input::v);
    u[k] = y_.xi[k];
    v[k] = y_.w[k];
    if (turns_) {
      const double c = body_.c, h = body_.h, to_angle = 1 / (h * h + c * c), B = state_.pivot * rig_.half_base();
      sine_[k] = (h * y_.rx[k] + c * y_.ry[k]) * to_angle;
      cosine_[k] = (h * y_.ry[k] - c * y_.rx[k]) * to_angle;
      const double half = std::sin(0.5 * state_.theta);
      u[k] += B * (k == 0 ? 2 * half * half : -(h * y_.ry[k] - c * y_.rx[k]) * to_angle);
      v[k] += B * product(sine_, y_.omega, k);
    }
    value(Input::theta)[k] = y_.theta[k];
    value(Input::omega)[k] = y_.omega[k];
    value(Input::path)[k] = y_.path[k];
    // Stages of a step that reaches over the end of a slip may ask for a speed below zero, where laws mean nothing. Under legs
    // it is the foot that slips: act() finds its speed.
    if (!legs_) value(Input::speed)[k] = state_.sigma * state_.w < 0 ? 0.0 : state_.sigma * y_.w[k];
    for (int i = 0; i < laws_.states; ++i) y_.states[i][k] = value(Input::state, i)[k];
  }

  // On a corner laws may depend on the normal force, which depends on them.
  void forces(int k) {
    const double guess = y_.n[k] / standard_gravity_mps2;
    if (k == 0 && friction_sees_force_) {
      act(0, 0.0);
      let_go_ = y_.n[0] < y_.rx[0] * y_.moment[0] / body_.k2;
    }
    if (let_go_)
      act(k, 0.0);
    else if (turns_ && laws_see_the_normal_force())
      act(k, solved(k == 0, guess, [&](double normal) { return act(k, normal) - normal; }));
    else
      see_normal(k, act(k, guess));
  }

  // Stages of a step that reaches over a lift-off may ask for a floor that pulls, where laws mean nothing: they see no force
  // then, and a corner whose friction follows its force has none.
  void see_normal(int k, double normal) {
    Series<double, N>& seen = value(Input::normal);
    if (k == 0)
      seen[0] = normal < least_normal ? least_normal : normal;
    else
      seen[k] = seen[0] == least_normal ? 0.0 : normal;
  }

  bool laws_see_the_normal_force() const {
    const auto looks = [&](int node) { return node >= 0 && laws_.tape.depends(node, Input::normal); };
    return looks(laws_.force) || looks(laws_.moment) || (state_.sigma != 0 && looks(laws_.friction));
  }

  // Laws, contact forces and accelerations of order k for a normal force [m g]; the normal force that comes out.
  double act(int k, double normal) {
    see_normal(k, normal);
    y_.fy[k] = standard_gravity_mps2 * normal;
    laws_.tape.advance(input_count, laws_.forces_end, k, sides_, values_);
    force_[k] = laws_.force < 0 ? 0.0 : values_[laws_.force][k];
    if (laws_.moment >= 0) y_.moment[k] = values_[laws_.moment][k];
    if (state_.sigma == 0)
      stuck(k);
    else if (legs_ && laws_.friction >= 0 && laws_.tape.depends(laws_.friction, Input::speed))
      slip_of_foot(k, solved(k == 0, k == 0 ? std::fmax(state_.sigma * state_.foot, 0.0) : 0.0,
                             [&](double speed) { return slip_of_foot(k, speed) - speed; }));
    else
      slip_of_foot(k, value(Input::speed)[k]);
    if (legs_ && k == 0 && std::abs(y_.foot[0]) < foot_zero * state_.doubt) y_.foot[0] = 0;
    if (let_go_) y_.foot[k] = k == 0 ? (legs_ ? state_.foot : state_.w) : 0.0;  // it stands on nothing that would tell
    return (friction_sees_force_ ? y_.n[k] - product(y_.rx, y_.alpha, k) : y_.fy[k]) / standard_gravity_mps2;
  }

  // The slip at a speed of order k that the laws see; the speed that comes out.
  double slip_of_foot(int k, double speed) {
    value(Input::speed)[k] = legs_ && (k == 0 ? speed : value(Input::speed)[0]) <= 0 ? 0.0 : speed;
    if (laws_.friction >= 0) factor_[k] = factor_from_tape(k);
    slipping(k);
    return state_.sigma * y_.foot[k];
  }

  // theta'' D = numerator, D[0..k] known.
  double quotient(double numerator, const Series<double, N>& d, int k) const {
    for (int i = 1; i <= k; ++i) numerator -= d[i] * y_.alpha[k - i];
    return numerator / d[0];
  }

  void stuck(int k) {
    if (leans_) return lean_stuck(k);
    const double M = laws_.carried_mass;
    const double leg_force = legs_ ? -(square(W()) * y_.deflection[k] + 2 * z() * W() * y_.w[k]) : 0.0;
    if (!turns_) {
      y_.alpha[k] = 0;
    } else {
      const double moved = legs_ ? 0 : M;
      inertia_[k] = product(y_.rx, y_.rx, k) + moved * product(y_.ry, y_.ry, k) + (k == 0 ? body_.k2 : 0.0);
      const auto& ax0 = load_;  // M (a - r_x omega^2) - X, or f_x of the legs
      load_[k] = legs_ ? leg_force : M * (floor_.a[k] - product(y_.rx, omega2_, k)) - force_[k];
      y_.alpha[k] = quotient(product(y_.rx, y_.n, k) - product(y_.ry, ax0, k) + y_.moment[k], inertia_, k);
    }
    y_.fy[k] = y_.n[k] - (turns_ ? product(y_.rx, y_.alpha, k) : 0.0);
    y_.fx[k] = legs_ ? leg_force : M * own_acceleration(k) - force_[k];
    y_.ax[k] = (y_.fx[k] + force_[k]) / M;
    acceleration_ = legs_ ? y_.ax[k] - own_acceleration(k) : 0.0;
    y_.foot[k] = 0;
    deflection_rate_ = legs_ ? y_.w[k] : 0.0;
  }

  // Height of the edge at the wall, over the floor and over the centre of mass, and what the wall would push if the block
  // did not turn and nothing rubbed.
  void reach(int k) {
    const EdgeLever lever = lever_over_corner(rig_, pivot_, state_.wall, state_.edge);
    edge_[k] = lever.height(sine_, cosine_, k);
    edge_rate_[k] = lever.height_rate(sine_, cosine_, y_.omega, k);
    over_centre_[k] = edge_[k] - y_.ry[k];
    pushed_[k] =
        laws_.carried_mass * (floor_.a[k] - product(y_.rx, omega2_, k) - product(edge_rate_, y_.omega, k)) - force_[k];
  }

  void lean_stuck(int k) {
    reach(k);
    const double push = (y_.ry[0] * pushed_[k] - y_.rx[0] * floor_.g[k] - y_.moment[k]) / edge_[0];
    y_.alpha[k] = 0;
    y_.fy[k] = y_.n[k];
    y_.fx[k] = pushed_[k] - push;
    y_.ax[k] = floor_.a[k];
    acceleration_ = y_.foot[k] = deflection_rate_ = 0;
    y_.wall_push[k] = -state_.wall * push;
  }

  // After q and the friction factor are known to order k.
  void lean_slipping(int k, double sigma_mu) {
    friction_[k] = sigma_mu * factor_[k];
    reach(k);
    pushed_[k] += product(friction_, y_.n, k);
    const double M = laws_.carried_mass;
    inertia_[k] = M * over_centre_[k] + product(friction_, y_.rx, k);
    y_.d[k] += product(over_centre_, inertia_, k);
    y_.alpha[k] = quotient(product(y_.n, q_, k) + y_.moment[k] + product(over_centre_, pushed_, k), y_.d, k);
    wall_force_ = pushed_[k] - product(inertia_, y_.alpha, k);
    y_.wall_push[k] = -state_.wall * wall_force_;
  }

  // Acceleration of the centre of mass, the floor's included, that is not w'.
  double own_acceleration(int k) const {
    if (!turns_) return floor_.a[k];
    return product(y_.ry, y_.alpha, k) - product(y_.rx, omega2_, k) + floor_.a[k];
  }

  void slipping(int k) {
    apply_factor(k);
    const double M = laws_.carried_mass;
    y_.ax[k] = (y_.fx[k] + force_[k] + wall_force_) / M;
    acceleration_ = y_.ax[k] - own_acceleration(k);
    deflection_rate_ = legs_ ? (-y_.fx[k] - square(W()) * y_.deflection[k]) / (2 * z() * W()) : 0.0;
    y_.foot[k] = y_.w[k] - deflection_rate_;
  }

  // Contact forces and theta'' for the factor F whose coefficient k is in factor_.
  void apply_factor(int k) {
    const double sigma_mu = state_.sigma * rig_.mu_k;
    if (!turns_) {
      y_.alpha[k] = 0;
      y_.fy[k] = y_.n[k];
    } else if (friction_sees_force_) {
      y_.d[k] = k == 0 ? body_.k2 : 0.0;
      friction_[k] = sigma_mu * product(factor_, y_.fy, k);
      y_.alpha[k] = (product(y_.rx, y_.fy, k) + product(y_.ry, friction_, k) + y_.moment[k]) / body_.k2;
    } else {
      q_[k] = y_.rx[k] + sigma_mu * product(factor_, y_.ry, k);
      y_.d[k] = product(y_.rx, q_, k) + (k == 0 ? body_.k2 : 0.0);
      if (leans_)
        lean_slipping(k, sigma_mu);
      else
        y_.alpha[k] = quotient(product(y_.n, q_, k) + y_.moment[k], y_.d, k);
      y_.fy[k] = y_.n[k] - product(y_.rx, y_.alpha, k);
    }
    y_.fx[k] = -sigma_mu * product(factor_, y_.fy, k);
  }

  double factor_from_tape(int k) {
    laws_.tape.advance(laws_.forces_end, laws_.friction_end, k, sides_, values_);
    return values_[laws_.friction][k];
  }

  void integrate(int k) {
    value(Input::acceleration)[k] = y_.ax[k];
    laws_.tape.advance(laws_.friction_end, laws_.tape.size(), k, sides_, values_);
    const double over = 1.0 / (k + 1);
    for (int i = 0; i < laws_.states; ++i)
      value(Input::state, i)[k + 1] = values_[laws_.rate[static_cast<std::size_t>(i)]][k] * over;
    y_.path[k + 1] = state_.sigma * y_.foot[k] * over;
    y_.deflection[k + 1] = deflection_rate_ * over;
    if (turns_) return integrate_coefficient(y_, acceleration_, k);
    y_.theta[k + 1] = y_.omega[k + 1] = y_.rx[k + 1] = y_.ry[k + 1] = 0;
    y_.xi[k + 1] = y_.w[k] * over;
    y_.w[k + 1] = acceleration_ * over;
  }

  void finish() {
    finish_arc(y_);
    y_.ax[N] = y_.foot[N] = 0;
    y_.pressed = y_.fy;
    for (int k = 0; k < N && friction_sees_force_; ++k)
      y_.pressed[k] = y_.n[k] - product(y_.rx, y_.moment, k) / body_.k2;
    if (laws_.walls.any()) gaps();
    for (int i = 0; i < laws_.states; ++i) y_.states[i][N] = value(Input::state, i)[N];
    y_.limit_right = limit(-1);
    y_.limit_left = limit(+1);
    for (int j = 0; j < laws_.tape.kink_count(); ++j) {
      const auto& argument = values_[laws_.tape.kink_argument(j)];
      const double side = sides_ >> j & 1U ? -1.0 : 1.0;
      for (int k = 0; k < N; ++k) y_.kink[j][k] = side * argument[k];
      y_.kink[j][N] = 0;
      if (state_.turned_kink == j) y_.kink[j][0] = 0;
      if (laws_.tape.latched(j, sides_)) y_.kink[j] = Series<double, N>::zero();
    }
  }

  void gaps() {
    if (!turns_) sine_ = Series<double, N>::zero(), cosine_ = sine_, cosine_[0] = 1;
    const double c = body_.c, h = body_.h, to_angle = 1 / (h * h + c * c);
    if (turns_)
      sine_[N] = (h * y_.rx[N] + c * y_.ry[N]) * to_angle, cosine_[N] = (h * y_.ry[N] - c * y_.rx[N]) * to_angle;
    for (const int side : {1, -1}) {
      const EdgeLever lever = lever_over_corner(rig_, pivot_, side, touching_edge(state_.pivot, side));
      (side > 0 ? y_.right_gap : y_.left_gap) = clearance(laws_.walls.on(side), side, lever, y_.xi, sine_, cosine_);
    }
    y_.wall_push[N] = 0;
  }

  // Largest friction against a slip in direction sigma that is about to begin.
  Series<double, N> limit(int sigma) {
    Series<double, N> result = Series<double, N>::zero();
    if (state_.sigma != 0) return result;
    value(Input::sigma)[0] = sigma;
    value(Input::speed) = Series<double, N>::zero();
    sides_ = sides_of_friction();
    for (int k = 0; k < N; ++k) {
      if (laws_.friction >= 0) factor_[k] = factor_from_tape(k);
      result[k] = rig_.mu_s * product(factor_, y_.fy, k);
    }
    return result;
  }

  // On which side of its kinks the friction of that slip is: other kinks than those of forces, and other than the opposite
  // slip's.
  std::uint32_t sides_of_friction() {
    std::uint32_t sides = sides_;
    const Tape& tape = laws_.tape;
    for (int j = 0; j < tape.kink_count(); ++j) {
      const int node = tape.kink_node(j), argument = tape.kink_argument(j);
      if (node < laws_.forces_end || node >= laws_.friction_end || j == state_.turned_kink) continue;
      if (!tape.depends(argument, Input::sigma) && !tape.depends(argument, Input::speed)) continue;
      tape.advance(laws_.forces_end, node, 0, sides, values_);
      sides = (sides & ~(1U << j)) | (values_[argument][0] < 0 ? 1U << j : 0U);
    }
    return sides;
  }

  static double square(double x) { return x * x; }
  double W() const { return laws_.legs.frequency_radps; }
  double z() const { return laws_.legs.damping; }

  static constexpr double foot_zero = 1e-10;  // [m/s]
  // [m g]; less than the round-off of a sum of forces, and more than what makes a power of it overflow.
  static constexpr double least_normal = 1e-18;

  const Rig& rig_;
  const Laws& laws_;
  const State& state_;
  const Floor<double, N>& floor_;
  bool turns_;  // on one corner
  bool leans_;  // and an edge at a wall
  int pivot_;
  Corner<double> body_;
  bool legs_;
  std::uint32_t sides_;       // of the kinks
  bool friction_sees_force_;  // on the corner that it slips on
  bool let_go_ = false;       // that corner, by the floor
  LawArc<N> y_;
  Series<double, N> values_[max_nodes];
  Series<double, N> omega2_, sine_, cosine_, force_, factor_, load_, inertia_, q_;
  Series<double, N> edge_, edge_rate_, over_centre_, pushed_, friction_;  // leaning
  double acceleration_ = 0, deflection_rate_ = 0, wall_force_ = 0;
};

}  // namespace freestand::dynamics
