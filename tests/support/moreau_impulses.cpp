// The impulses of a step: which contacts carry, and how.
#include <algorithm>
#include <cmath>
#include <utility>

#include "support/moreau_stepper.hpp"

namespace freestand::test {
namespace {

int side_of(int edge) { return edge / 2 == left ? -1 : 1; }
bool holds(unsigned edges, int edge) { return (edges >> edge & 1U) != 0; }
constexpr unsigned face(int side) { return 3U << 2 * (side < 0 ? left : right); }

// Gaussian elimination with pivots. False: singular.
bool solve(double (&a)[4][5], int n) {
  for (int i = 0; i < n; ++i) {
    int best = i;
    for (int j = i + 1; j < n; ++j)
      if (std::abs(a[j][i]) > std::abs(a[best][i])) best = j;
    if (std::abs(a[best][i]) < 1e-12) return false;
    for (int k = 0; k <= 4; ++k) std::swap(a[i][k], a[best][k]);
    for (int j = 0; j < n; ++j) {
      if (j == i) continue;
      const double factor = a[j][i] / a[i][i];
      for (int k = 0; k <= 4; ++k) a[j][k] -= factor * a[i][k];
    }
  }
  for (int i = 0; i < n; ++i) a[i][4] /= a[i][i];
  return true;
}

}  // namespace

// Largest ratio of tangential to normal impulse of a contact that is stuck in this case.
double MoreauStepper::holding(const Step& step, const Case& c) const {
  ContactLaws::Place place = step.place;
  if (!step.blow) place.normal_g = c.total() / (step.dt * standard_gravity_mps2);
  return laws_.holding(place, step.age, c.tangential < 0 ? 1 : -1, step.blow ? step.speed : 0);
}

// Both closed: the base is flat, lift speeds zero means Y' = 0 and theta' = 0.
void MoreauStepper::both_corners(const Step& step, Grip grip, Case& c) const {
  const double total = -step.free.y, M = laws_.carried();
  const bool on_legs = laws_.legs_radps > 0;
  c.tangential = on_legs ? step.dt * step.leg_force : -M * step.free.x;
  if (grip != Grip::stuck)
    c.tangential = -direction(grip) * laws_.sliding(step.place, step.speed, direction(grip)) * total;
  const double moment = body_.height_m * c.tangential - step.free.q * body_.gyration2_m2;  // b_l N_l - b_r N_r
  c.normal[left] = (moment + body_.right_m * total) / (body_.left_m + body_.right_m);
  c.normal[right] = total - c.normal[left];
  c.next = {grip == Grip::stuck && !on_legs ? 0 : step.free.x + c.tangential / M, 0, 0};
  c.slip = c.next.x;
}

// The block stands with its face against a wall. Towards the wall M x'_free is to be taken up, by friction T and the
// wall's P >= 0, which acts anywhere between floor and top and so turns the block back by 0 to 2 h P about the floor.
// False: it cannot stand.
bool MoreauStepper::against_face(const Step& step, int side, Case& c) const {
  const double total = -step.free.y, h = body_.height_m, push = side * laws_.carried() * step.free.x;
  const double most_away = laws_.holding(step.place, step.age, side) * total;  // friction, by direction
  const double least_wall = std::max(0.0, push - most_away);
  const double most_wall = push + laws_.holding(step.place, step.age, -side) * total;
  if (!(total >= 0) || most_wall < least_wall) return false;
  const double near_arm = side > 0 ? body_.right_m : body_.left_m, far_arm = side > 0 ? body_.left_m : body_.right_m;
  const double over = h * push + side * step.free.q * body_.gyration2_m2;  // towards the wall, without the wall
  if (body_.can_tip && (over < -far_arm * total || over - 2 * h * most_wall > near_arm * total)) return false;
  c.next = {0, 0, 0};
  c.slip = 0;
  c.tangential = side * (least_wall - push);
  c.wall[2 * (side > 0 ? right : left)] = least_wall;
  c.normal = {0.5 * total, 0.5 * total};
  return true;
}

// lift = lift_free + nn N + nt T; slip = slip_free + tn N + tt T.
bool MoreauStepper::one_corner(const Step& step, Corner k, Grip grip, Case& c) const {
  const Arm &f = step.push[k], &r = step.stop[k];
  const double k2 = body_.gyration2_m2, M = laws_.carried();
  const double nn = 1 + r.x * f.x / k2, nt = -r.x * f.y / k2, tn = -r.y * f.x / k2, tt = 1 / M + r.y * f.y / k2;
  const double lift = step.free.y - step.free.q * r.x, slip = step.free.x + step.free.q * r.y;
  double& N = c.normal[k];
  if (grip == Grip::stuck && laws_.legs_radps > 0) {
    c.tangential = step.dt * step.leg_force;
    N = -(lift + nt * c.tangential) / nn;
  } else if (grip == Grip::stuck) {
    const double det = nn * tt - nt * tn;
    if (det == 0) return false;
    N = (-lift * tt + slip * nt) / det;
    c.tangential = (-slip * nn + lift * tn) / det;
  } else {
    const int sigma = direction(grip);
    ContactLaws::Place place = step.place;
    double mu = laws_.sliding(place, step.speed, sigma);
    // Too much (> 0) or too little lift for a normal impulse whose friction mu is.
    const auto missed = [&](double normal) { return lift + (nn - sigma * mu * nt) * normal; };
    if (laws_.pressure_exponent == 0 || step.blow) {
      if (nn - sigma * mu * nt == 0) return false;
      N = -lift / (nn - sigma * mu * nt);
    } else {
      // Friction depends on the normal force, which depends on friction.
      const auto missed_with_its_own = [&](double normal) {
        place.normal_g = normal / (step.dt * standard_gravity_mps2);
        mu = laws_.sliding(place, step.speed, sigma);
        return missed(normal);
      };
      double low = 0, high = -lift / nn;
      // Close to where it leaves the floor friction alone presses the corner, by as much as it grows there.
      for (int wider = 0; wider < 200 && lift < 0 && missed_with_its_own(high) < 0; ++wider) high *= 1.25;
      if (lift < 0 && missed_with_its_own(high) < 0) return false;  // Painleve's paradox
      for (int half = 0; half < 60 && lift < 0; ++half) {
        const double middle = 0.5 * (low + high);
        (missed_with_its_own(middle) < 0 ? low : high) = middle;
      }
      N = high;
      missed_with_its_own(std::max(N, 0.0));
    }
    c.tangential = -sigma * mu * N;
  }
  c.next.x = step.free.x + c.tangential / M;
  c.next.y = step.free.y + N;
  c.next.q = step.free.q + (f.y * c.tangential - f.x * N) / k2;
  c.slip = grip == Grip::stuck ? 0 : c.next.x + c.next.q * r.y;
  return true;
}

// One corner or none, and one edge or more: each impulse is one unknown, each contact's velocity one equation.
bool MoreauStepper::with_edges(const Step& step, Contacts contacts, Grip grip, Case& c) const {
  struct Impulse {
    Velocity per_unit;
    double* value;
  };
  const double k2 = body_.gyration2_m2, M = laws_.carried();
  const Corner k = contacts.left ? left : right;
  const Arm &f = step.push[k], &r = step.stop[k];
  const int sigma = direction(grip);
  const double mu = sigma == 0 ? 0 : laws_.sliding(step.place, step.speed, sigma);
  Impulse impulse[4];
  double a[4][5] = {}, aim[4] = {};
  Velocity row[4];  // contact's velocity = row . v
  int n = 0;
  if (!contacts.none()) {
    const double along = -sigma * mu;  // friction of a slip comes with the normal impulse
    impulse[n] = {{along / M, 1, (f.y * along - f.x) / k2}, &c.normal[k]};
    row[n++] = {0, 1, -r.x};
    if (grip == Grip::stuck) {
      impulse[n] = {{1 / M, 0, f.y / k2}, &c.tangential};
      row[n++] = {1, 0, r.y};
    }
  }
  for (int edge = 0; edge < edge_count; ++edge) {
    if (!holds(contacts.edges, edge)) continue;
    if (n == 4) return false;
    const double s = side_of(edge);
    impulse[n] = {{-s / M, 0, -s * step.wall_push[edge].y / k2}, &c.wall[edge]};
    aim[n] = edge == step.struck ? -step.rebound : 0;
    row[n++] = {s, 0, s * step.wall_stop[edge].y};
  }
  if (n > 3) return false;  // three velocities
  const auto speed = [](const Velocity& along, const Velocity& v) {
    return along.x * v.x + along.y * v.y + along.q * v.q;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) a[i][j] = speed(row[i], impulse[j].per_unit);
    a[i][4] = aim[i] - speed(row[i], step.free);
  }
  if (!solve(a, n)) return false;
  c.next = step.free;
  for (int i = 0; i < n; ++i) {
    *impulse[i].value = a[i][4];
    c.next.x += a[i][4] * impulse[i].per_unit.x;
    c.next.y += a[i][4] * impulse[i].per_unit.y;
    c.next.q += a[i][4] * impulse[i].per_unit.q;
  }
  if (sigma != 0) c.tangential = -sigma * mu * c.normal[k];
  c.slip = sigma == 0 ? 0 : c.next.x + c.next.q * r.y;
  return true;
}

