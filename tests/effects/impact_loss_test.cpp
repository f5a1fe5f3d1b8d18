// Law: an impact keeps c times Housner's rate.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(ImpactLoss, General) {
  expect_general({"impact_loss", {0.9}, {0.9}, {1}, {Model::rock, Model::slide_rock}, 60, 4});
}

// Free rocking of the hinged block: (theta'/p)^2/2 + cos(alpha - |theta|) is kept between impacts, so that successive
// peaks obey  cos(alpha - peak2) - cos(alpha) = (c e)^2 [cos(alpha - peak1) - cos(alpha)], e = 1 - 1.5 sin^2(alpha).
TEST(ImpactLoss, SuccessivePeaksFallByItsSquare) {
  const double c = 0.9, alpha = std::atan(0.4 / 1.8), e = 1 - 1.5 * std::pow(std::sin(alpha), 2);
  const FloorMotion push = staircase({0.2, 8}, {-4, 0});
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, slender(1, {effect("impact_loss", {c})}, Model::rock), {&push});
    std::vector<double> peaks;  // after the push, one for each swing
    double most = 0, sign = 0;
    for (const auto& p : r.points) {
      if (p.rotation_rad * sign < 0) peaks.push_back(most), most = 0;
      if (p.rotation_rad != 0) sign = p.rotation_rad;
      most = std::fmax(most, std::abs(p.rotation_rad));
    }
    ASSERT_GE(peaks.size(), 4u);
    for (std::size_t i = 1; i < 3; ++i) {
      const auto depth = [&](double peak) { return std::cos(alpha - peak) - std::cos(alpha); };
      EXPECT_NEAR(depth(peaks[i + 1]) / depth(peaks[i]), c * e * c * e, 2e-5) << solver.name;
    }
  }
}

}  // namespace
}  // namespace freestand::test
