// One sample of a block under a law (law_block.hpp) by dopri5 of Boost.odeint, from knot to knot: in equal steps. Events are located by the Illinois method on the polynomial
// of the step.
#pragma once

#include <utility>

#include "dopri5.hpp"
#include "illinois.hpp"
#include "law_block.hpp"
#include "peer_floor.hpp"

namespace freestand::bench {
namespace {

template <class Law>
class LawSample {
 public:
  LawSample(const LawBlock<Law>& block, const RecordFloor& floor, double root_s)
      : block_(block), floor_(floor), root_s_(root_s) {
    block_.turn_side(y_);
  }

  PeerResponse run() {
    block_.choose(y_, floor_.a(0), floor_.g(0));
    bool alive = true;
    while (alive && !floor_.ended()) {
      if (response_.events > most_events) return response_.failed = true, response_;
      switch (y_.mode) {
        case PeerMode::rest:
          if constexpr (Law::own > 0)
            alive = march<false, false>();
          else
            alive = wait();
          break;
        case PeerMode::slide:
          alive = march<false, true>();
          break;
        case PeerMode::rock:
          alive = march<true, false>();
          break;
        case PeerMode::slide_rock:
          alive = march<true, true>();
          break;
      }
    }
    return response_;
  }

 private:
  static constexpr int event_kinds = 8, most_events = 20000;

  // A block whose law stands still while it rests. False: it rests for good.
  bool wait() {
    const double X = block_.law.force(y_.xi, 0, y_), none = std::numeric_limits<double>::infinity();
    const double right = block_.can_slip ? block_.limit(-1, y_, block_.law.gravity) / block_.law.gravity : none;
    const double left = block_.can_slip ? block_.limit(1, y_, block_.law.gravity) / block_.law.gravity : none;
    const double tips = block_.can_rock ? block_.b / block_.h : none;
    const auto margins = [&](double a, double g) {
      return std::array<double, 2>{std::fmin(right, tips) * g - (a - X), std::fmin(left, tips) * g + (a - X)};
    };
    int which = 0;
    if (!floor_.wait(margins, response_.acceleration_mps2, which)) return false;
    ++response_.events;
    const double a = floor_.a(floor_.offset), g = floor_.g(floor_.offset);
    if (which < 0)
      block_.choose_flat(y_, a, g);
    else
      block_.leave_rest(y_, a, g, tips <= (which == 0 ? right : left) ? PeerEvent::tip : PeerEvent::grip);
    return true;
  }

  // Where the unknowns of a mode stand.
  template <bool turns, bool slips>
  struct Place {
    static constexpr int moves = slips, xi = 2 * turns, own = xi + 2 * moves;
    static constexpr std::size_t count = own + Law::own;
    using X = std::array<double, count>;

    static LawState state(const LawState& start, const X& x) {
      LawState y = start;
      if constexpr (turns) y.theta = x[0], y.omega = x[1];
      if constexpr (moves == 1) y.xi = x[xi], y.w = x[xi + 1];
      if constexpr (Law::own > 0) y.e0 = x[own];
      if constexpr (Law::own > 1) y.e1 = x[own + 1];
      if constexpr (slips && Law::factor_follows_path) y.path = start.path + start.sigma * (y.xi - start.xi);
      return y;
    }
    static X unknowns(const LawState& y) {
      X x;
      if constexpr (turns) x[0] = y.theta, x[1] = y.omega;
      if constexpr (moves == 1) x[xi] = y.xi, x[xi + 1] = y.w;
      if constexpr (Law::own > 0) x[own] = y.e0;
      if constexpr (Law::own > 1) x[own + 1] = y.e1;
      return x;
    }
  };

  template <bool turns, bool slips>
  LawForces forces_at(const LawState& y, double t) const {
    return block_.template forces<turns, slips>(y, floor_.a(t), floor_.g(t));
  }
  // Above zero until the event. f: forces then.
  template <PeerEvent event>
  double witness(const LawState& y, const LawForces& f) const {
    if constexpr (event == PeerEvent::impact) return y.s * y.theta;
    if constexpr (event == PeerEvent::kink)
      return block_.law.witness(block_.displacement(y), block_.velocity(y), y.side);
    if constexpr (event == PeerEvent::stop) return y.sigma * y.w;
    if constexpr (event == PeerEvent::grip) return block_.grip(y, f);
    if constexpr (event == PeerEvent::tip) return block_.b * f.fy - block_.h * std::abs(f.fx);
    return f.fy;
  }
  template <PeerEvent event>
  static constexpr bool asks_for_forces() {
    return event != PeerEvent::impact && event != PeerEvent::kink && event != PeerEvent::stop;
  }
  // Events that are looked for by their witness.
  template <PeerEvent event, bool turns, bool slips>
  static constexpr bool watched() {
    if (event == PeerEvent::impact) return turns;
    if (event == PeerEvent::stop) return slips;
    if (event == PeerEvent::grip) return !slips;
    if (event == PeerEvent::tip) return !turns && (!slips || Law::factor_changes);
    if (event == PeerEvent::kink) return Law::has_kinks && (turns || slips);
    return event == PeerEvent::lift && (turns || Law::is_shaken);
  }
  bool possible(PeerEvent event) const {
    return event == PeerEvent::grip ? block_.can_slip : event != PeerEvent::tip || block_.can_rock;
  }

