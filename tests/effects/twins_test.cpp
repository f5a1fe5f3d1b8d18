// Pairs of effects that are one equation, or tend to one, on some data: by calculation, and what parts them.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

// Both ways, several strengths, twelve half cycles.
FloorMotion to_and_fro() {
  std::vector<double> a, v;
  for (int i = 0; i <= 1200; ++i) {
    const double t = 0.005 * i;
    a.push_back(std::sin(pi * t / 6) * 6 * std::sin(2 * pi * t) + 1.5 * std::sin(2 * pi * 0.37 * t));
    v.push_back(3 * std::sin(2 * pi * 1.7 * t));
  }
  return piecewise_linear("to and fro", 0.005, a, v);
}

double apart(const Specimen& a, const Specimen& b, const FloorMotion& motion) {
  const Path p = run(fast_solver, a, {&motion}), q = run(fast_solver, b, {&motion});
  double most = 0;
  for (std::size_t i = 0; i < std::min(p.points.size(), q.points.size()); ++i)
    most = std::max({most, std::abs(p.points[i].slip_m - q.points[i].slip_m),
                     std::abs(p.points[i].rotation_rad - q.points[i].rotation_rad)});
  return most;
}

constexpr double noise_m = 3e-4;  // of a good sensor

struct Tilt {
  double mu = 0.3, beta = 0.03;
  Specimen tilted(Specimen s) const { return s.effects.push_back(effect("floor_tilt", {beta})), s; }
  // u'' = -a - g sin(beta) - sigma mu g cos(beta) is u'' = -a - sigma mu' (1 + d sigma) g with these.
  double mu_alike() const { return mu * std::cos(beta); }
  double asymmetry() const { return std::tan(beta) / mu; }
  Specimen lopsided(Specimen s) const { return s.effects.push_back(effect("directional_friction", {asymmetry()})), s; }
};

TEST(Twins, FloorTiltIsDirectionalFrictionForABlockThatOnlySlides) {
  const Tilt t;
  const FloorMotion motion = to_and_fro();
  EXPECT_GT(run(fast_solver, t.tilted(sliding(t.mu)), {&motion}).response.peak_slip_m, 0.05);
  EXPECT_LT(apart(t.tilted(sliding(t.mu)), t.lopsided(sliding(t.mu_alike())), motion), 1e-9);
}

TEST(Twins, FloorTiltAndDirectionalFrictionArePartedByAnotherMuRockingAVerticalChannelOrStaticFriction) {
  const Tilt t;
  const FloorMotion motion = to_and_fro();
  const double other = 0.6;
  EXPECT_GT(apart(t.tilted(sliding(other * t.mu)), t.lopsided(sliding(other * t.mu_alike())), motion), 10 * noise_m);
  EXPECT_GT(apart(t.tilted(slender(0.6)), t.lopsided(slender(0.6)), motion), 10 * noise_m);
  const auto shaken = [](Specimen s) { return s.effects.push_back(effect("vertical_shaking", {1})), s; };
  EXPECT_GT(apart(shaken(t.tilted(sliding(t.mu))), shaken(t.lopsided(sliding(t.mu_alike()))), motion), 10 * noise_m);
  // A tilt shifts the limits of sticking by g sin(beta), the direction's share of mu_s by mu_s/mu_k times that.
  const auto sticky = [](Specimen s) { return s.effects.push_back(effect("static_friction", {1.8})), s; };
  EXPECT_GT(apart(sticky(t.tilted(sliding(t.mu))), sticky(t.lopsided(sliding(t.mu_alike()))), motion), 10 * noise_m);
}

// mu (1 - d (1 - exp(-w/c))) is mu at rest and mu (1 - d) as soon as w >> c.
TEST(Twins, RateWeakeningTendsToStaticFrictionAsItsSpeedVanishes) {
  const double mu = 0.4, drop = 0.3;
  const FloorMotion motion = to_and_fro();
  const Specimen sticky = sliding(mu * (1 - drop), {effect("static_friction", {1 / (1 - drop)})});
  const auto gap = [&](double c) { return apart(sliding(mu, {effect("rate_weakening", {drop, c})}), sticky, motion); };
  EXPECT_LT(gap(1e-5), noise_m);
  EXPECT_LT(gap(1e-5), 0.2 * gap(1e-4));
  EXPECT_GT(gap(0.05), 10 * noise_m);
}

// mu g d (1 - exp(-w/c)) -> (mu g d/c) w for w << c.
TEST(Twins, RateStrengtheningTendsToViscousDragAsItsSpeedGrows) {
  const double mu = 0.2, rate = 0.8;
  const FloorMotion motion = to_and_fro();
  const Specimen drag = sliding(mu, {effect("viscous_drag", {rate})});
  const auto gap = [&](double c) {
    return apart(sliding(mu, {effect("rate_strengthening", {rate * c / (mu * g), c})}), drag, motion);
  };
  EXPECT_NEAR(gap(4) / gap(8), 2, 0.4);
  EXPECT_LT(gap(24), 0.5 * gap(8));
  EXPECT_GT(gap(0.5), 10 * noise_m);
}

// A stiff tether without a dashpot gives back the speed with which it is run into, after half a swing of 1/(2 f).
TEST(Twins, WallTendsToStiffTether) {
  const double gap_m = 0.03;
  const FloorMotion motion = to_and_fro();
  const Specimen wall = sliding(0.2, {effect("wall_impact", {gap_m, 1})});
  const auto difference = [&](double f) {
    return apart(sliding(0.2, {effect("slack_tether", {gap_m, f, 0})}), wall, motion);
  };
  EXPECT_GT(difference(2), 10 * noise_m);
  EXPECT_LT(difference(300), 0.1 * difference(2));
}

// A block that is pushed one way only cannot tell a spring from a tether without slack.
TEST(Twins, SpringIsATetherWhereSlipsGoOneWay) {
  const FloorMotion push = staircase({0.2, 0.5, 1.0}, {-6, 2, 0});
  const double f = 0.8;
  EXPECT_LT(apart(sliding(0.3, {effect("centering_spring", {f})}), sliding(0.3, {effect("slack_tether", {1e-7, f, 0})}),
                  push),
            1e-6);
  const FloorMotion motion = to_and_fro();
  EXPECT_GT(apart(sliding(0.3, {effect("centering_spring", {f})}), sliding(0.3, {effect("slack_tether", {1e-7, f, 0})}),
                  motion),
            10 * noise_m);
}

}  // namespace
}  // namespace freestand::test