// Deflection of the legs of a slipping foot under the force of this step, and the speed of the foot in its middle and at its
// end: y tends to -f_x/W^2 at the rate W/(2 z).
void MoreauStepper::sway(const Step& step, const State& state, Grip grip, Case& c) const {
  const double W = laws_.legs_radps, z = laws_.legs_damping;
  if (W == 0 || step.blow) return;
  if (grip == Grip::stuck) {
    c.slip = 0;
    return;
  }
  const double rest = -c.tangential / (step.dt * W * W), left_over = z > 0 ? std::exp(-0.25 * W / z * step.dt) : 0.0;
  const auto slip_of_legs = [&](double legs) {
    return z > 0 ? -0.5 * W / z * (legs - rest) : (legs - state.legs) / step.dt;
  };
  const double legs_in_the_middle = rest + (state.legs - rest) * left_over;
  c.legs = rest + (legs_in_the_middle - rest) * left_over;
  c.middle_slip = 0.5 * (step.corner + c.slip) - slip_of_legs(legs_in_the_middle);
  c.slip -= slip_of_legs(c.legs);
}

bool MoreauStepper::impulses_at(const Step& step, const State& state, Contacts contacts, Grip grip, Case& c) const {
  c = {};
  if (contacts.flat() && contacts.edges != 0) return against_face(step, contacts.edges == face(1) ? 1 : -1, c);
  if (contacts.edges != 0) return with_edges(step, contacts, grip, c);
  if (contacts.none()) {
    c.next = step.free;
    return true;
  }
  if (contacts.flat())
    both_corners(step, grip, c);
  else if (!one_corner(step, contacts.left ? left : right, grip, c))
    return false;
  sway(step, state, grip, c);
  return true;
}

