// One sample by a Runge-Kutta method of Boost.odeint, piece by piece of its floor (odeint_floor.hpp). Method<D> of D unknowns is made
// with a tolerance and has
//     step(rates, x, dx, begin, next, dnext, h)        one step, or
//     try_step(rates, x, dx, t, next, dnext, h)        one step, if its error is no larger than the tolerance: then t is its end;
//                                                      h becomes how long the next one had better be
//     inside(t, x, dx, begin, next, dnext, end)        what the polynomial of the step says
//     inside_is_exact                                  as exact as its end; otherwise a shorter step goes there
// Each method in its own source file: in one, the compiler inlines neither as well.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <cmath>

#include "illinois.hpp"
#include "odeint_floor.hpp"
#include "peers.hpp"

namespace freestand::bench {
namespace {

template <std::size_t D>
using Values = std::array<double, D>;

template <template <std::size_t> class Method, class Floor>
class OdeintSample {
 public:
  OdeintSample(const Specimen& specimen, const Floor& floor, const OdeintSteps& steps)
      : block_(specimen, 1e-9), floor_(floor), tolerance_(steps.tolerance), root_s_(steps.root_s) {}

  PeerResponse run() {
    if (std::abs(floor_.a(0)) > block_.quiet) block_.choose_flat(y_, floor_.a(0));
    bool alive = true;
    while (alive && !floor_.ended()) {
      switch (y_.mode) {
        case PeerMode::rest:
          if (!wait()) return response_;
          break;
        case PeerMode::slide:
          alive = slide();
          break;
        case PeerMode::rock:
          alive = rock();
          break;
        case PeerMode::slide_rock:
          alive = slide_rock();
          break;
      }
    }
    return response_;
  }

 private:
  // False: it rests for good.
  bool wait() {
    const auto peak = [&](double a) { response_.acceleration_mps2 = std::max(response_.acceleration_mps2, a); };
    if (!floor_.wait(block_.quiet, peak)) return false;
    ++response_.events;
    block_.leave_rest(y_, floor_.a(floor_.offset));
    return true;
  }

  void observe_rotation(double theta) { response_.rotation_rad = std::max(response_.rotation_rad, std::abs(theta)); }
  void observe_slip(const PeerState& y) { response_.slip_m = std::max(response_.slip_m, std::abs(block_.slip(y))); }
  void observe_forces(double fx, double fy) {
    const double lift = fy - PeerBlock::g;
    acceleration2_ = std::max(acceleration2_, fx * fx + lift * lift);
    response_.acceleration_mps2 = std::max(response_.acceleration_mps2, std::sqrt(acceleration2_));
  }

  // Steps from knot to knot, one or several, while the mode lasts. `rates`: right-hand side; `read`: values -> state;
  // `witness`: of an event, zero at it; `first_event`: looks at the step and tells the first event and when; `watch`: peaks
  // of the step.
  template <std::size_t D, class Rates, class Read, class Witness, class Event, class Watch>
  bool march(const Values<D>& start, Rates&& rates, Read&& read, Witness&& witness, Event&& first_event,
             Watch&& watch) {
    Method<D> method(tolerance_);
    Values<D> x = start, dx{}, next{}, dnext{};
    rates(x, dx, floor_.offset);
    while (!floor_.ended()) {
      if (floor_.left() <= 0) {
        floor_.next_piece();
        rates(x, dx, 0);
        continue;
      }
      const double begin = floor_.offset, h = floor_.step(method, rates, x, dx, next, dnext), end = begin + h;
      const auto inside = [&](double t) { return method.inside(t, x, dx, begin, next, dnext, end); };
      const auto exactly = [&](double t) {
        if constexpr (Method<D>::inside_is_exact) {
          return inside(t);
        } else {
          Values<D> at, rate;
          method.step(rates, x, dx, begin, at, rate, t - begin);
          return at;
        }
      };
      double when = end;
      const PeerEvent event = first_event(x, next, inside, begin, end, when);
      if constexpr (!Method<D>::inside_is_exact) {
        if (when < end && when > begin) {
          const double back = 1e-3 * (when - begin), value = witness(event, inside(when), when);
          const double slope = (value - witness(event, inside(when - back), when - back)) / back;
          when = std::clamp(when - witness(event, exactly(when), when) / slope, begin, end);
        }
      }
      const Values<D> there = when == end ? next : exactly(when);
      watch(x, there, inside, exactly, begin, when);
      if (event != PeerEvent::none) {
        read(there, y_);
        floor_.offset = when;
        return block_.resolve(event, y_, floor_.a(when), response_);
      }
      x = next;
      if (floor_.go_on(h, end))
        rates(x, dx, 0);
      else
        dx = dnext;
    }
    read(x, y_);
    return false;
  }

