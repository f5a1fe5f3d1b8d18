// Blocks that fall to the floor within the interval, side by side: most rock on at once, on the other corner.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/rock_march.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int strikes_at_once = 2 * pack_lanes;

// The other corner, as in the rows; and the squared rate that is lost to rest, the rate from which a row of hops may die
// out, and the squared rotation up to which hops are small.
struct OtherCorner {
  alignas(64) double kept[strikes_at_once], arm[strikes_at_once], height[strikes_at_once];
  alignas(64) double gravity[strikes_at_once], push[strikes_at_once];
  alignas(64) double rests[strikes_at_once], dying[strikes_at_once], small2[strikes_at_once];
};

class RockStrikes : public LaneGroup<RockRows> {
 public:
  // Bits of the lanes that stand on the other corner now, and of those among them that certainly rock on.
  struct Struck {
    unsigned all, rock;
    alignas(64) double rates[strikes_at_once];  // at the impacts
  };

  // The impacts of the first `lanes`. Where one is not clear, the lane stays as it is.
  void strike(const OtherCorner& other, int lanes, Struck& struck) {
    struck.all = struck.rock = 0;
    lanes > pack_lanes ? strike_packs<2>(other, struck) : strike_packs<1>(other, struck);
  }

 private:
  struct Fall {
    RockStep y;
    Pack fraction, fraction2, gravity, push, a, change;
  };

  template <int count>
  void strike_packs(const OtherCorner& other, Struck& struck) {
    const Pack zero(0.0), one(1.0);
    Fall falls[count];
    Bracket impacts[count];
    for (int q = 0; q < count; ++q) {
      Fall& f = falls[q];
      fall(f, q * pack_lanes);
      const Pack end = f.y.sum(f.y.theta), guess = first_zero(f.y.theta[0], f.y.theta[1], end);
      impacts[q] = {f.y.theta, one, zero, one, guess, end <= zero};
    }
    narrow_all<RockStep::order + 1>(impacts);
    for (int q = 0; q < count; ++q) change_corners(falls[q], impacts[q].x, other, q * pack_lanes, struck);
  }

  void fall(Fall& f, int i) const {
    f.fraction = load(r_.fraction + i);
    f.fraction2 = f.fraction * f.fraction;
    f.gravity = load(r_.gravity + i) * f.fraction2;
    f.push = load(r_.push + i) * f.fraction2;
    f.a = load(r_.a + i);
    f.change = fetch(r_.next + i) - f.a;
    f.y.theta[0] = load(r_.theta + i);
    f.y.omega[0] = load(r_.omega + i) * f.fraction;
    f.y.rx[0] = load(r_.rx + i);
    f.y.ry[0] = load(r_.ry + i);
    f.y.expand(f.gravity, f.push * f.a, f.push * f.change);
  }

  // `part`: of what is left of the interval, at the impact.
  void change_corners(const Fall& f, const Pack& part, const OtherCorner& other, int i, Struck& struck) {
    const Pack zero(0.0), one(1.0), arm = load(other.arm + i), height = load(other.height + i);
    RockEnd end{f.y.omega_at(part), zero, zero, f.a + f.change * part, zero};
    f.y.arm_at(part, end.rx, end.ry);
    const Pack fraction4 = f.fraction2 * f.fraction2, weight = load(r_.weight + i), seen = load(r_.force2 + i);
    const Pack force2 =
        watch_force(f.y, weight * f.fraction2, f.gravity, f.push, f.a, f.change, end, part, seen * fraction4, true) /
        fraction4;

    const Pack falls = end.omega / f.fraction, omega = zero - load(other.kept + i) * falls, omega2 = omega * omega;
    const Pack gravity = load(other.gravity + i), push = load(other.push + i), ahead = f.fraction - f.fraction * part;
    const Pack pull = arm * gravity + height * (push * end.a);
    const PackMask rests = omega2 < load(other.rests + i), dies = omega <= load(other.dying + i);
    const Pack peak = load(r_.peak + i), small2 = xsimd::min(load(other.small2 + i), peak * peak);
    const PackMask hops = omega2 * omega2 < Pack(4.0) * small2 * (pull * pull);
    const PackMask clear = (ahead >= Pack(1e-12)) & (part > zero);
    const auto put = [&](double* row, const Pack& x) { store(row + i, choose(clear, x, load(row + i))); };
    put(r_.theta, zero);
    put(r_.omega, omega);
    put(r_.rx, zero - arm);
    put(r_.ry, height);
    put(r_.gravity, gravity);
    put(r_.push, push);
    put(r_.weight, zero - weight);
    put(r_.a, end.a);
    put(r_.fraction, ahead);
    put(r_.force2, xsimd::max(seen, force2));
    store(struck.rates + i, falls);
    struck.all |= bits(clear) << i;
    struck.rock |= bits(clear & ~(rests | dies | hops)) << i;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