// A foot under legs has no mass: its friction sets its speed, which its friction follows. Told from the last steps, the speed
// would swing from step to step however short they are.
bool MoreauStepper::impulses(const Step& step, const State& state, Contacts contacts, Grip grip, Case& c) const {
  const int sigma = direction(grip);
  if (laws_.legs_radps == 0 || laws_.rates.empty() || sigma == 0 || step.blow)
    return impulses_at(step, state, contacts, grip, c);
  Step at = step;
  const auto missed = [&](double speed) {
    at.speed = speed;
    return impulses_at(at, state, contacts, grip, c) ? std::max(0.0, sigma * c.middle_slip) - speed : 0.0;
  };
  double slow = 0, fast = std::max(missed(0), 1e-12);
  for (int wider = 0; wider < 60 && missed(fast) > 0; ++wider) fast *= 2;
  for (int half = 0; half < 60; ++half) {
    const double middle = 0.5 * (slow + fast);
    (missed(middle) > 0 ? slow : fast) = middle;
  }
  at.speed = 0.5 * (slow + fast);
  return impulses_at(at, state, contacts, grip, c);
}

// Without slip a block that stands on one corner turns about a hinge, which may pull.
bool MoreauStepper::hinged(const Step& step) const {
  return !body_.can_slip && !step.blow && step.near[left] != step.near[right];
}

// Whether these contacts and this grip are to be tried at all.
bool MoreauStepper::possible(const Step& step, const State& state, Contacts contacts, Grip grip) const {
  if ((contacts.left && !step.near[left]) || (contacts.right && !step.near[right])) return false;
  if (step.struck >= 0 && !holds(contacts.edges, step.struck)) return false;
  if (!body_.can_tip && contacts.edges != 0 && contacts.edges != face(1) && contacts.edges != face(-1)) return false;
  if (contacts.none()) return grip == Grip::none && !hinged(step);
  if (grip == Grip::none || (!body_.can_slip && grip != Grip::stuck)) return false;
  if (!body_.can_tip && !contacts.flat()) return false;
  if (contacts.flat() && contacts.edges != 0)
    return grip == Grip::stuck && state.theta == 0 && (contacts.edges == face(1) || contacts.edges == face(-1));
  return true;
}

