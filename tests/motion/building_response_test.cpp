// Floors of buildings against calculations that share nothing with them: closed forms, time steps and frequencies of the full
// matrices without modes, energy, limits.
#include "motion/building_response.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <freestand/error.hpp>

#include "base/random.hpp"
#include "base/units.hpp"
#include "motion/fourier.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "motion/record.hpp"
#include "support/data.hpp"

namespace freestand::motion {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<double> rough_samples(std::size_t count, double step_s, std::uint64_t seed) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = step_s * static_cast<double>(i), whole = step_s * static_cast<double>(count);
    const double envelope = std::sin(pi * t / whole);
    samples.push_back(4 * envelope * (std::sin(9 * t) + random::uniform(seed, i, 1) - random::uniform(seed, i, 2)));
  }
  return samples;
}

// n equal storeys with Rayleigh's damping at the first two modes, as matrices from closed forms alone.
struct Matrices {
  MatrixXd mass, damping, stiffness;

  Matrices(int n, double period_s, double ratio) {
    const auto w = [&](int j) { return std::sin((2 * j - 1) * pi / (2.0 * (2 * n + 1))); };
    const double scale = 2 * pi / period_s / w(1), first = 2 * pi / period_s, second = scale * w(2);
    const double k = scale * scale / 4;
    mass = MatrixXd::Identity(n, n);
    stiffness = MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      stiffness(i, i) = i + 1 < n ? 2 * k : k;
      if (i > 0) stiffness(i, i - 1) = stiffness(i - 1, i) = -k;
    }
    damping = 2 * ratio / (first + second) * (first * second * mass + stiffness);
  }
};

Building building_of(int n, double period_s, double ratio) {
  Building building;
  building.storeys.resize(static_cast<std::size_t>(n));
  building.period_s = period_s;
  building.damping = ratio;
  building.rayleigh_modes = {1, 2};
  return building;
}

