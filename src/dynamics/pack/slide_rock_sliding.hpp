// One sample of slide-rock while it slides flat under a law of friction.
#pragma once

#include <cmath>

#include "dynamics/pack/flat_series.hpp"
#include "dynamics/pack/friction.hpp"
#include "dynamics/pack/slide_rock_trajectory.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int slide_order = 8;

class SlideRockSliding : public SlideRockTrajectory {
 public:
  using SlideRockTrajectory::enter;
  using SlideRockTrajectory::leave;
  bool slides() const { return mode_ == Mode::slide && c_.law && in_packs(); }

  // F above which the slip tips the block over the corner ahead.
  double tipping_factor() const { return magnitude(arm(sigma_)) / (c_.mu_k * c_.h); }

  template <class Friction>
  void enter(FlatRows<Friction>& r, int i) const {
    const double h2 = h_ * h_;
    r.xi[i] = xi_;
    r.w[i] = w_ * h_;
    enter_floor(r, i);
    r.weight[i] = c_.scale * h2;
    r.weight_g[i] = c_.g * h2;
    r.size[i] = c_.h;
    r.friction[i] = sigma_ * c_.mu_k;
    r.sigma[i] = sigma_;
    r.tips[i] = tipping_factor();
    r.peak[i] = peak_slip_;
    r.seen[i] = force2_ * (h2 * h2);
    r.law.enter(i, c_, path_, sigma_);
  }
  template <class Friction>
  void leave(const FlatRows<Friction>& r, int i) {
    peak_slip_ = larger(peak_slip_, r.peak[i]);
    force2_ = larger(force2_, r.seen[i] / (h_ * h_ * h_ * h_));
    const bool moved = leave_floor(r, i);
    in_between_ = false;
    if (!moved) return;
    slid(r.xi[i] - xi_);
    xi_ = r.xi[i];
    w_ = r.w[i] / h_;
  }

 protected:
  using SlideRockTrajectory::SlideRockTrajectory;

  void slide() {
    if (c_.law)
      slide_by_law();
    else
      slide_exactly();
  }

 private:
  enum class Ends { none, stops, tips };

  void slide_by_law() {
    constexpr int N = slide_order;
    const double hs = h_ * fraction_, hs2 = hs * hs, a1 = next_floor();
    FlatSeries<N> y;
    OwnFactor<N> factor(*c_.law, {*c_.law, path_, sigma_}, sigma_);
    y.xi[0] = xi_;
    y.w[0] = w_ * hs;
    y.slide(sigma_ * c_.mu_k * c_.g * hs2, a_ * hs2, (a1 - a_) * hs2, sigma_ / hs, factor);

    double x = valid_part(0, y.w[N + 1], N + 1, true), p[N + 2];
    if (x == 0 || !(factor.first() >= 0)) return decline();
    Ends ends = Ends::none;
    for (int k = 0; k < N + 2; ++k) p[k] = sigma_ * y.w[k];
    if (p[0] == 0 && p[1] < 0 && p[1] > -slip_zero * c_.g * hs2) p[1] = 0;
    if (const double stops = first_fall<N + 1>(p, x); stops <= x) x = stops, ends = Ends::stops;
    for (int k = 0; k <= N; ++k) p[k] = (k == 0 ? tipping_factor() : 0.0) - factor.factor()[k];
    if (const double tips = first_fall<N>(p, x); tips < x) x = tips, ends = Ends::tips;

    feel_friction(factor, x);
    const double xi = evaluate<N + 1>(y.xi, x);
    slid(xi - xi_);
    xi_ = xi;
    w_ = ends == Ends::stops ? 0.0 : evaluate<N + 1>(y.w, x) / hs;
    see_slip(xi_);
    forward(x);
    if (ends == Ends::none) return;
    event();
    if (ends == Ends::stops) return choose_flat();
    const int way = sigma_;
    stand(Mode::slide_rock, way);
    sigma_ = way;
  }

  // Its extremes are at the ends, or where it turns.
  void feel_friction(const OwnFactor<slide_order>& factor, double x) {
    constexpr int N = slide_order;
    const double push = c_.mu_k * c_.g;
    feel(push * factor.factor()[0], c_.g);
    feel(push * evaluate<N>(factor.factor(), x), c_.g);
    double rate[N];
    for (int k = 0; k < N; ++k) rate[k] = (k + 1) * factor.factor()[k + 1];
    if (rate[0] * evaluate<N - 1>(rate, x) < 0)
      feel(push * evaluate<N>(factor.factor(), sign_change<N - 1>(rate, x)), c_.g);
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
