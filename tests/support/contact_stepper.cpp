#include "support/contact_stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/units.hpp"

namespace freestand::test {
namespace {

enum Corner { left = 0, right = 1 };
enum class Grip { none, stuck, to_right, to_left };  // friction state of the closed corners; none: nothing closed

struct Velocity {
  double x = 0, y = 0, q = 0;
};
struct Pose {
  double x = 0, y = 0, theta = 0;
};
struct Arm {  // from the centre of mass to a corner
  double x = 0, y = 0;
};

struct Turn {  // clockwise by theta
  double c = 1, s = 0;
  Arm operator()(double x, double y) const { return {x * c + y * s, -x * s + y * c}; }
};
Turn turn(double theta) { return theta == 0 ? Turn{} : Turn{std::cos(theta), std::sin(theta)}; }

double slip_speed(const Velocity& v, const Arm& r) { return v.x + v.q * r.y; }
double lift_speed(const Velocity& v, const Arm& r) { return v.y - v.q * r.x; }

// Impulses per unit mass: tangential sum and the two normal ones.
struct Impulse {
  double tangential = 0;
  std::array<double, 2> normal{0, 0};
};

struct Contacts {
  double gyration2 = 1;
  std::array<Arm, 2> push;                 // arms of the impulses
  std::array<Arm, 2> stop;                 // arms of the velocities that must not point into the floor
  std::array<bool, 2> near{false, false};  // closed, or closing in this step
};

// One tangential impulse t at height arm push.y of the closed corner (both corners closed: the base is flat, same
// height).
Velocity kicked(const Contacts& c, Velocity v, const Impulse& p) {
  const double level = c.push[p.normal[right] > p.normal[left] ? right : left].y;
  v.x += p.tangential;
  v.y += p.normal[left] + p.normal[right];
  v.q += (level * p.tangential - c.push[left].x * p.normal[left] - c.push[right].x * p.normal[right]) / c.gyration2;
  return v;
}

// grip: stuck, or the slip with p_t = -sigma mu p_n. Returns whether the equations had a solution.
bool solve_one(const Contacts& c, const Velocity& v, Corner k, Grip grip, double mu, Impulse& p) {
  const Arm &f = c.push[k], &r = c.stop[k];
  // lift = lift_free + nn N + nt T; slip = slip_free + tn N + tt T
  const double nn = 1 + r.x * f.x / c.gyration2, nt = -r.x * f.y / c.gyration2;
  const double tn = -r.y * f.x / c.gyration2, tt = 1 + r.y * f.y / c.gyration2;
  const double lift = lift_speed(v, r), slip = slip_speed(v, r);
  p = {};
  if (grip == Grip::stuck) {
    const double det = nn * tt - nt * tn;
    if (det == 0) return false;
    p.normal[k] = (-lift * tt + slip * nt) / det;
    p.tangential = (-slip * nn + lift * tn) / det;
    return true;
  }
  const double ratio = grip == Grip::to_right ? -mu : mu;
  const double w = nn + nt * ratio;
  if (w == 0) return false;
  p.normal[k] = -lift / w;
  p.tangential = ratio * p.normal[k];
  return true;
}

// Both corners closed: the base is flat, lift speeds zero means Y' = 0 and theta' = 0.
bool solve_both(const Contacts& c, const Velocity& v, double height, Grip grip, double mu, Impulse& p) {
  const double total = -v.y;
  double t = -v.x;
  if (grip != Grip::stuck) t = (grip == Grip::to_right ? -mu : mu) * total;
  const double moment = -v.q * c.gyration2 + height * t;  // of the normal impulses, clockwise: b_l N_l - b_r N_r
  const double bl = -c.stop[left].x, br = c.stop[right].x;
  p.tangential = t;
  p.normal[left] = (moment + br * total) / (bl + br);
  p.normal[right] = total - p.normal[left];
  return true;
}

// The block, its state, and one step.
class Stepper {
 public:
  explicit Stepper(const Specimen& specimen)
      : block_(specimen.block), friction_(specimen.friction), pose_{0, specimen.block.height_m, 0} {}

  // One step. False: no case is consistent.
  bool step(const FloorAt& floor, double t, double dt);

