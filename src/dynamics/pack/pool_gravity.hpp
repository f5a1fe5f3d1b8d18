// What presses the blocks of a pool down.
//
//   Steady  g' = g, and no work
//   Shaken  g' = g + v, straight within an interval; the records' rows hold a and v, knot by knot
//   Pulled  g' = g, and a spring and a drag pull along the floor
#pragma once

#include <array>

#include "base/pack.hpp"
#include "dynamics/pack/gravity.hpp"
#include "dynamics/pack/hop_series.hpp"
#include "dynamics/pack/pull.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int march_slots = 120;  // no power of two, so that a lane's rows do not share a few places of the cache

// Nothing pulls along the floor.
struct Free {
  static constexpr bool pulls = false;
  template <int N, class Rows>
  static NoPull pull(const Rows&, int, const Pack&, const Pack&, const Pack&) {
    return {};
  }
  template <class Rows>
  static Pack turn_over(Rows&, const Pack&, const Pack&, const Pack&) {
    return Pack(0.0);
  }
};

struct Steady : Free {
  static constexpr bool shaken = false;
  static constexpr int stride = 1;  // of the records' rows

  struct Rows {};
  // What is left of an interval.
  struct Interval {
    Interval(const Rows&, int, const double* const*) {}
    static Level lift() { return {}; }
    static const Pack& gravity(const Pack& g) { return g; }
    static const Pack& per_inertia(const Pack& g) { return g; }
    static const Pack& lifted(const Pack& y) { return y; }
    static const Pack& curvature_with(const Pack& curvature) { return curvature; }
    static void keep(Rows&, int, const PackMask&) {}
  };

  struct HopRows : Rows {};
  // The same for small hops (dynamics/pack/hop_series.hpp).
  struct Hop {
    Hop(const HopRows&, int, const double* const*, const Pack&, const PackMask&) {}
    static const Pack& beta(const Pack& y) { return y; }
    static const Pack& beta_next(const Pack& y) { return y; }
    static const Pack& beta_rate(const Pack& y) { return y; }
    static const Pack& kappa(const Pack& y) { return y; }
    static const Pack& kappa_rate(const Pack& y) { return y; }
    static const PackMask& holds(const PackMask& others) { return others; }
    static NoPullOfHop pull() { return {}; }
    static void keep(HopRows&, int, const PackMask&, const PackMask&, const Pack&) {}
  };
};

struct Shaken : Free {
  static constexpr bool shaken = true;
  static constexpr int stride = 2;

  struct Rows {
    alignas(64) double v[march_slots] = {};            // unit record, at the knot
    alignas(64) double weight[march_slots] = {};       // scale h^2
    alignas(64) double per_inertia[march_slots] = {};  // 1/J
    alignas(64) double curvature[march_slots] = {};    // as curvature1 of the rows, for changes of v h^2
    auto all() { return std::array{v, weight, per_inertia, curvature}; }
  };
  class Interval {
   public:
    Interval(const Rows& rows, int i, const double* const* next)
        : unit_(load(rows.v + i)),
          unit_next_(fetch(next, 1)),
          weight_(load(rows.weight + i)),
          per_(load(rows.per_inertia + i)),
          curvature_(load(rows.curvature + i)) {}

    Straight<Pack> lift() const { return {weight_ * unit_, weight_ * (unit_next_ - unit_)}; }  // v h^2
    Straight<Pack> gravity(const Pack& g) const {                                              // g' h^2 from g h^2
      const Straight<Pack> v = lift();
      return {g + v.start, v.rate};
    }
    Straight<Pack> per_inertia(const Pack& g) const {  // g' h^2/J from g h^2/J
      const Straight<Pack> v = lift() * per_;
      return {g + v.start, v.rate};
    }
    Pack lifted(const Pack& y) const { return y + weight_ * unit_next_; }
    Pack curvature_with(const Pack& curvature) const { return curvature + curvature_ * xsimd::abs(lift().rate); }
    // Its end is the start of the next one, but in the lanes of `stays`.
    void keep(Rows& rows, int i, const PackMask& stays) const { store(rows.v + i, choose(stays, unit_, unit_next_)); }

   private:
    const Pack unit_, unit_next_, weight_, per_, curvature_;
  };