  // Where an event has been found at `when` already, an earlier one takes its place.
  template <class F>
  void earlier(PeerEvent other, F&& f, double f_begin, double f_when, double begin, double& when, PeerEvent& event) {
    double at = when;
    if (!crossing(f, f_begin, f_when, begin, when, at, root_s_) || (event != PeerEvent::none && at >= when)) return;
    when = at;
    event = other;
  }

  bool slide() {
    using X = Values<2>;
    const double sigma = y_.sigma, pull = -sigma * PeerBlock::g;
    const bool may_tip = block_.can_rock && block_.drop > 0;
    const auto witness = [&](PeerEvent event, const X& x, double) {
      return event == PeerEvent::tip ? block_.b - block_.mu_at(x[1]) * block_.h : sigma * x[1];
    };
    observe_forces(pull * block_.mu_k, PeerBlock::g);
    return march<2>(
        X{y_.xi, y_.w},
        [&](const X& x, X& dx, double t) {
          dx[0] = x[1];
          dx[1] = pull * block_.mu_at(x[1]) - floor_.a(t);
        },
        [](const X& x, PeerState& y) { y.xi = x[0], y.w = x[1]; }, witness,
        [&](const X& x, const X& next, auto& inside, double begin, double end, double& when) {
          const auto stopping = [&](double t) { return witness(PeerEvent::stop, inside(t), t); };
          const auto tipping = [&](double t) { return witness(PeerEvent::tip, inside(t), t); };
          PeerEvent event = PeerEvent::none;
          if (crossing(stopping, sigma * x[1], sigma * next[1], begin, end, when, root_s_)) event = PeerEvent::stop;
          if (may_tip) {
            const double tips = witness(PeerEvent::tip, x, begin),
                         tips_then = when == end ? witness(PeerEvent::tip, next, end) : tipping(when);
            earlier(PeerEvent::tip, tipping, tips, tips_then, begin, when, event);
          }
          return event;
        },
        [&](const X&, const X& there, auto&, auto&, double, double) {
          response_.slip_m = std::max(response_.slip_m, std::abs(there[0]));
        });
  }

  bool rock() {
    using X = Values<2>;
    const double s = y_.s;
    const auto grip = [&](const X& x, double t) {
      const PeerForces f = block_.rock_forces(s, x[0], x[1], floor_.a(t));
      observed_ = f;
      return block_.mu_s * f.fy - std::abs(f.fx);
    };
    const auto witness = [&](PeerEvent event, const X& x, double t) {
      return event == PeerEvent::grip ? grip(x, t) : s * x[0];
    };
    double grip_before = block_.can_slip ? grip({y_.theta, y_.omega}, floor_.offset) : 0;
    return march<2>(
        X{y_.theta, y_.omega},
        [&](const X& x, X& dx, double t) {
          dx[0] = x[1];
          dx[1] = block_.rock_alpha(s, x[0], floor_.a(t));
        },
        [](const X& x, PeerState& y) { y.theta = x[0], y.omega = x[1]; }, witness,
        [&](const X& x, const X& next, auto& inside, double begin, double end, double& when) {
          const auto impact = [&](double t) { return witness(PeerEvent::impact, inside(t), t); };
          PeerEvent event = PeerEvent::none;
          if (crossing(impact, s * x[0], s * next[0], begin, when, when, root_s_)) event = PeerEvent::impact;
          if (std::abs(next[0]) > pi / 2) return PeerEvent::overturned;
          const double grip_after = grip(next, end);
          observe_forces(observed_.fx, observed_.fy);
          if (block_.can_slip) {
            const auto gripping = [&](double t) { return grip(inside(t), t); };
            earlier(PeerEvent::grip, gripping, grip_before, when == end ? grip_after : gripping(when), begin, when,
                    event);
            grip_before = grip_after;
          }
          return event;
        },
        [&](const X& x, const X& there, auto& inside, auto& exactly, double begin, double when) {
          turn(x, there, inside, exactly, begin, when);
        });
  }

