#include "dynamics/side_by_side.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/floor_cursor.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/output_times.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = max_floor_degree + 2;  // of the displacement
using Polynomial = Series<double, N>;

// Positions and speeds count towards the neighbour's side.
struct Slider {
  double mass, mu_s, mu_k;
  double u = 0, w = 0;
  int sigma = 0;  // direction of slip; 0: stuck

  double braked() const { return sigma * mu_k; }  // over g
};

// Speed and place over a step.
struct Path {
  Polynomial w, u;
};

enum class Happening { knot, stop, onset, blow };

class SideBySide {
 public:
  SideBySide(const Setup& setup, const Settings& settings, History* history)
      : shaking_(setup.shaking),
        settings_(settings),
        side_(setup.specimen.neighbour->side),
        g_(standard_gravity_mps2 * setup.floor.gravity_factor),
        push_(side_ * setup.floor.push_mps2),
        force_zero_(1e-11 * g_),
        restitution_(setup.specimen.neighbour->restitution),
        least_speed_(0.1 * settings.tolerance * setup.specimen.block.size_m() * setup.specimen.block.p_radps()),
        block_{setup.specimen.block.mass_kg, setup.specimen.friction.mu_s, setup.specimen.friction.mu_k},
        other_{setup.specimen.neighbour->mass_kg, setup.specimen.neighbour->friction.mu_s,
               setup.specimen.neighbour->friction.mu_k},
        gap_(setup.specimen.neighbour->gap_m),
        cursor_(shaking_, g_, setup.floor.push_mps2),
        history_(history),
        times_(history) {
    if (settings_.slip_by_side) response_.peak_slip_right_m = response_.peak_slip_left_m = 0;
    if (!history_) return;
    history_->points.clear();
    history_->events.clear();
  }

  Response run() {
    read_floor();
    choose();
    while (!finished_) {
      pass_over_quiet();
      step();
      read_floor();
      stop_when_done();
    }
    return result();
  }

 private:
  double end_s() const { return shaking_.duration_s() + settings_.free_vibration_s; }
  bool at_rest() const { return block_.sigma == 0 && other_.sigma == 0; }

  void read_floor() {
    a_ = scaled(static_cast<double>(side_), cursor_.local<N>().a);
    left_ = cursor_.motion_over() ? std::fmax(end_s() - cursor_.time(), 0.0) : cursor_.left();
  }
  void advance(double tau) {
    if (tau < left_ || cursor_.motion_over())
      cursor_.advance(tau);
    else
      cursor_.next_segment();
  }
  void pass_over_quiet() {
    if (!at_rest() || history_) return;
    const double holds = g_ * std::fmin(block_.mu_s, other_.mu_s), peak = response_.peak_acceleration_mps2;
    if (cursor_.pass_over([&](const FloorCursor::Bound& floor) { return floor.a < holds && floor.shaken <= peak; }))
      read_floor();
  }

  // Which way they go.

  // What is left of a limit on the floor's acceleration: towards the neighbour (+1), which leaves blocks behind on the other side,
  // or away from it (-1).
  Polynomial margin(int way, double limit) const {
    Polynomial left = scaled(-static_cast<double>(way), a_);
    left[0] += limit;
    return left;
  }
  bool holds(int way, double limit) const { return sign_after(margin(way, limit), ZeroTolerance{0, force_zero_}) >= 0; }

  // Stuck side by side. A floor that accelerates towards the neighbour lets it press on the block, and the block may go by itself.
  double joint_grip(int way) const {
    const Slider &pushed = way > 0 ? block_ : other_, &pushes = way > 0 ? other_ : block_;
    return g_ * (pushed.mu_s <= pushes.mu_s ? pushed.mu_s : joint(block_.mu_s, other_.mu_s));
  }
  double joint(double of_block, double of_other) const {
    return (block_.mass * of_block + other_.mass * of_other) / (block_.mass + other_.mass);
  }

  // Of one by itself.
  int direction(const Slider& slider) const {
    if (slider.w != 0) return slider.w > 0 ? 1 : -1;
    for (const int way : {1, -1})
      if (!holds(way, g_ * slider.mu_s)) return -way;
    return 0;
  }
  // Its acceleration by itself.
  Polynomial pull(const Slider& slider) const {
    if (slider.sigma == 0) return Polynomial::zero();
    Polynomial pull = scaled(-1.0, a_);
    pull[0] -= slider.braked() * g_;
    return pull;
  }
  bool press() const {
    return sign_after(combination(1.0, pull(block_), -1.0, pull(other_)), ZeroTolerance{0, force_zero_}) >= 0;
  }