// Runge-Kutta of order 4 on M u'' + C u' + K u = -M 1 a, so many steps between samples; absolute accelerations at the samples.
std::vector<VectorXd> by_time_steps(const Matrices& b, const std::vector<double>& ground, double step_s, int steps) {
  const Eigen::Index n = b.mass.rows();
  VectorXd u = VectorXd::Zero(n), v = u;
  const double h = step_s / steps;
  const auto pull = [&](double a, const VectorXd& x, const VectorXd& y) {
    return VectorXd(-VectorXd::Constant(n, a) - b.mass.llt().solve(b.damping * y + b.stiffness * x));
  };
  std::vector<VectorXd> absolute{VectorXd::Zero(n)};
  for (std::size_t i = 0; i + 1 < ground.size(); ++i) {
    for (int s = 0; s < steps; ++s) {
      const auto a = [&](double part) { return ground[i] + (ground[i + 1] - ground[i]) * (s + part) / steps; };
      const VectorXd k1 = pull(a(0), u, v), k2 = pull(a(0.5), u + h / 2 * v, v + h / 2 * k1),
                     k3 = pull(a(0.5), u + h / 2 * (v + h / 2 * k1), v + h / 2 * k2),
                     k4 = pull(a(1), u + h * (v + h / 2 * k2), v + h * k3);
      u += h * v + h * h / 6 * (k1 + k2 + k3);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    absolute.push_back(-(b.mass.llt().solve(b.damping * v + b.stiffness * u)));
  }
  return absolute;
}

double at(const FloorMotion& motion, double t) { return horizontal_acceleration({&motion, 1.0, 1.0, 0.0}, t); }

// Under a(t) = s t from rest: q = -(s/w^2) (t - 2 z/w) + exp(-z w t) (A cos + B sin).
TEST(BuildingResponse, OneStoreyUnderARampIsTheOscillatorInClosedForm) {
  const double slope = 3, step = 0.05;
  std::vector<double> ramp;
  for (int i = 0; i < 60; ++i) ramp.push_back(slope * step * i);
  const FloorMotion ground = piecewise_linear("ramp", step, ramp);
  Building building = building_of(1, 0.4, 0.07);
  building.rayleigh_modes.reset();
  const FloorMotion floor = BuildingResponse(ground, modes(building)).floor(1, "floor");
  const double w = 2 * pi / 0.4, z = 0.07, wd = w * std::sqrt(1 - z * z);
  const double a = -2 * z * slope / (w * w * w), b = (slope / (w * w) + z * w * a) / wd;
  for (std::size_t i = 0; i < floor.knot_s.size() && floor.knot_s[i] < ground.duration_s() - 1e-9; ++i) {
    const double t = floor.knot_s[i], fall = std::exp(-z * w * t), c = std::cos(wd * t), s = std::sin(wd * t);
    const double q = -slope / (w * w) * (t - 2 * z / w) + fall * (a * c + b * s);
    const double v = -slope / (w * w) + fall * ((wd * b - z * w * a) * c - (wd * a + z * w * b) * s);
    EXPECT_NEAR(floor.horizontal_mps2[2 * i], -(2 * z * w * v + w * w * q), 1e-11) << t;
  }
}

TEST(BuildingResponse, FloorsAreThoseOfTheFullMatricesInTime) {
  const double step = 0.02;
  const std::vector<double> samples = rough_samples(400, step, 5);
  const FloorMotion ground = piecewise_linear("rough", step, samples);
  for (const int n : {2, 5}) {
    const auto expected = by_time_steps(Matrices(n, 0.6, 0.05), samples, step, 40);
    BuildingResponse response(ground, modes(building_of(n, 0.6, 0.05)));
    for (int f = 1; f <= n; ++f) {
      const FloorMotion floor = response.floor(f, "floor");
      for (std::size_t i = 0; i < samples.size(); ++i)
        ASSERT_NEAR(at(floor, ground.knot_s[i]), expected[i][f - 1], 2e-6) << n << " " << f << " " << i;
    }
  }
}

// The record, a line from sample to sample, has the spectrum dt sinc^2 times that of its samples; the floors' follows by
// (K - w^2 M + i w C) u = -M 1 a. Padded until nothing is left to wrap round.
std::vector<double> by_frequencies(const Matrices& b, const FloorMotion& ground, int floor, int parts) {
  const double step = ground.knot_s[1];
  const std::size_t knots = ground.knot_s.size(), n = transform_size(4 * knots),
                    fine = n * static_cast<std::size_t>(parts);
  std::vector<double> samples;
  for (std::size_t i = 0; i < knots; ++i) samples.push_back(at(ground, ground.knot_s[i]));
  const RealTransform::Spectrum coarse = RealTransform(n).forward(samples);
  RealTransform::Spectrum spectrum(fine / 2 + 1);
  const Eigen::Index size = b.mass.rows();
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const double w = 2 * pi * static_cast<double>(k) / (static_cast<double>(n) * step), x = w * step / 2;
    const double hat = k == 0 ? 1 : std::pow(std::sin(x) / x, 2);
    const std::size_t wrapped = k % n;
    const std::complex<double> a = parts * hat * (wrapped <= n / 2 ? coarse[wrapped] : std::conj(coarse[n - wrapped]));
    const Eigen::MatrixXcd z = (b.stiffness - w * w * b.mass).cast<std::complex<double>>() +
                               std::complex<double>(0, w) * b.damping.cast<std::complex<double>>();
    const Eigen::VectorXcd u =
        z.partialPivLu().solve(-a * (b.mass * VectorXd::Ones(size)).cast<std::complex<double>>());
    spectrum[k] = a - w * w * u[floor - 1];
  }
  return RealTransform(fine).inverse(spectrum);
}

TEST(BuildingResponse, FloorsOfARealRecordAreThoseOfTheFrequencies) {
  FREESTAND_NEEDS_RECORDS();
  const FloorMotion ground = read_record(test::records_dir() / "peer_ngawest2_triples" / "RSN1633_MANJIL_ABBAR--L.AT2");
  const FloorMotion floor = BuildingResponse(ground, modes(building_of(3, 0.5, 0.05)), 1e-4).floor(3, "roof");
  const int parts = 8;
  const std::vector<double> expected = by_frequencies(Matrices(3, 0.5, 0.05), ground, 3, parts);
  const double step = ground.knot_s[1] / parts, peak = peaks(floor).pga_mps2;
  double worst = 0;
  for (std::size_t i = 0; i * step < ground.duration_s(); ++i)
    worst = std::max(worst, std::abs(at(floor, static_cast<double>(i) * step) - expected[i]));
  EXPECT_LT(worst, 5e-4 * peak);  // lines 1e-4; frequencies above eight times Nyquist's the rest
  EXPECT_GT(peak, 1.5 * peaks(ground).pga_mps2);
}