  struct HopRows {
    alignas(64) double v[march_slots] = {};                                   // unit record, where the lane is
    alignas(64) double most[march_slots] = {};                                // |v| up to which the rows' bounds hold
    alignas(64) double lift[2][march_slots] = {}, turn[2][march_slots] = {};  // what v adds to beta, and to kappa
    auto all() { return std::array{v, most, lift[0], lift[1], turn[0], turn[1]}; }
  };
  class Hop {
   public:
    Hop(const HopRows& rows, int i, const double* const* next, const Pack& fraction, const PackMask& right)
        : v_(load(rows.v + i)),
          next_(fetch(next, 1)),
          rate_((next_ - v_) / fraction),
          most_(load(rows.most + i)),
          lift_(choose(right, load(rows.lift[1] + i), load(rows.lift[0] + i))),
          turn_(choose(right, load(rows.turn[1] + i), load(rows.turn[0] + i))) {}

    Pack beta(const Pack& y) const { return y + lift_ * v_; }
    Pack beta_next(const Pack& y) const { return y + lift_ * next_; }
    Pack beta_rate(const Pack& y) const { return y + lift_ * rate_; }
    Pack kappa(const Pack& y) const { return y + turn_ * v_; }
    Pack kappa_rate(const Pack& y) const { return y + turn_ * rate_; }
    PackMask holds(const PackMask& others) const {
      return others & (xsimd::max(xsimd::abs(v_), xsimd::abs(next_)) <= most_);
    }
    static NoPullOfHop pull() { return {}; }
    // After a time t.
    void keep(HopRows& rows, int i, const PackMask& stays, const PackMask& to_knot, const Pack& t) const {
      store(rows.v + i, choose(stays, v_, choose(to_knot, next_, v_ + rate_ * t)));
    }

   private:
    const Pack v_, next_, rate_, most_, lift_, turn_;
  };
};

struct Pulled : Steady {
  static constexpr bool pulls = true;

  struct Rows {
    alignas(64) double stiffness[march_slots] = {}, drag[march_slots] = {};   // in units of the record
    alignas(64) double lever_x[march_slots] = {}, lever_y[march_slots] = {};  // of the midpoint's slip
    alignas(64) double xi[march_slots] = {};                                  // of a corner that does not slip
    alignas(64) double share[march_slots] = {};  // unit record, per gravity and the floor's largest acceleration
    auto all() { return std::array{stiffness, drag, lever_x, lever_y, xi, share}; }
  };
  // fraction: of an interval, that lies ahead; slip of the corner, and of the middle of the base beyond it.
  template <int N>
  static Pull<N, Pack> pull(const Rows& rows, int i, const Pack& fraction, const Pack& xi, const Pack& more) {
    return {load(rows.stiffness + i), load(rows.drag + i) / fraction, load(rows.lever_x + i), load(rows.lever_y + i),
            xi + more};
  }
  // The blocks of the first pack, mirrored, on the corner that just struck the floor: the pull there.
  static Pack turn_over(Rows& r, const Pack& arm, const Pack& height, const Pack& half_base) {
    const Pack zero(0.0), lever = half_base / (height * height + arm * arm), stiffness = zero - load(r.stiffness),
                          xi = zero - load(r.xi);
    store(r.stiffness, stiffness);
    store(r.drag, zero - load(r.drag));
    store(r.lever_x, lever * arm);
    store(r.lever_y, lever * height);
    store(r.xi, xi);
    return stiffness * xi;
  }
  struct Interval : Steady::Interval {
    Interval(const Rows&, int i, const double* const* next) : Steady::Interval({}, i, next) {}
    static void keep(Rows&, int, const PackMask&) {}
  };

  struct HopRows {
    alignas(64) double stiffness[2][march_slots] = {}, drag[2][march_slots] = {};  // times B h/J of either corner
    auto all() { return std::array{stiffness[0], stiffness[1], drag[0], drag[1]}; }
  };
  class Hop : public Steady::Hop {
   public:
    Hop(const HopRows& rows, int i, const double* const* next, const Pack& fraction, const PackMask& right)
        : Steady::Hop({}, i, next, fraction, right),
          stiffness_(choose(right, load(rows.stiffness[1] + i), load(rows.stiffness[0] + i))),
          drag_(choose(right, load(rows.drag[1] + i), load(rows.drag[0] + i))) {}
    PullOfHop pull() const { return {stiffness_, drag_}; }
    static void keep(HopRows&, int, const PackMask&, const PackMask&, const Pack&) {}

   private:
    const Pack stiffness_, drag_;
  };
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