  // Everything inlined, so that what a step does not ask for is not computed.
  template <bool turns, bool slips>
  [[gnu::flatten]] bool march() {
    using P = Place<turns, slips>;
    using X = typename P::X;
    const LawState start = y_;
    const auto rates = [&](const X& x, X& dx, double t) {
      const LawState y = P::state(start, x);
      const LawForces f = block_.template forces<turns, slips>(y, floor_.a(t), floor_.g(t));
      if constexpr (turns) dx[0] = y.omega, dx[1] = f.alpha;
      if constexpr (P::moves == 1) dx[P::xi] = y.w, dx[P::xi + 1] = f.slip_acceleration;
      if constexpr (Law::own > 0) dx[P::own] = f.rate0;
      if constexpr (Law::own > 1) dx[P::own + 1] = f.rate1;
    };
    Dopri5<P::count> method;
    X x = P::unknowns(y_), dx{}, next{}, dnext{};
    rates(x, dx, floor_.offset);
    double before[event_kinds]{}, after[event_kinds]{};
    const auto each = [&](auto&& look) {
      look.template operator()<PeerEvent::impact>();
      look.template operator()<PeerEvent::stop>();
      look.template operator()<PeerEvent::grip>();
      look.template operator()<PeerEvent::tip>();
      look.template operator()<PeerEvent::kink>();
      look.template operator()<PeerEvent::lift>();
    };
    each([&]<PeerEvent event>() {
      if constexpr (watched<event, turns, slips>())
        if (possible(event))
          before[static_cast<int>(event)] = witness<event>(y_, forces_at<turns, slips>(y_, floor_.offset));
    });
    const double since = floor_.time();
    while (!floor_.ended()) {
      if (!turns && !slips && floor_.over() && floor_.time() - since > block_.law.settling_s) return false;
      if (floor_.left() <= 0) {
        floor_.next_knot();
        rates(x, dx, 0);
        continue;
      }
      const double begin = floor_.offset, h = floor_.step(), end = begin + h;
      method.step(rates, x, dx, begin, next, dnext, h);
      const auto inside = [&](double t) { return method.inside(t, x, dx, begin, next, dnext, end); };
      const LawState last = P::state(start, next);
      const LawForces forces_last = forces_at<turns, slips>(last, end);
      double when = end;
      PeerEvent found = PeerEvent::none;
      each([&]<PeerEvent event>() {
        if constexpr (watched<event, turns, slips>()) {
          if (!possible(event)) return;
          const auto f = [&](double t) {
            const LawState y = P::state(start, inside(t));
            return witness<event>(y, asks_for_forces<event>() ? forces_at<turns, slips>(y, t) : LawForces{});
          };
          constexpr int i = static_cast<int>(event);
          after[i] = when == end ? witness<event>(last, forces_last) : f(when);
          double at = when;
          if (crossing(f, before[i], after[i], begin, when, at, root_s_) && (found == PeerEvent::none || at < when))
            when = at, found = event;
        }
      });
      if constexpr (turns)
        if (std::abs(next[0]) > pi / 2) found = PeerEvent::overturned, when = end;
      const LawState now = when == end ? last : P::state(start, inside(when));
      watch<turns, slips>(
          P::state(start, x), now, when == end ? forces_last : forces_at<turns, slips>(now, when),
          [&](double t) { return P::state(start, inside(t)); }, begin, when);
      if (found != PeerEvent::none) {
        y_ = now;
        floor_.offset = when;
        return block_.resolve(found, y_, floor_.a(when), floor_.g(when), response_);
      }
      x = next;
      std::copy(after, after + event_kinds, before);
      if (floor_.go(h, end))
        rates(x, dx, 0);  // the floor jumps
      else
        dx = dnext;
    }
    return false;
  }

  // Peaks of a step.
  template <bool turns, bool slips, class Inside>
  void watch(const LawState& from, const LawState& to, const LawForces& f, Inside&& inside, double begin, double when) {
    const auto top = [&](auto&& rate) {
      const double before = rate(from), after = rate(to);
      if (before * after >= 0) return;
      const double sign = before > 0 ? 1 : -1;
      const auto rises = [&](double t) { return sign * rate(inside(t)); };
      observe<turns, slips>(inside(illinois(rises, begin, sign * before, when, sign * after, 1e-9)));
    };
    if constexpr (turns) top([](const LawState& y) { return y.omega; });
    if constexpr (turns && slips) top([&](const LawState& y) { return block_.velocity(y); });
    observe<turns, slips>(to);
    const double lift = f.fy - block_.law.gravity, level = f.acceleration;
    acceleration2_ = std::fmax(acceleration2_, level * level + lift * lift);
  }
  template <bool turns, bool slips>
  void observe(const LawState& y) {
    if constexpr (turns) response_.rotation_rad = std::fmax(response_.rotation_rad, std::abs(y.theta));
    response_.slip_m = std::fmax(response_.slip_m, std::abs(block_.displacement(y)));
  }

  LawBlock<Law> block_;
  RecordFloor floor_;
  LawState y_;
  PeerResponse response_;
  double acceleration2_ = 0;
  double root_s_;
};

}  // namespace
}  // namespace freestand::bench