TEST(BuildingResponse, AStiffBuildingMovesAsTheGround) {
  const double step = 0.02;
  const std::vector<double> samples = rough_samples(300, step, 8);
  const FloorMotion ground = piecewise_linear("rough", step, samples);
  const double slope = 2 * 8 / step;  // no faster
  for (const double period : {1e-4, 1e-6}) {
    const FloorMotion floor = BuildingResponse(ground, modes(building_of(3, period, 0.05))).floor(3, "floor");
    // A mode rings by no more than the change of slope over its frequency.
    for (std::size_t i = 0; i < samples.size(); ++i)
      ASSERT_NEAR(at(floor, ground.knot_s[i]), samples[i], 10 * slope * period / (2 * pi)) << period;
  }
}

// A slow push is followed by every floor: the static limit. The lag is 2 z a'/w.
TEST(BuildingResponse, SlowGroundIsFollowed) {
  std::vector<double> samples;
  for (int i = 0; i <= 4000; ++i) samples.push_back(std::pow(std::sin(pi * i / 4000.0), 2));
  const FloorMotion ground = piecewise_linear("slow", 0.05, samples);  // 200 s
  const FloorMotion floor = BuildingResponse(ground, modes(building_of(4, 0.5, 0.05))).floor(4, "floor");
  for (double t = 0; t < 200; t += 0.37) ASSERT_NEAR(at(floor, t), at(ground, t), 1e-3) << t;
}

// What the ground puts in is the energy of motion and strain and what the dampers took: int V v_g dt = T + S + int v' C v dt, with
// velocities and displacements from the floors' accelerations alone.
TEST(BuildingResponse, EnergyBalances) {
  const double step = 0.02, fine = step / 64;
  const FloorMotion ground = piecewise_linear("rough", step, rough_samples(300, step, 3));
  const Matrices b(3, 0.7, 0.04);
  BuildingResponse response(ground, modes(building_of(3, 0.7, 0.04)), 1e-6);
  std::vector<FloorMotion> motions{ground};
  for (int f = 1; f <= 3; ++f) motions.push_back(response.floor(f, "floor"));
  Eigen::Vector4d a = Eigen::Vector4d::Zero(), v = a, u = a;  // of the ground and the floors, absolute
  double put_in = 0, taken = 0, most = 0, worst = 0;
  const VectorXd one = VectorXd::Ones(3);
  const auto power_in = [&] { return a.tail(3).sum() * v[0]; };
  const auto power_out = [&] {
    const VectorXd rate = v.tail(3) - v[0] * one;
    return rate.dot(b.damping * rate);
  };
  for (std::size_t i = 1; i <= 64 * 300; ++i) {
    const double before_in = power_in(), before_out = power_out();
    Eigen::Vector4d next;
    for (Eigen::Index m = 0; m < 4; ++m)
      next[m] = at(motions[static_cast<std::size_t>(m)], static_cast<double>(i) * fine - 1e-12);
    u += v * fine + (2 * a + next) * fine * fine / 6;
    v += (a + next) * fine / 2;
    a = next;
    put_in += (before_in + power_in()) * fine / 2;
    taken += (before_out + power_out()) * fine / 2;
    const VectorXd strain = u.tail(3) - u[0] * one;
    most = std::max(most, put_in);
    worst =
        std::max(worst, std::abs(put_in - taken - v.tail(3).squaredNorm() / 2 - strain.dot(b.stiffness * strain) / 2));
  }
  EXPECT_LT(worst, 2e-4 * most);
  EXPECT_GT(most, 0.1);
}

TEST(BuildingResponse, ScalesTurnsAndEndsAtRest) {
  const double step = 0.02;
  std::vector<double> samples = rough_samples(250, step, 4), turned;
  for (const double a : samples) turned.push_back(-2 * a);
  const FloorMotion ground = piecewise_linear("rough", step, samples), other = piecewise_linear("turned", step, turned);
  const auto found = modes(building_of(4, 0.9, 0.03));
  const FloorMotion floor = BuildingResponse(ground, found).floor(2, "a"),
                    mirror = BuildingResponse(other, found).floor(2, "b");
  ASSERT_EQ(floor.knot_s.size(), mirror.knot_s.size());
  for (std::size_t i = 0; i < floor.horizontal_mps2.size(); ++i)
    ASSERT_EQ(-2 * floor.horizontal_mps2[i], mirror.horizontal_mps2[i]);
  EXPECT_GT(floor.duration_s(), ground.duration_s() + 5);
  const double peak = peaks(floor).pga_mps2;
  double last = 0;
  for (double t = floor.duration_s() - 0.9; t < floor.duration_s(); t += 0.01)
    last = std::max(last, std::abs(at(floor, t)));
  EXPECT_LT(last, 2 * usual_straightness * peak);
  EXPECT_GT(last, 1e-5 * peak);  // no longer than needed
}