bool MoreauStepper::allowed(const Step& step, const State& state, Contacts contacts, Grip grip, const Case& c) const {
  constexpr double round_off = 1e-14;
  const std::array<bool, 2> with{contacts.left, contacts.right};
  const bool pulls = hinged(step);
  if (c.total() < 0 && !pulls) return false;
  for (const Corner k : {left, right}) {
    if (body_.can_tip && with[k] && c.normal[k] < 0 && !pulls) return false;
    if (!with[k] && step.near[k] && c.next.y - c.next.q * step.stop[k].x < -round_off) return false;
  }
  for (int edge = 0; edge < edge_count; ++edge) {
    if (!holds(step.touching, edge)) continue;
    if (holds(contacts.edges, edge) && c.wall[edge] < 0) return false;
    const double into = side_of(edge) * (c.next.x + c.next.q * step.wall_stop[edge].y);
    if (!holds(contacts.edges, edge) && into > round_off) return false;
  }
  if (contacts.none() || (contacts.flat() && contacts.edges != 0)) return true;
  // A foot on legs slips on until it stands still; then it sticks, whatever the legs ask of it next.
  if (grip == Grip::stuck && laws_.legs_radps > 0 && direction(state.grip) != 0) return true;
  if (grip == Grip::stuck) return !body_.can_slip || std::abs(c.tangential) <= holding(step, c) * c.total();
  const int sigma = direction(grip);
  // A foot that begins to slip under legs goes where they push it.
  if (laws_.legs_radps > 0 && state.grip == Grip::stuck) return sigma * step.leg_force <= 0;
  return sigma * c.slip > 0;
}

// A blow comes from a corner that closes: the other one alone would stop its slip by a blow of its own making.
bool MoreauStepper::meets_floor(const Step& step, const State& state, Contacts contacts) const {
  return (contacts.left && step.near[left] && !state.closed[left]) ||
         (contacts.right && step.near[right] && !state.closed[right]);
}

bool MoreauStepper::choose(const Step& step, State& state, Case& chosen, bool closing, Refused& refused) const {
  std::array<Grip, 4> order{Grip::none, Grip::stuck, Grip::to_right, Grip::to_left};
  if (!closing && state.grip == Grip::stuck) order = {Grip::stuck, Grip::none, Grip::to_right, Grip::to_left};
  if (!closing && state.grip == Grip::to_right) order = {Grip::to_right, Grip::none, Grip::stuck, Grip::to_left};
  if (!closing && state.grip == Grip::to_left) order = {Grip::to_left, Grip::none, Grip::stuck, Grip::to_right};
  static constexpr std::array<std::array<bool, 2>, 4> sets{
      {{false, false}, {true, true}, {true, false}, {false, true}}};
  for (const Grip grip : order)
    for (const auto& [with_left, with_right] : sets)
      for (unsigned edges = 0; edges <= step.touching; ++edges) {
        if ((edges & ~step.touching) != 0) continue;
        const Contacts contacts{with_left, with_right, edges};
        if (closing && step.struck < 0 && !contacts.none() && !meets_floor(step, state, contacts)) continue;
        if (!possible(step, state, contacts, grip) || !impulses(step, state, contacts, grip, chosen)) continue;
        if (allowed(step, state, contacts, grip, chosen)) {
          state.closed = {with_left, with_right};
          state.touching = edges;
          state.grip = grip;
          return true;
        }
        if (grip == state.grip && state.closed == std::array<bool, 2>{with_left, with_right} && edges == 0) {
          refused.slip = chosen.slip;
          refused.first_slip = chosen.first_slip();
          if (grip == Grip::stuck) refused.margin = margin(step, chosen);
        }
      }
  return false;
}

double MoreauStepper::margin(const Step& step, const Case& c) const {
  return (holding(step, c) * c.total() - std::abs(c.tangential)) / step.dt;
}

}  // namespace freestand::test
