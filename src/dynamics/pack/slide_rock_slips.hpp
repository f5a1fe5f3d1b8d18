// Blocks that slide-rock at present, side by side, and their steps in packs: an interval, or what is left of it, as long
// as nothing happens in it: no impact, no end of the slip, no turn that could be a peak.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N, class Gravity, class Friction>
class SlideRockSlips : public LaneGroup<SlipRows<Gravity, Friction>> {
  using Group = LaneGroup<SlipRows<Gravity, Friction>>;
  using Group::r_;

 public:
  template <class Lane>
  static void release(Lane& lane) {
    lane.go_on();
  }

  // One interval for every block; bits of the blocks to which something happens, or whose record ends.
  std::uint64_t march() {
    return Group::each_pack([this](int i, unsigned here) { return march(i, here); });
  }

 private:
  unsigned march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0), two(2.0), left = load(r_.left + i), left2 = left * left;
    CornerSeries<N, Pack> y;
    y.theta[0] = load(r_.theta + i);
    y.rx[0] = load(r_.rx + i);
    y.ry[0] = load(r_.ry + i);
    y.xi[0] = load(r_.xi + i);
    const Pack omega0 = load(r_.omega + i), w0 = load(r_.w + i);
    y.omega[0] = omega0 * left;
    y.w[0] = w0 * left;
    const Pack a = load(r_.a + i), a_next = fetch(r_.next + i), weight = load(r_.weight + i) * left2;
    const Pack gravity = load(r_.weight_g + i) * left2, k2 = load(r_.k2 + i), friction = load(r_.friction + i);
    const Pack sigma = load(r_.sigma + i), to_speed = r_.law.to_speed(i, sigma, left);
    typename Friction::template Factor<N> factor(r_.law, i);
    const typename Gravity::Interval shakes(r_.shakes, i, r_.next + i);
    const auto field = shakes.gravity(load(r_.weight_g + i)) * left2;
    const auto floor_lift = shakes.lift() * left2;
    y.slide_rock(field, weight * a, weight * (a_next - a), k2, friction, to_speed, factor);
    const Pack theta = y.sum(y.theta), omega = y.sum(y.omega), rx = y.sum(y.rx), ry = y.sum(y.ry);
    const Pack xi = y.sum(y.xi), w = y.sum(y.w);

    const Pack reach = xsimd::abs(y.omega[0]) + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
    const Pack low = xsimd::min(y.theta[0], theta), high = xsimd::max(y.theta[0], theta);
    const PackMask turns = (y.omega[0] * omega <= zero) |
                           ((y.omega[0] * y.omega[1] < zero) & (xsimd::abs(y.omega[1]) > two * xsimd::abs(y.omega[0])));
    const Pack size = load(r_.size + i), last = xsimd::max(xsimd::abs(y.omega[N + 1]) * size, xsimd::abs(y.w[N + 1]));
    PackMask stays = (turns & ((high + reach > load(r_.look + i)) | (low < reach))) | (theta <= zero) |
                     ~(theta < Pack(1.5)) | ~(last < Friction::neglected(left) * size);

    // The slip leaves its chord by its higher terms at most.
    const Pack bow = xsimd::abs(y.w[2]) + xsimd::abs(y.w[3]) + xsimd::abs(y.w[4]);
    stays = stays | ~(xsimd::min(sigma * y.w[0], sigma * w) > bow);

    // Of the midpoint: u = xi + B (1 - cos theta), u' = w + (lever_y r_x + lever_x r_y) omega.
    const Pack lever_x = load(r_.lever_x + i), lever_y = load(r_.lever_y + i);
    const Pack u = xi + load(r_.half_base + i) * versine(theta), peak = load(r_.peak + i);
    const Pack before = y.w[0] + (lever_y * y.rx[0] + lever_x * y.ry[0]) * y.omega[0];
    const Pack after = w + (lever_y * rx + lever_x * ry) * omega, size_u = xsimd::abs(u);
    stays = stays | ((before * after < zero) & (size_u + xsimd::abs(before) + xsimd::abs(after) > peak));

    const Pack mu0 = friction * factor.first(), mu = friction * factor.last();
    const Pack q0 = y.rx[0] + mu0 * y.ry[0], n0 = at_start(field) - y.ry[0] * y.omega[0] * y.omega[0];
    const Pack q = rx + mu * ry, n = at_end(field) - ry * omega * omega, d0 = k2 + y.rx[0] * q0, d = k2 + rx * q;
    stays = stays | ~((xsimd::min(n0, n) > zero) & (xsimd::min(d0, d) > Pack(0.05) * k2));
    const Pack fy0 = n0 * k2 / d0, fy = n * k2 / d, seen = load(r_.seen + i);
    const Pack lift0 = fy0 - gravity, lift = fy - gravity;
    const Pack square =
        xsimd::max(mu0 * mu0 * fy0 * fy0 + lift0 * lift0, mu * mu * fy * fy + lift * lift) / (left2 * left2);
    if (const PackMask feels = square * Pack(1.1) > seen; bits(feels)) {
      // Slope of the squared force at both ends, but for positive factors.
      const auto slope = [&](const Pack& x, const Pack& y1, const Pack& o, const Pack& n1, const Pack& d1,
                             const Pack& q1, const Pack& f, const Pack& m, const Pack& m_rate) {
        const Pack alpha = n1 * q1 / d1, n_rate = plus_rate(x * o * o * o - two * y1 * o * alpha, floor_lift);
        Pack d_rate = o * (y1 * q1 + x * (y1 - m * x)), change(0.0);
        if constexpr (Friction::by_speed) {
          d_rate = d_rate + x * m_rate * y1;
          change = m * m_rate * f * f * (d1 * d1 / k2);
        }
        return (n_rate * d1 - n1 * d_rate) * (m * m * f + f - gravity) + change;
      };
      const Pack rate0 = friction * factor.first_rate(), rate = friction * factor.last_rate();
      stays = stays | (feels & (slope(y.rx[0], y.ry[0], y.omega[0], n0, d0, q0, fy0, mu0, rate0) >= zero) &
                       (slope(rx, ry, omega, n, d, q, fy, mu, rate) <= zero));
    }

    const Pack per_left = one / left;
    store(r_.seen + i, choose(stays, seen, xsimd::max(seen, square)));
    store(r_.peak + i, choose(stays, peak, xsimd::max(peak, size_u)));
    store(r_.theta + i, choose(stays, y.theta[0], theta));
    store(r_.omega + i, choose(stays, omega0, omega * per_left));
    store(r_.rx + i, choose(stays, y.rx[0], rx));
    store(r_.ry + i, choose(stays, y.ry[0], ry));
    store(r_.xi + i, choose(stays, y.xi[0], xi));
    store(r_.w + i, choose(stays, w0, w * per_left));
    store(r_.a + i, choose(stays, a, a_next));
    shakes.keep(r_.shakes, i, stays);
    store(r_.left + i, choose(stays, left, one));
    const unsigned all = bits(stays) & here;
    advance(r_.next + i, here & ~all, Gravity::stride);
    return all;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