TEST(BuildingResponse, LinesBetweenSamplesAreAsCloseAsStated) {
  const double step = 0.02;
  const FloorMotion ground = piecewise_linear("rough", step, rough_samples(250, step, 6));
  BuildingResponse usual(ground, modes(building_of(6, 0.3, 0.02))),
      close(ground, modes(building_of(6, 0.3, 0.02)), 1e-7);
  for (const int f : {1, 3, 6}) {
    const FloorMotion floor = usual.floor(f, "floor"), exact = close.floor(f, "exact");
    EXPECT_GT(exact.knot_s.size(), 4 * floor.knot_s.size());
    const double peak = peaks(exact).pga_mps2;
    double off = 0;
    for (double t = 0; t < ground.duration_s(); t += 0.000371)
      off = std::max(off, std::abs(at(floor, t) - at(exact, t)));
    EXPECT_LT(off, 1.5 * usual_straightness * peak) << f;  // midpoints bound a parabola, not every bend
    EXPECT_NEAR(peaks(floor).pga_mps2, peak, usual_straightness * peak) << f;
  }
}

TEST(BuildingResponse, VerticalMotionIsTheGrounds) {
  const FloorMotion ground = piecewise_linear("rough", 0.02, rough_samples(100, 0.02, 1), rough_samples(100, 0.02, 2));
  const FloorMotion floor = BuildingResponse(ground, modes(building_of(3, 0.3, 0.05))).floor(2, "floor");
  for (double t = 0.0003; t < ground.duration_s(); t += 0.0137)
    EXPECT_NEAR(vertical_acceleration({&floor, 1, 1, 1}, t), vertical_acceleration({&ground, 1, 1, 1}, t), 1e-12);
}

TEST(BuildingResponse, FloorZeroIsTheGround) {
  const FloorMotion ground = piecewise_linear("rough", 0.02, rough_samples(100, 0.02, 1));
  const FloorMotion floor = BuildingResponse(ground, modes(building_of(3, 0.3, 0.05))).floor(0, "same");
  EXPECT_EQ(floor.horizontal_mps2, ground.horizontal_mps2);
  EXPECT_EQ(floor.name, "same");
}

TEST(BuildingResponse, WhatCannotBeIsRefused) {
  const FloorMotion ground = piecewise_linear("rough", 0.02, rough_samples(500, 0.02, 1));
  const auto refusal = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto three = modes(building_of(3, 0.3, 0.05));
  EXPECT_NE(refusal([&] { BuildingResponse(ground, three).floor(4, ""); }).find("floor 4 is none of the building"),
            std::string::npos);
  EXPECT_NE(refusal([&] { BuildingResponse(ground, three).floor(-1, ""); }).find("floor -1"), std::string::npos);
  const FloorMotion pulse = pulse_motion(find_pulse("B"));
  EXPECT_NE(refusal([&] { BuildingResponse(pulse, three); }).find("no record"), std::string::npos);
  EXPECT_NE(refusal([&] { BuildingResponse(ground, modes(building_of(2, 9, 0.0005))); }).find("give more damping"),
            std::string::npos);
  EXPECT_EQ(outside_the_band(ground, three), "");
  EXPECT_NE(outside_the_band(ground, modes(building_of(3, 0.039, 0.05))).find("the record's band"), std::string::npos);
  EXPECT_EQ(outside_the_band(ground, modes(building_of(3, 0.041, 0.05))), "");
  EXPECT_NE(outside_the_band(ground, modes(building_of(2, 30, 0.05))).find("from 0.04 to 9.98"), std::string::npos);
  EXPECT_EQ(outside_the_band(ground, modes(building_of(2, 20, 0.05))), "");  // its second mode, 7.6 s
}

}  // namespace
}  // namespace freestand::motion