  double slip() const {
    const double middle = 0.5 * (block_.right_m - block_.left_m);
    return pose_.x + turn_(middle, -block_.height_m).x - middle;
  }
  const Pose& pose() const { return pose_; }
  const Velocity& velocity() const { return velocity_; }
  bool closed(Corner k) const { return closed_[k]; }
  bool slips() const { return grip_ == Grip::to_left || grip_ == Grip::to_right; }
  bool flies() const { return grip_ == Grip::none; }
  double contact_speed() const { return contact_speed_; }
  double closing_speed() const { return closing_speed_; }  // of the corner that closed in the last step, 0: none

 private:
  Arm arm(Corner k, const Turn& turned) const {
    return turned(k == left ? -block_.left_m : block_.right_m, -block_.height_m);
  }
  double gap(Corner k) const { return pose_.y + arm(k, turn_).y; }
  Velocity freely(const FloorAcceleration& a, double dt) const {  // what the velocity becomes without contact
    return {velocity_.x - dt * a.horizontal_mps2, velocity_.y - dt * (standard_gravity_mps2 + a.vertical_mps2),
            velocity_.q};
  }
  Contacts contacts(const Velocity& free, double dt) const;
  bool closes(const Contacts& c, Corner k) const {
    return c.near[k] && !closed_[k] && lift_speed(velocity_, c.stop[k]) < 0;
  }
  bool attempt(const Contacts& c, const Velocity& free, bool with_left, bool with_right, Grip grip);
  bool choose(const Contacts& c, const Velocity& free, bool closing);
  bool advance(const Contacts& c, const Velocity& free, double dt, bool closing);
  bool loses_grip(const FloorAcceleration& a) const;
  double advance_until(const FloorAt& floor, double t, double dt,
                       const std::function<bool(const Stepper&, double)>& too_far);
  void collide(const std::array<bool, 2>& closing);
  void put_back(const std::array<double, 2>& corner_x);