  // From the places and speeds of this instant.
  void choose() {
    const int before = block_.sigma;
    together_ = gap_ == 0 && block_.w == other_.w;
    if (together_ && block_.w == 0 && holds(1, joint_grip(1)) && holds(-1, joint_grip(-1))) {
      block_.sigma = other_.sigma = 0;
    } else {
      block_.sigma = direction(block_);
      other_.sigma = direction(other_);
      together_ = together_ && press();
      if (together_) {
        block_.sigma = other_.sigma = block_.sigma != 0 ? block_.sigma : other_.sigma;
        together_ = press();  // what is pushed off may run ahead: kinetic friction brakes it less
      }
    }
    if (block_.sigma != before) tell(before, false);
    moved_ = moved_ || block_.sigma != 0;
  }

  void tell(int before, bool blow) {
    ++response_.events;
    const auto mode = [](int sigma) { return sigma == 0 ? Mode::rest : Mode::slide; };
    if (history_) history_->events.push_back({cursor_.time(), mode(before), mode(block_.sigma), 0, blow});
  }

  // A step: to the next knot, or to the first event before it.

  Path path_of(const Slider& slider) const {
    Path path{Polynomial::zero(), Polynomial::zero()};
    path.w[0] = slider.w;
    path.u[0] = slider.u;
    if (slider.sigma == 0) return path;
    const double braked = together_ ? joint(block_.braked(), other_.braked()) : slider.braked();
    for (int k = 0; k < N; ++k) path.w[k + 1] = -(a_[k] + (k == 0 ? braked * g_ : 0.0)) / (k + 1);
    for (int k = 0; k < N; ++k) path.u[k + 1] = path.w[k] / (k + 1);
    return path;
  }

  void step() {
    const Path block = path_of(block_), other = path_of(other_);
    double tau = left_, found = 0;
    Happening happening = Happening::knot;
    const Slider* stops = nullptr;
    const auto look = [&](const Polynomial& witness, ZeroTolerance zero, Happening what, const Slider* whose) {
      if (!first_root(witness, tau, zero, found) || (happening != Happening::knot && found >= tau)) return;
      tau = found;
      happening = what;
      stops = whose;
    };
    const auto look_at = [&](const Slider& slider, const Path& path, double grip, double grip_away) {
      if (slider.sigma != 0)
        return look(scaled(static_cast<double>(slider.sigma), path.w), {1, force_zero_}, Happening::stop, &slider);
      look(margin(1, grip), {0, force_zero_}, Happening::onset, nullptr);
      look(margin(-1, grip_away), {0, force_zero_}, Happening::onset, nullptr);
    };
    if (together_) {
      look_at(block_, block, joint_grip(1), joint_grip(-1));
    } else {
      look_at(block_, block, g_ * block_.mu_s, g_ * block_.mu_s);
      look_at(other_, other, g_ * other_.mu_s, g_ * other_.mu_s);
      Polynomial gap = combination(1.0, other.u, -1.0, block.u);
      gap[0] = gap_;
      look(gap, {2, force_zero_}, Happening::blow, nullptr);
      gap_ = happening == Happening::blow ? 0.0 : std::fmax(gap.at(tau), 0.0);
    }
    go(block, other, tau);
    read_floor();
    if (happening != Happening::knot) happen(happening, stops);
  }

  void go(const Path& block, const Path& other, double tau) {
    observe(block, tau);
    write(block, tau);
    block_.u = block.u.at(tau);
    block_.w = block.w.at(tau);
    other_.u = other.u.at(tau);
    other_.w = other.w.at(tau);
    advance(tau);
  }

  void happen(Happening happening, const Slider* stops) {
    if (stops && (together_ || stops == &block_)) block_.w = 0;
    if (stops && (together_ || stops == &other_)) other_.w = 0;
    if (happening == Happening::blow) strike();
    choose();
    if (++happened_ >= settings_.event_limit) stop(Outcome::step_limit);
  }

  void strike() {
    const double speed = block_.w - other_.w, common = joint(block_.w, other_.w);
    const double all = block_.mass + other_.mass, parts = restitution_ * speed;
    if (speed > least_speed_) {
      ++response_.wall_hits;
      response_.wall_speed_mps = std::fmax(response_.wall_speed_mps, speed);
      tell(block_.sigma, true);
      moved_ = true;
    }
    const bool part = parts > least_speed_;
    block_.w = part ? common - other_.mass / all * parts : common;
    other_.w = part ? common + block_.mass / all * parts : common;
  }

  // What comes of it.

  // Total acceleration but for blows: at rest that of the floor, else of friction and what presses.
  Polynomial acceleration(const Path& path) const {
    Polynomial acceleration = combination(1.0, derivative(path.w), 1.0, a_);
    acceleration[0] -= push_;
    acceleration[N] = 0;
    return acceleration;
  }

