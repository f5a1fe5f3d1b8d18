#include "database/interpolate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "database/made_database.hpp"

namespace freestand::database {
namespace {

// Whatever is known, a mean of it lies within it, and its band about it in order.
TEST(Interpolate, BlendsStayWithinWhatIsKnownAndBandsInOrder) {
  std::mt19937 draw(1);
  std::uniform_real_distribution<double> uniform;
  for (int repeat = 0; repeat < 20000; ++repeat) {
    std::array<Probability, 4> known;
    std::array<double, 4> weights{};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      // None, all, and everything between, as counts of 50 samples give it.
      const double p = std::floor(50 * uniform(draw) * (repeat % 3 ? 1 : 0.1)) / 50;
      known[i] = {p, p * uniform(draw), p + (1 - p) * uniform(draw), 0.5 / 51};
      sum += weights[i] = uniform(draw);
    }
    for (double& weight : weights) weight /= sum;
    const Probability p = blend(known, weights);
    EXPECT_LE(p.lower, p.value);
    EXPECT_LE(p.value, p.upper);
    double least = 1, most = 0;
    for (const Probability& one : known) {
      least = std::min(least, one.value);
      most = std::max(most, one.value);
    }
    // Up to the resolution, which a share of none or of all is drawn in to.
    EXPECT_GE(p.value, least - 1e-12);
    EXPECT_LE(p.value, std::max(most, 0.5 / 51) + 1e-12);
  }
}

TEST(Interpolate, NoneStaysNone) {
  const std::array known{Probability{0, 0, 0.004, 0.005}, Probability{0, 0, 0.002, 0.005}};
  const Probability p = blend(known, std::array{0.25, 0.75});
  EXPECT_EQ(p.value, 0);
  EXPECT_EQ(p.lower, 0);
  EXPECT_DOUBLE_EQ(p.upper, 0.0025);
  const std::array wide{Probability{0, 0, 0.1, 0.005}, Probability{0, 0, 0.1, 0.005}};
  EXPECT_EQ(blend(wide, std::array{0.25, 0.75}).value, 0);
  // Where one of them may be 0, or 1, so may what lies between.
  const std::array open{Probability{0.3, 0.25, 0.35, 0.01}, Probability{0, 0, 0.05, 0.01}};
  EXPECT_EQ(blend(open, std::array{0.5, 0.5}).lower, 0);
  EXPECT_GT(blend(open, std::array{1.0, 0.0}).lower, 0.2);
  const std::array full{Probability{0.7, 0.65, 0.75, 0.01}, Probability{1, 0.95, 1, 0.01}};
  EXPECT_EQ(blend(full, std::array{0.5, 0.5}).upper, 1);
  EXPECT_NEAR(blend(wide, std::array{0.25, 0.75}).upper, 0.1, 1e-12);
}

// Where the change begins between an entry in which it never happened and one in which it did, neither tells: the answer goes by neither's number
// of samples, and its band holds both.
TEST(Interpolate, BetweenNoneAndSomeTheBandHoldsBoth) {
  double before = 0;
  for (const double resolution : {1e-3, 1e-5}) {
    const std::array known{Probability{0, 0, 0.004, resolution}, Probability{0.58, 0.49, 0.66, resolution}};
    const Probability p = blend(known, std::array{0.44, 0.56});
    EXPECT_NEAR(p.value, 0.56 * 0.58, 1e-12);
    EXPECT_EQ(p.value, before > 0 ? before : p.value);
    before = p.value;
    EXPECT_EQ(p.lower, 0);
    EXPECT_GE(p.upper, 0.66);
  }
}

// Beyond the last entry the band is no narrower than that of the nearest one.
TEST(Interpolate, ExtrapolationIsNoSurer) {
  const std::array known{Probability{0.3, 0.2, 0.4, 1e-3}, Probability{0.6, 0.5, 0.7, 1e-3}};
  const Probability p = blend(known, std::array{-0.3, 1.3});
  EXPECT_GT(p.upper - p.lower, 0.2);
  EXPECT_LT(p.lower, p.value);
  EXPECT_GT(p.upper, p.value);
  // Nor does it go by the number of samples of one in which nothing happened.
  for (const double resolution : {1e-3, 1e-5}) {
    const std::array none{Probability{0, 0, 0.004, resolution}, Probability{0.58, 0.49, 0.66, resolution}};
    EXPECT_NEAR(blend(none, std::array{-0.3, 1.3}).value, 1.3 * 0.58, 1e-12);
  }
}

double between_two(const Curve& a, const Curve& b, double t, double im) {
  return between(std::array{&a, &b}, std::array{1 - t, t}, im).value;
}

TEST(Interpolate, BetweenLognormalsIsALognormal) {
  const Curve a = test::curve(0, 0.05, 0.3, 0.3), b = test::curve(1, 0.05, 0.7, 0.6);
  for (const double t : {0.25, 0.8, -0.2, 1.3})
    for (const double im : {0.02, 0.1, 0.4, 0.9, 3.0})
      EXPECT_NEAR(between_two(a, b, t, im),
                  test::lognormal(im, std::pow(0.3, 1 - t) * std::pow(0.7, t), (1 - t) * 0.3 + t * 0.6), 1e-9)
          << t << " " << im;
}

// Blocks that slide by the pulse alone begin to exceed at one intensity each.
Curve leap(double im) {
  Curve curve = test::curve(0, 0.05, 0.4, 0.5);
  curve.family = points_family;
  curve.points = {{0.5 * im, 0, 0, 0.01, 100},
                  {0.99 * im, 0, 0, 0.01, 100},
                  {1.01 * im, 1, 0.99, 1, 100},
                  {8 * im, 1, 0.99, 1, 100}};
  return curve;
}

TEST(Interpolate, BetweenNoneAndAllTheChangeLiesBetween) {
  const Curve a = leap(0.2), b = leap(0.8);
  for (const double t : {0.5, 0.25, 1.3}) {
    const double there = 0.2 * std::pow(4, t);
    EXPECT_NEAR(between_two(a, b, t, 0.98 * there), 0, 1e-9) << t;
    EXPECT_NEAR(between_two(a, b, t, 1.02 * there), 1, 1e-9) << t;
  }
}

// Of racks of two widths the wider one never falls in its sweep: at which intensity one between them does neither tells.
TEST(Interpolate, BetweenOneThatNeverExceedsAndOneThatDoesTheBandHoldsBoth) {
  Curve falls = leap(0.2), stays = leap(0.8);
  for (Point& point : stays.points) point.probability = point.lower = 0, point.upper = 0.01;
  for (Point& point : falls.points)
    if (point.probability > 0) point.probability = 0.8, point.lower = 0.7, point.upper = 0.9;
  const std::array<const Curve*, 2> both{&falls, &stays};
  const Probability p = between(both, std::array{0.5, 0.5}, 0.4);
  EXPECT_TRUE(p.none_tells);
  EXPECT_EQ(p.lower, 0);
  EXPECT_GE(p.upper, 0.9);
  const Probability before = between(both, std::array{0.5, 0.5}, 0.15);
  EXPECT_FALSE(before.none_tells);
  EXPECT_LT(before.upper, 0.05);
}

// Counted curves of lognormal friction, by the formula for a rectangular pulse: between two medians of it the answer is the formula's, wherever
// either has come to 1, and nowhere falls.
TEST(Interpolate, BetweenFrictionsACurveIsTheFormulasAndRises) {
  const auto exceeds = [](double im, double mu) {  // slip of 0.1 m
    double sum = 0;
    for (int i = 0; i < 2000; ++i) {
      const double m = mu * std::exp(0.3 * gsl_cdf_ugaussian_Pinv((i + 0.5) / 2000));
      sum += im > m && (im - m) * 9.81 * 0.125 * im / m > 0.1;
    }
    return sum / 2000;
  };
  const auto counted = [&](double mu) {
    Curve curve = test::curve(0, 0.05, 0.4, 0.5);
    curve.family = points_family;
    curve.points.clear();
    for (double im = 0.09; im < 1; im += 0.05) {
      const double p = exceeds(im, mu);
      curve.points.push_back({im, p, std::max(0.0, p - 0.03), std::min(1.0, p + 0.03), 340});
    }
    return curve;
  };
  const Curve low = counted(0.15), high = counted(0.3);
  for (const double mu : {0.2, 0.25, 0.33}) {
    const double t = std::log(mu / 0.15) / std::log(2);
    double before = 0;
    for (double im = 0.1; im < 0.9; im += 0.02) {
      const double p = between_two(low, high, t, im);
      EXPECT_GE(p, before - 1e-9) << mu << " " << im;
      EXPECT_NEAR(p, exceeds(im, mu), 0.03) << mu << " " << im;
      before = p;
    }
  }
}

// One that was swept to where a half of it exceeds tells nothing of how the rest comes: the other one does, and outside of both nothing.
TEST(Interpolate, AboveWhatAllReachItGoesOnRising) {
  const Curve whole = test::curve(0, 0.05, 0.3, 0.3);
  Curve cut = test::curve(1, 0.05, 0.9, 0.5);
  cut.family = points_family;
  cut.points.clear();
  for (double im = 0.1; im < 0.95; im += 0.1) {
    const double p = test::lognormal(im, 0.9, 0.5);
    cut.points.push_back({im, p, p - 0.5 * p * (1 - p), p + 0.5 * p * (1 - p), 1000});
  }
  const std::array<const Curve*, 2> both{&whole, &cut};
  double before = 0;
  for (double im = 0.3; im < 1.2; im += 0.02) {
    const Probability p = between(both, std::array{0.5, 0.5}, im);
    const double whole_of_both = test::lognormal(im, std::sqrt(0.27), 0.4);
    EXPECT_GE(p.value, before - 1e-12) << im;
    EXPECT_NEAR(p.value, whole_of_both, im < 0.5 ? 0.03 : 0.15) << im;
    before = p.value;
  }
  EXPECT_EQ(between(both, std::array{-0.3, 1.3}, 3.0).upper, 1);
}

// Outside of the entries whatever is taken off: a share between 0 and 1 in its band, and no less at a larger intensity, unless the curve that is
// taken off is so flat that the answer would fall: of lognormals that is known.
TEST(Interpolate, ExtrapolatedCurvesRiseAndLieInTheirBands) {
  std::mt19937 draw(2);
  std::uniform_real_distribution<double> uniform;
  for (int repeat = 0; repeat < 30; ++repeat) {
    std::array<Curve, 2> made;
    for (Curve& curve : made) {
      curve = test::curve(0, 0.05, 0.2 + uniform(draw), 0.2 + 0.5 * uniform(draw));
      if (repeat % 3 == 0) continue;
      curve.family = points_family;
      for (Point& point : curve.points) {
        point.probability = std::round(point.probability * 50 + uniform(draw) - 0.5) / 50;
        point.lower = std::max(0.0, point.probability - 0.1);
        point.upper = std::min(1.0, point.probability + 0.1);
      }
    }
    const std::array<const Curve*, 2> curves{&made[0], &made[1]};
    for (const double t : {-0.5, 0.3, 1.5}) {
      double before = 0;
      for (double im = 0.05; im < 3; im *= 1.1) {
        const Probability p = between(curves, std::array{1 - t, t}, im);
        EXPECT_LE(p.lower, p.value);
        EXPECT_LE(p.value, p.upper);
        if (p.lower == 0 && p.upper == 1) continue;  // it would fall
        EXPECT_GE(p.value, before - 1e-9) << repeat << " " << t << " " << im;
        before = p.value;
      }
    }
  }
  // Of two that rise alike the band is as wide as theirs, and no wider than twice that.
  const Curve low = test::curve(0, 0.05, 0.3, 0.4), high = test::curve(1, 0.05, 0.6, 0.4);
  const std::array<const Curve*, 2> alike{&low, &high};
  for (double im = 0.5; im < 1.5; im *= 1.1) {
    const Probability p = between(alike, std::array{-0.3, 1.3}, im), own = at(high, im / std::pow(2, 0.3));
    EXPECT_GT(p.lower, own.value - 2.5 * (own.value - own.lower)) << im;
    EXPECT_LT(p.upper, own.value + 2.5 * (own.upper - own.value)) << im;
  }
  // Of two in which nothing ever exceeded nothing does.
  std::array<Curve, 2> none{leap(0.2), leap(0.4)};
  for (Curve& curve : none)
    for (Point& point : curve.points) point = {point.im, 0, 0, 0.004, 1000};
  const std::array<const Curve*, 2> nowhere{&none[0], &none[1]};
  for (const double t : {0.5, -0.1}) {
    EXPECT_EQ(between(nowhere, std::array{1 - t, t}, 0.5).value, 0);
    EXPECT_LT(between(nowhere, std::array{1 - t, t}, 0.5).upper, 0.01);
  }
  // The flat one of two is taken off.
  const Curve steep = test::curve(0, 0.05, 0.3, 0.1), flat = test::curve(1, 0.05, 0.6, 0.5);
  const std::array<const Curve*, 2> both{&steep, &flat};
  EXPECT_LT(between(both, std::array{1.5, -0.5}, 0.101).value, 1e-6);
  EXPECT_EQ(between(both, std::array{1.5, -0.5}, 0.101).upper, 1);
}

TEST(Interpolate, ALognormalGoesOnBeyondThePointsAndTakesItsBandAlong) {
  const Curve curve = test::curve(0, 0.05, 0.4, 0.5);
  for (const double im : {0.08, 0.13, 0.3, 1.7, 2.1}) {
    const Probability p = at(curve, im);
    EXPECT_NEAR(p.value, test::lognormal(im, 0.4, 0.5), 1e-12);
    EXPECT_LE(p.lower, p.value);
    EXPECT_LE(p.value, p.upper);
  }
  EXPECT_TRUE(outside(curve, 2.1));
  EXPECT_TRUE(outside(curve, 0.08));
  EXPECT_FALSE(outside(curve, 0.3));
}

// Between points that are far apart the curve is far from the straight line, and its band is where the curve is.
TEST(Interpolate, TheBandOfALognormalGoesAlongWithItBetweenThePoints) {
  Curve curve = test::curve(0, 0.05, 0.4, 0.2);
  const auto fitted = [](double im) { return test::lognormal(im, 0.4, 0.2); };
  curve.points = {{0.3, fitted(0.3), fitted(0.3) - 0.04, fitted(0.3) + 0.06, 100},
                  {0.9, fitted(0.9), fitted(0.9) - 0.02, 1, 100}};
  for (const double im : {0.31, 0.4, 0.5, 0.6}) {
    const Probability p = at(curve, im);
    const double part = (im - 0.3) / 0.6;
    EXPECT_NEAR(p.lower, fitted(im) - (1 - part) * 0.04 - part * 0.02, 1e-12) << im;
    EXPECT_NEAR(p.upper, std::min(fitted(im) + (1 - part) * 0.06 + part * (1 - fitted(0.9)), 1.0), 1e-12) << im;
  }
}

// A curve that rises within a bin from 0 to 1 has a share there that it does not go through. The band about the curve is as wide as
// the one about the share, to either side, and does not end at the curve.
TEST(Interpolate, TheBandOfALognormalIsAboutTheCurveAsThatOfAShareIsAboutTheShare) {
  Curve curve = test::curve(0, 0.05, 0.4, 0.2);
  const double share = 0.62;
  ASSERT_LT(test::lognormal(0.4, 0.4, 0.2), share - 0.1);
  curve.points = {{0.4, share, share - 0.03, share + 0.04, 1000}};
  const Probability p = at(curve, 0.4);
  EXPECT_NEAR(p.lower, p.value - 0.03, 1e-12);
  EXPECT_NEAR(p.upper, p.value + 0.04, 1e-12);
}

// As OpenQuake reads levels: straight over the intensity itself, from 0 at 0, level above the last.
TEST(Interpolate, WithoutAnAdequateLognormalLinesBetweenThePointsAreStraight) {
  for (const char* family : {points_family, not_refuted_family}) {
    Curve curve = test::curve(0, 0.05, 0.4, 0.5);
    curve.family = family;
    curve.points = {{0.2, 0.1, 0.06, 0.2, 100}, {0.6, 0.5, 0.4, 0.7, 100}};
    const auto expect = [&](double im, double value, double lower, double upper) {
      const Probability p = at(curve, im);
      EXPECT_NEAR(p.value, value, 1e-12);
      EXPECT_NEAR(p.lower, lower, 1e-12);
      EXPECT_NEAR(p.upper, upper, 1e-12);
    };
    expect(0.2, 0.1, 0.06, 0.2);
    expect(0.3, 0.2, 0.145, 0.325);
    expect(0.5, 0.4, 0.315, 0.575);
    expect(0.1, 0.05, 0.03, 0.2);
    expect(0.9, 0.5, 0.4, 0.7);
  }
}

// What stands still at weak shaking is no less likely at weaker shaking.
TEST(Interpolate, ACurveThatFallsFromItsFirstPointOnIsLevelBelowIt) {
  Curve curve = test::curve(0, 0.05, 0.4, 0.5);
  curve.family = points_family;
  curve.points = {{0.2, 0.98, 0.95, 1, 100}, {0.6, 0.4, 0.3, 0.5, 100}};
  const Probability p = at(curve, 0.1);
  EXPECT_NEAR(p.value, 0.98, 1e-12);
  EXPECT_NEAR(p.lower, 0.95, 1e-12);
  EXPECT_NEAR(p.upper, 1, 1e-12);
}

TEST(Interpolate, APointThatIsNotKnownIsPassedOver) {
  Curve curve = test::curve(0, 0.05, 0.4, 0.5);
  curve.family = points_family;
  curve.points[2].probability = unknown;  // between 0.2 and 0.8
  EXPECT_NEAR(at(curve, 0.4).value, (2 * curve.points[1].probability + curve.points[3].probability) / 3, 1e-12);
  curve.points.clear();
  EXPECT_TRUE(std::isnan(at(curve, 0.4).value));
}

}  // namespace
}  // namespace freestand::database