  Block block_;
  Friction friction_;
  Pose pose_;
  Turn turn_;  // by pose_.theta
  Velocity velocity_;
  std::array<bool, 2> closed_{true, true};
  Grip grip_ = Grip::stuck;
  double contact_speed_ = 0, closing_speed_ = 0;
};

bool Stepper::attempt(const Contacts& c, const Velocity& free, bool with_left, bool with_right, Grip grip) {
  const std::array<bool, 2> with{with_left, with_right};
  for (Corner k : {left, right})
    if (with[k] && !c.near[k]) return false;
  Impulse p;
  Velocity next = free;
  if (with_left && with_right) {
    if (!solve_both(c, free, block_.height_m, grip, friction_.mu_k, p)) return false;
    next = {free.x + p.tangential, 0, 0};
    if (grip == Grip::stuck) next.x = 0;
  } else {
    const Corner k = with_left ? left : right;
    if (!solve_one(c, free, k, grip, friction_.mu_k, p)) return false;
    next = kicked(c, free, p);
  }
  constexpr double round_off = 1e-14;
  for (Corner k : {left, right}) {
    if (with[k] && p.normal[k] < 0) return false;
    if (!with[k] && c.near[k] && lift_speed(next, c.stop[k]) < -round_off) return false;
  }
  const Corner k = with_left ? left : right;
  const double slip = with_left && with_right ? next.x : slip_speed(next, c.stop[k]);
  const double bound = friction_.mu_s * (p.normal[left] + p.normal[right]);
  if (grip == Grip::stuck && std::abs(p.tangential) > bound) return false;
  if (grip == Grip::to_right && !(slip > 0)) return false;
  if (grip == Grip::to_left && !(slip < 0)) return false;
  velocity_ = next;
  closed_ = with;
  grip_ = grip;
  contact_speed_ = grip == Grip::stuck ? 0 : slip;
  return true;
}

bool Stepper::choose(const Contacts& c, const Velocity& free, bool closing) {
  bool lifts = true;
  for (Corner k : {left, right}) lifts = lifts && (!c.near[k] || lift_speed(free, c.stop[k]) >= 0);
  if (lifts) {
    velocity_ = free;
    closed_ = {false, false};
    grip_ = Grip::none;
    contact_speed_ = 0;
    return true;
  }
  std::array<Grip, 3> order{Grip::stuck, Grip::to_right, Grip::to_left};
  if (!closing && grip_ == Grip::to_right) order = {Grip::to_right, Grip::stuck, Grip::to_left};
  if (!closing && grip_ == Grip::to_left) order = {Grip::to_left, Grip::stuck, Grip::to_right};
  for (const Grip grip : order)
    if (attempt(c, free, true, true, grip) || attempt(c, free, true, false, grip) ||
        attempt(c, free, false, true, grip))
      return true;
  return false;
}

void Stepper::put_back(const std::array<double, 2>& corner_x) {
  if (closed_[left] && closed_[right]) pose_.theta = 0;
  turn_ = turn(pose_.theta);
  if (!closed_[left] && !closed_[right]) return;
  const Corner k = closed_[left] ? left : right;
  const Arm r = arm(k, turn_);
  pose_.y = -r.y;
  if (grip_ == Grip::stuck) pose_.x = corner_x[k] - r.x;
}

Contacts Stepper::contacts(const Velocity& free, double dt) const {
  Contacts c;
  c.gyration2 = block_.gyration2_m2;
  const Turn middle = turn(pose_.theta + 0.5 * dt * velocity_.q), end = turn(pose_.theta + dt * velocity_.q);
  for (Corner k : {left, right}) {
    c.push[k] = arm(k, middle);
    c.stop[k] = arm(k, end);
    c.near[k] = closed_[k] || pose_.y + dt * free.y + c.stop[k].y <= 0;
  }
  return c;
}

bool Stepper::advance(const Contacts& c, const Velocity& free, double dt, bool closing) {
  std::array<double, 2> corner_x{};
  for (Corner k : {left, right}) {
    corner_x[k] = pose_.x + arm(k, turn_).x;
    if (closes(c, k)) corner_x[k] += 0.5 * dt * slip_speed(velocity_, c.stop[k]);
  }
  const Velocity before = velocity_;
  if (!choose(c, free, closing)) return false;
  pose_.x += 0.5 * dt * (before.x + velocity_.x);
  pose_.y += 0.5 * dt * (before.y + velocity_.y);
  pose_.theta += 0.5 * dt * (before.q + velocity_.q);
  put_back(corner_x);
  return true;
}

// Whether a stuck contact needs more than mu_s at this instant.
bool Stepper::loses_grip(const FloorAcceleration& a) const {
  constexpr double instant = 1e-9;
  Stepper probe = *this;
  const Velocity free = freely(a, instant);
  Contacts c = contacts(free, instant);
  c.near = closed_;
  return probe.advance(c, free, instant, false) && probe.slips();
}

// Follows the motion, corners that close left out, as long as `too_far` (state, time gone) does not hold, at most dt.
// Returns the time gone.
double Stepper::advance_until(const FloorAt& floor, double t, double dt,
                              const std::function<bool(const Stepper&, double)>& too_far) {
  const Stepper start = *this;
  double low = 0, high = dt;
  for (int i = 0; i < 40; ++i) {
    const double part = 0.5 * (low + high);
    Stepper trial = start;
    const Velocity free = start.freely(floor(t + 0.5 * part), part);
    Contacts c = start.contacts(free, part);
    c.near = start.closed_;
    if (!trial.advance(c, free, part, false) || too_far(trial, part)) {
      high = part;
      continue;
    }
    low = part;
    *this = trial;
  }
  return low;
}

// A step in which a corner meets the floor is cut at that instant: up to it without the corner, then an impact of no
// duration, then the rest. So is one in which slip begins, stops or reverses. After a few cuts (rattling) the rest is
// done in one go, the corner closing in it.
bool Stepper::step(const FloorAt& floor, double t, double dt) {
  closing_speed_ = 0;
  const bool falls = friction_.mu_s > friction_.mu_k;
  for (int cut = 0; cut < 4 && dt > 1e-12; ++cut) {
    const Velocity free = freely(floor(t + 0.5 * dt), dt);
    const Contacts c = contacts(free, dt);
    const std::array<bool, 2> closing{closes(c, left), closes(c, right)};
    double gone = 0;
    if (closing[left] || closing[right]) {
      for (Corner k : {left, right})
        if (closing[k]) closing_speed_ = std::max(closing_speed_, -lift_speed(velocity_, c.stop[k]));
      gone = advance_until(floor, t, dt, [&](const Stepper& trial, double) {
        return (closing[left] && trial.gap(left) < 0) || (closing[right] && trial.gap(right) < 0);
      });
      collide(closing);
    } else {
      Stepper start = *this;
      if (!advance(c, free, dt, false)) return false;
      const Grip grip = start.grip_;
      const bool breaks = falls && grip == Grip::stuck && grip_ == Grip::stuck && loses_grip(floor(t + dt));
      if (grip == Grip::none || grip_ == Grip::none || (grip_ == grip && !breaks)) return true;
      gone = start.advance_until(floor, t, dt, [&](const Stepper& trial, double part) {
        return trial.grip_ != grip || (falls && grip == Grip::stuck && trial.loses_grip(floor(t + part)));
      });
      if (gone < 1e-12) return true;
      *this = start;
    }
    t += gone;
    dt -= gone;
  }
  if (dt <= 1e-12) return true;
  const Velocity free = freely(floor(t + 0.5 * dt), dt);
  const Contacts c = contacts(free, dt);
  return advance(c, free, dt, closes(c, left) || closes(c, right));
}

// Impact of the corners that are about to close; nothing moves in it.
void Stepper::collide(const std::array<bool, 2>& closing) {
  Contacts c = contacts(velocity_, 0);
  c.push = c.stop;
  std::array<double, 2> corner_x{};
  bool any = false;
  for (Corner k : {left, right}) {
    corner_x[k] = pose_.x + c.stop[k].x;
    const bool meets = closing[k] && !closed_[k] && gap(k) < 1e-12 && lift_speed(velocity_, c.stop[k]) < 0;
    c.near[k] = closed_[k] || meets;
    any = any || meets;
  }
  if (any && choose(c, velocity_, true)) put_back(corner_x);
}

}  // namespace

StepperResult step_contacts(const Specimen& specimen, const FloorAt& floor, const StepperSettings& settings) {
  Stepper stepper(specimen);
  StepperResult result;
  const auto steps = static_cast<long>(std::llround(settings.end_time_s / settings.step_s));
  const auto stride = std::max(1L, std::lround(settings.output_step_s / settings.step_s));
  for (long i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) * settings.step_s, theta = stepper.pose().theta;
    if (i % stride == 0)
      result.points.push_back({t, stepper.slip(), theta, stepper.velocity().q, stepper.contact_speed(),
                               stepper.closed(left), stepper.closed(right)});
    result.peak_slip_m = std::max(result.peak_slip_m, std::abs(stepper.slip()));
    result.peak_rotation_rad = std::max(result.peak_rotation_rad, std::abs(theta));
    result.overturned = std::abs(theta) > 0.5 * pi;
    if (result.overturned || i == steps) break;
    if (!stepper.step(floor, t, settings.step_s)) {
      result.inconsistent = true;
      break;
    }
    const bool slips = stepper.slips();
    result.slid_path_m += std::abs(stepper.contact_speed()) * settings.step_s;
    result.flew = result.flew || stepper.flies();
    result.slide_rocked = result.slide_rocked || (slips && stepper.closed(left) != stepper.closed(right));
    result.impacts += stepper.closing_speed() > 1e-3 ? 1 : 0;
    result.slipping_impact = result.slipping_impact || (slips && stepper.closing_speed() > 1e-2);
  }
  result.residual_slip_m = stepper.slip();
  result.residual_rotation_rad = stepper.pose().theta;
  return result;
}

FloorAt floor_of(const Shaking& shaking) {
  const FloorMotion* motion = shaking.motion;
  return [shaking, motion, segment = std::size_t{0}](double t) mutable -> FloorAcceleration {
    const double x = t / shaking.stretch;
    while (segment < motion->segments() && x >= motion->knot_s[segment + 1]) ++segment;
    while (segment > 0 && x < motion->knot_s[segment]) --segment;
    if (segment >= motion->segments()) return {};
    const auto width = static_cast<std::size_t>(motion->degree) + 1;
    const double tau = x - motion->knot_s[segment];
    FloorAcceleration a;
    double power = 1;
    for (std::size_t k = 0; k < width; ++k, power *= tau) {
      a.horizontal_mps2 += power * motion->horizontal_mps2[segment * width + k];
      if (!motion->vertical_mps2.empty()) a.vertical_mps2 += power * motion->vertical_mps2[segment * width + k];
    }
    a.horizontal_mps2 *= shaking.scale;
    a.vertical_mps2 *= shaking.vertical_scale;
    return a;
  };
}

}  // namespace freestand::test