  // Peak of the rotation inside a step, and what it moves the base by where the corner is stuck.
  template <std::size_t D, class Inside, class Exactly>
  void turn(const Values<D>& x, const Values<D>& there, Inside& inside, Exactly& exactly, double begin, double when) {
    if (x[1] * there[1] < 0) {
      const double sign = x[1] > 0 ? 1 : -1;
      const double top =
          illinois([&](double t) { return sign * inside(t)[1]; }, begin, sign * x[1], when, sign * there[1], 1e-9);
      observe_turn<D>(exactly(top)[0]);
    }
    observe_turn<D>(there[0]);
  }
  template <std::size_t D>
  void observe_turn(double theta) {
    observe_rotation(theta);
    if (D == 2) observe_slip({PeerMode::rock, y_.s, 0, theta, 0, y_.xi, 0});
  }

  bool slide_rock() {
    using X = Values<4>;
    const double s = y_.s, sigma = y_.sigma;
    const auto state = [&](const X& x) { return PeerState{PeerMode::slide_rock, s, sigma, x[0], x[1], x[2], x[3]}; };
    const auto witness = [&](PeerEvent event, const X& x, double) {
      return event == PeerEvent::stop ? sigma * x[3] : s * x[0];
    };
    return march<4>(
        X{y_.theta, y_.omega, y_.xi, y_.w},
        [&](const X& x, X& dx, double t) {
          const PeerForces f = block_.slide_rock_forces(s, sigma, x[0], x[1], x[3], floor_.a(t));
          dx = {x[1], f.alpha, x[3], f.slip_acceleration};
        },
        [](const X& x, PeerState& y) { y.theta = x[0], y.omega = x[1], y.xi = x[2], y.w = x[3]; }, witness,
        [&](const X& x, const X& next, auto& inside, double begin, double end, double& when) {
          const auto impact = [&](double t) { return witness(PeerEvent::impact, inside(t), t); };
          const auto stopping = [&](double t) { return witness(PeerEvent::stop, inside(t), t); };
          PeerEvent event = PeerEvent::none;
          if (crossing(impact, s * x[0], s * next[0], begin, when, when, root_s_)) event = PeerEvent::impact;
          const double w_then = when == end ? next[3] : inside(when)[3];
          earlier(PeerEvent::stop, stopping, sigma * x[3], sigma * w_then, begin, when, event);
          if (std::abs(next[0]) > pi / 2) return PeerEvent::overturned;
          const PeerForces f = block_.slide_rock_forces(s, sigma, next[0], next[1], next[3], floor_.a(end));
          if (f.fy <= 0 && event == PeerEvent::none) return PeerEvent::lift;
          observe_forces(f.fx, f.fy);
          return event;
        },
        [&](const X& x, const X& there, auto& inside, auto& exactly, double begin, double when) {
          turn(x, there, inside, exactly, begin, when);
          const double before = block_.slip_rate(state(x)), after = block_.slip_rate(state(there));
          if (before * after < 0) {
            const double sign = before > 0 ? 1 : -1;
            const double top = illinois([&](double t) { return sign * block_.slip_rate(state(inside(t))); }, begin,
                                        sign * before, when, sign * after, 1e-9);
            observe_slip(state(exactly(top)));
          }
          observe_slip(state(there));
        });
  }

  PeerBlock block_;
  Floor floor_;
  PeerState y_;
  PeerResponse response_;
  PeerForces observed_{};
  double acceleration2_ = 0;
  double tolerance_, root_s_;  // width to which a root is found
};

}  // namespace
}  // namespace freestand::bench
