// One sample of slide-rock while it slides flat, under a law of friction or pulled by a spring and a drag too.
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
  bool slides() const { return mode_ == Mode::slide && (c_.law || pulled_) && in_packs(); }

  // F above which the slip tips the block over the corner ahead.
  double tipping_factor() const { return magnitude(arm(sigma_)) / (c_.mu_k * c_.h); }

  template <class Gravity, class Friction>
  void enter(FlatRows<Gravity, Friction>& r, int i) const {
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
    if constexpr (Gravity::pulls) enter_pull(r.shakes, i, 1);
  }
  template <class Gravity, class Friction>
  void leave(const FlatRows<Gravity, Friction>& r, int i) {
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
    if (c_.law) {
      OwnFactor<slide_order> factor(*c_.law, {*c_.law, path_, sigma_}, sigma_);
      NoPull none;
      slide_by(factor, none);
    } else if (pulled_) {
      NoFactor none;
      Pull<slide_order, double> pull(c_.stiffness, c_.drag / (h_ * fraction_), 0.0, 0.0, xi_);
      slide_by(none, pull);
    } else {
      slide_exactly();
    }
  }

 private:
  enum class Ends { none, stops, tips };

  template <class Factor, class Pull>
  void slide_by(Factor& factor, Pull& pull) {
    constexpr int N = slide_order;
    const double hs = h_ * fraction_, hs2 = hs * hs, a1 = next_floor();
    FlatSeries<N> y;
    y.xi[0] = xi_;
    y.w[0] = w_ * hs;
    y.slide(sigma_ * c_.mu_k * c_.g * hs2, a_ * hs2, (a1 - a_) * hs2, sigma_ / hs, factor, pull, hs2);

    double x = valid_part(0, y.w[N + 1], N + 1, true), p[N + 2];
    if (x == 0) return decline();
    if constexpr (Factor::varies)
      if (!(factor.first() >= 0)) return decline();
    Ends ends = Ends::none;
    for (int k = 0; k < N + 2; ++k) p[k] = sigma_ * y.w[k];
    if (p[0] == 0 && p[1] < 0 && p[1] > -slip_zero * c_.g * hs2) p[1] = 0;
    if (const double stops = first_fall<N + 1>(p, x); stops <= x) x = stops, ends = Ends::stops;
    if constexpr (Factor::varies) {
      for (int k = 0; k <= N; ++k) p[k] = (k == 0 ? tipping_factor() : 0.0) - factor.factor()[k];
      if (const double tips = first_fall<N>(p, x); tips < x) x = tips, ends = Ends::tips;
    }

    feel_force(factor, pull, x);
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
  template <class Factor, class Pull>
  void feel_force(const Factor& factor, const Pull& pull, double x) {
    constexpr int N = slide_order;
    const double push = c_.mu_k * c_.g;
    const auto force = [&](double at) {
      double value = push;
      if constexpr (Factor::varies) value *= evaluate<N>(factor.factor(), at);
      if constexpr (Pull::pulls) value += sigma_ * evaluate<N>(pull.terms(), at);
      return value;
    };
    feel(force(0), c_.g);
    feel(force(x), c_.g);
    double rate[N];
    for (int k = 0; k < N; ++k) {
      if constexpr (Factor::varies)
        rate[k] = (k + 1) * factor.factor()[k + 1];
      else
        rate[k] = (k + 1) * pull.terms()[k + 1];
    }
    if (rate[0] * evaluate<N - 1>(rate, x) < 0) feel(force(sign_change<N - 1>(rate, x)), c_.g);
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
