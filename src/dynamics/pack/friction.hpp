// The friction of a slip as its series ask for it: the factor F on mu_k over a step, coefficient by coefficient.
//
//   Coulomb  F = 1, and no work
//   BySlip   a law of the slip's speed, path and direction (dynamics/slip_law.hpp); all samples of a pool have laws of one shape, and
//            every lane its own constants
#pragma once

#include <array>

#include "base/pack.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/outside.hpp"
#include "dynamics/pack/power.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"
#include "dynamics/slip_law.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct NoFactor {
  static constexpr bool varies = false;
  template <class Expand>
  void expand(Expand&& expand) {
    expand(*this);
  }
};

// F of the first N + 1 coefficients of the speed. Constants: value(i) and shift(i) of node i, exponential(x), and of the slip the path
// until now and the direction. sigma: sigma w is positive.
template <int N, class Real, class Constants>
class SlipFactor : Polynomials<Real> {
 public:
  static constexpr bool varies = true;
  SlipFactor(const SlipLaw& law, const Constants& constants, const Real& sigma)
      : law_(law), constants_(constants), sigma_(sigma) {}

  // Calls expand(factor) with what gives the coefficients of F while those of the speed are found.
  template <class Expand>
  [[gnu::always_inline]] void expand(Expand&& expand) {
    if (law_.fades) {
      Fading fading{constants_, at_[law_.place()]};
      expand(fading);
    } else {
      expand(*this);
    }
  }

  // to_speed w: coefficient k of |w| [m/s]; those before k were given.
  [[gnu::always_inline]] void advance(int k, const Real& to_speed, const Real& w) {
    at_[slip_speed_place][k] = to_speed * w;
    if (law_.sees_path) {
      Real* path = at_[slip_path_place];
      if (k == 0) path[0] = constants_.path();
      if (k < N) path[k + 1] = sigma_ * w * Real(1.0 / (k + 1));
    }
    if (law_.sees_direction) at_[slip_direction_place][k] = k == 0 ? constants_.direction() : Real(0.0);
    for (int i = 0; i < law_.count; ++i) {
      const Node& node = law_.nodes[i];
      const Real *x = at_[node.a], *y = at_[node.b];
      Real* z = at_[slip_places + i];
      switch (node.op) {
        case Op::constant:
          z[k] = k == 0 ? constants_.value(i) : Real(0.0);
          break;
        case Op::affine:
          z[k] = constants_.value(i) * x[k];
          if (k == 0) z[k] = z[k] + constants_.shift(i);
          break;
        case Op::add:
          z[k] = x[k] + y[k];
          break;
        case Op::subtract:
          z[k] = x[k] - y[k];
          break;
        case Op::multiply:
          z[k] = convolution(x, y, k);
          break;
        case Op::divide:
          z[k] = quotient(x, y, z, k);
          break;
        default:
          z[k] = k == 0 ? constants_.exponential(x[0]) : exponential(x, z, k);
      }
    }
  }

  const Real (&factor() const)[N + 1] { return at_[law_.place()]; }
  Real first() const { return factor()[0]; }
  Real first_rate() const { return factor()[1]; }
  Real last() const { return this->sum(factor()); }
  Real at(const Real& x) const { return Polynomials<Real>::at(factor(), x); }
  Real rate_at(const Real& x) const { return Polynomials<Real>::rate_at(factor(), x); }
  Real last_rate() const { return this->rate_sum(factor()); }

 private:
  // F = p + e, e = q exp(r |w| + s), e' = r |w|' e.
  class Fading {
   public:
    static constexpr bool varies = true;
    Fading(const Constants& constants, Real* out) : constants_(constants), out_(out) {}

    [[gnu::always_inline]] void advance(int k, const Real& to_speed, const Real& w) {
      if (k == 0) {
        const Real rate = constants_.value(0);
        rate_ = rate * to_speed;
        start_ = constants_.value(2) * constants_.exponential(rate * (to_speed * w) + constants_.shift(0));
        fall_ = rate_ * start_;
        factor_[0] = start_ + constants_.shift(2);
      } else {
        factor_[k] = fall_ * w;
        if (k > 1) factor_[k] = sum(k) * Real(1.0 / k) + factor_[k];
        change_[k] = Real(double(k)) * (rate_ * w);
      }
      out_[k] = factor_[k];
    }
    const Real* factor() const { return factor_; }

   private:
    [[gnu::always_inline]] Real sum(int k) const {
      Real sum = change_[1] * factor_[k - 1];
#pragma GCC unroll 16
      for (int i = 2; i < k; ++i) sum = sum + change_[i] * factor_[k - i];
      return sum;
    }