  void observe(const Path& path, double tau) {
    response_.peak_acceleration_mps2 = max_abs(acceleration(path), tau, response_.peak_acceleration_mps2);
    if (block_.sigma == 0) return;
    response_.peak_slip_m = max_abs(path.u, tau, response_.peak_slip_m);
    response_.slid_path_m += std::abs(path.u.at(tau) - path.u[0]);
    if (!settings_.slip_by_side) return;
    double& towards = side_ > 0 ? response_.peak_slip_right_m : response_.peak_slip_left_m;
    double& away = side_ > 0 ? response_.peak_slip_left_m : response_.peak_slip_right_m;
    towards = max_of(path.u, tau, towards);
    away = max_of(scaled(-1.0, path.u), tau, away);
  }

  void write(const Path& path, double tau) {
    times_.within(cursor_.time(), tau, [&](double t) {
      t = std::fmin(t, tau);
      HistoryPoint point{cursor_.time() + t,
                         side_ * (a_.at(t) - push_),
                         side_ * path.u.at(t),
                         side_ * path.w.at(t),
                         0,
                         0,
                         block_.sigma == 0 ? Mode::rest : Mode::slide};
      if (history_->forces) {
        // Stuck against its neighbour the block is held by its own friction, as far as that goes.
        const double most = block_.mu_s * g_;
        const double friction = block_.sigma == 0 ? std::clamp(a_.at(t), -most, most) : -block_.braked() * g_;
        point.acceleration_mps2 = side_ * acceleration(path).at(t);
        point.contact_x_mps2 = side_ * friction;
        point.contact_y_mps2 = g_;
      }
      history_->points.push_back(point);
    });
  }

  void stop(Outcome outcome) {
    outcome_ = outcome;
    finished_ = true;
  }
  void stop_when_done() {
    for (const double value : {block_.u, block_.w, other_.u, other_.w, response_.peak_acceleration_mps2})
      if (!(std::abs(value) < beyond_all_bounds)) return stop(Outcome::not_finite);
    if (finished_ || !cursor_.motion_over()) return;
    if (at_rest() || cursor_.time() >= end_s()) stop(moved_ ? Outcome::moved : Outcome::at_rest);
  }
  Response result() {
    response_.outcome = outcome_;
    response_.residual_slip_m = side_ * block_.u;
    response_.end_time_s = cursor_.time();
    if (history_ && at_rest())
      times_.up_to(shaking_.duration_s(), [&](double t) {
        history_->points.push_back({t, horizontal_acceleration(shaking_, t), side_ * block_.u, 0, 0, 0, Mode::rest});
      });
    return response_;
  }

  const Shaking shaking_;
  const Settings settings_;
  const int side_;
  const double g_, push_, force_zero_, restitution_;
  const double least_speed_;  // of a blow that is told; a slower one ends a row of them
  Slider block_, other_;
  double gap_;
  bool together_ = false;  // they touch, and go or stand as one
  FloorCursor cursor_;
  Polynomial a_ = Polynomial::zero();  // of the floor, gravity along it included
  double left_ = 0;                    // to the next knot, or to the end of the time given [s]
  Response response_;
  History* history_;
  OutputTimes times_;
  Outcome outcome_ = Outcome::moved;
  bool finished_ = false, moved_ = false;
  int happened_ = 0;
};

bool sound(const Neighbour& neighbour) {
  const double mu_s = neighbour.friction.mu_s, mu_k = neighbour.friction.mu_k;
  return neighbour.mass_kg > 0 && std::isfinite(neighbour.mass_kg) && neighbour.gap_m >= 0 && mu_k >= 0 &&
         mu_s >= mu_k && std::isfinite(mu_s) && neighbour.restitution >= 0 && neighbour.restitution <= 1 &&
         std::abs(neighbour.side) == 1;
}

}  // namespace

std::string refusal_beside_neighbour(const Specimen& specimen) {
  if (specimen.model != Model::slide) return "two blocks side by side are followed where they only slide";
  if (!specimen.start.upright_at_rest()) return "beside a neighbour a block begins at rest where it is counted from";
  for (const EffectUse& use : specimen.effects) {
    FloorInput floor;
    if (use.effect->floor) use.effect->floor(floor, use.parameters);
    if (use.effect->dynamic() || floor.vertical_scale != 0)
      return "effect " + use.effect->name + " is of a block that stands alone";
  }
  return "";
}

Response respond_beside_neighbour(const Setup& setup, const Settings& settings, History* history) {
  const Shaking& shaking = setup.shaking;
  const bool shaken = shaking.vertical_scale != 0 && !shaking.motion->vertical_mps2.empty();
  const bool known = setup.specimen.neighbour && sound(*setup.specimen.neighbour) && !shaken &&
                     std::isnan(settings.acceleration_height_m) && !settings.contact_forces;
  if (!known || !refusal_beside_neighbour(setup.specimen).empty() || !admissible(setup, settings))
    return Response{.outcome = Outcome::not_finite};
  return SideBySide(setup, settings, history).run();
}

}  // namespace freestand::dynamics