    const Constants& constants_;
    Real* out_;
    Real rate_, start_, fall_, factor_[N + 1], change_[N + 1];
  };

  [[gnu::always_inline]] static Real quotient(const Real* x, const Real* y, const Real* z, int k) {
    Real sum = x[k];
#pragma GCC unroll 16
    for (int i = 1; i <= k; ++i) sum = sum - y[i] * z[k - i];
    return sum / y[0];
  }
  [[gnu::always_inline]] static Real exponential(const Real* x, const Real* z, int k) {
    if (k == 1) return x[1] * z[0];
    Real sum = Real(double(k - 1)) * x[k - 1] * z[1];
#pragma GCC unroll 16
    for (int i = k - 2; i > 0; --i) sum = sum + Real(double(i)) * x[i] * z[k - i];
    return (sum + Real(double(k)) * x[k] * z[0]) * Real(1.0 / k);
  }

  const SlipLaw& law_;
  const Constants constants_;
  const Real sigma_;
  Real at_[slip_places + slip_law_nodes][N + 1];
};

// Of one sample.
struct OwnConstants {
  const SlipLaw& law;
  double slid;
  int way;
  double path() const { return slid; }
  double direction() const { return way; }
  double value(int i) const { return law.nodes[i].value; }
  double shift(int i) const { return law.nodes[i].shift; }
  static double exponential(double x) { return exp_outside(x); }
};
template <int N>
using OwnFactor = SlipFactor<N, double, OwnConstants>;

struct Coulomb {
  static constexpr bool by_slip = false;
  static Pack neglected(const Pack&) { return Pack(FREESTAND_ISA::neglected); }

  struct Rows {
    void enter(int, const BatchCase&, double, int) {}
    void slid(int, const PackMask&, const Pack&) {}
    static Pack to_speed(int, const Pack&, const Pack&) { return Pack(0.0); }
    void copy(int, const Rows&, int) {}
  };
  template <int N>
  struct Factor : NoFactor {
    Factor(const Rows&, int, const Pack&) {}
    static Pack first() { return Pack(1.0); }
    static Pack last() { return Pack(1.0); }
    static Pack at(const Pack&) { return Pack(1.0); }
    static Pack rate_at(const Pack&) { return Pack(0.0); }
    static Pack first_rate() { return Pack(0.0); }
    static Pack last_rate() { return Pack(0.0); }
  };
};

struct BySlip {
  static constexpr bool by_slip = true;
  static Pack neglected(const Pack& left) { return Pack(neglected_by_laws) * left; }

  struct Rows {
    const SlipLaw* law = nullptr;
    alignas(64) double value[slip_law_nodes][march_slots] = {}, shift[slip_law_nodes][march_slots] = {};
    alignas(64) double per_step[march_slots] = {};  // 1/h
    alignas(64) double path[march_slots] = {}, direction[march_slots] = {};

    void enter(int i, const BatchCase& c, double slid, int way) {
      law = c.law;
      path[i] = slid;
      direction[i] = way;
      for (int n = 0; n < law->count; ++n) {
        value[n][i] = law->nodes[n].value;
        shift[n][i] = law->nodes[n].shift;
      }
      per_step[i] = c.table->rate_hz;
    }
    // What makes the slip of a step |w|; left: its part of an interval.
    Pack to_speed(int i, const Pack& sigma, const Pack& left) const { return sigma * load(per_step + i) / left; }
    // Those lanes have slid on by so much.
    void slid(int i, const PackMask& which, const Pack& more) {
      if (law->sees_path) store_where(which, path + i, load(path + i) + more);
    }
    void copy(int to, const Rows& other, int from) {
      law = other.law;
      for (int n = 0; n < law->count; ++n) {
        value[n][to] = other.value[n][from];
        shift[n][to] = other.shift[n][from];
      }
      per_step[to] = other.per_step[from];
      path[to] = other.path[from];
      direction[to] = other.direction[from];
    }
  };
  struct Constants {
    const Rows& rows;
    int lane;
    Pack value(int i) const { return load(rows.value[i] + lane); }
    Pack shift(int i) const { return load(rows.shift[i] + lane); }
    Pack path() const { return load(rows.path + lane); }
    Pack direction() const { return load(rows.direction + lane); }
    static Pack exponential(const Pack& x) { return exponential_of(x); }
  };
  template <int N>
  struct Factor : SlipFactor<N, Pack, Constants> {
    Factor(const Rows& rows, int lane, const Pack& sigma)
        : SlipFactor<N, Pack, Constants>(*rows.law, {rows, lane}, sigma) {}
  };
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
