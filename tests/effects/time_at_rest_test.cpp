// Laws that look at the time for which the contact has stood still.
#include <cmath>

#include "effects/effect_fixture.hpp"
#include "formula/formula.hpp"

namespace freestand::test {
namespace {

const dynamics::Effect& healing() {
  static const dynamics::Effect law = formula::effect("healing", "mu*(1 + a*log(1 + rest/c))", "", {"a", "c_s"});
  return law;
}
EffectUse healing(double a, double c) { return {&healing(), {a, c}}; }

// When j t reaches mu g (1 + a ln(1 + t/c)), by bisection.
double slip_starts(double mu, double j, double a, double c) {
  double low = mu * g / j, high = 3 * low;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.5 * (low + high);
    (j * t < mu * g * (1 + a * std::log1p(t / c)) ? low : high) = t;
  }
  return low;
}

// On a ramp a = j t the slip starts at the root t0 of j t = mu g (1 + a ln(1 + t/c)); from then on w' = j t - mu g, as friction has
// forgotten the rest: after s seconds w = (j t0 - mu g) s + j s^2/2.
TEST(TimeAtRest, SlipStartsWhereTheRampMeetsTheGripThatHasGrown) {
  const double mu = 0.2, j = 5, a = 0.15, c = 0.05, start = slip_starts(mu, j, a, c);
  const FloorMotion ramp = piecewise_linear("ramp", 1.0, {0, -j, 0});
  for (const Solver& solver : both_solvers) {
    const Path found = run(solver, sliding(mu, {healing(a, c)}), {&ramp});
    const double s = 0.9 - start;
    ASSERT_GT(s, 0.1);
    EXPECT_NEAR(found.points.at(900).slip_velocity_mps, (j * start - mu * g) * s + j * s * s / 2, 1e-9) << solver.name;
    EXPECT_EQ(found.points.at(static_cast<std::size_t>(start * 1000) - 1).mode, Mode::rest);
  }
}

// Two equal pushes, one soon after the other: the slip that lies between them begins the time anew, so that the second push moves a
// block that the first one, after a long rest, did not. Static friction that does not heal makes no such difference.
TEST(TimeAtRest, ASlipBeginsItAnew) {
  const double mu = 0.2, a = 0.2, c = 0.05;
  const auto held = [&](double t) { return mu * g * (1 + a * std::log1p(t / c)); };
  // Knots each 0.1 s: a push that the long rest just holds, one that it does not, and the first once more 0.3 s after the slip.
  const double push = 0.97 * held(3);
  ASSERT_GT(push, held(0.4));
  std::vector<double> floor(50, 0.0);
  floor[31] = push;
  FloorMotion once = piecewise_linear("once", 0.1, floor);
  floor[35] = 2 * held(4);
  floor[39] = push;
  FloorMotion thrice = piecewise_linear("thrice", 0.1, floor);
  floor[39] = 0;
  FloorMotion twice = piecewise_linear("twice", 0.1, floor);
  for (const Solver& solver : both_solvers) {
    const Specimen block = sliding(mu, {healing(a, c)});
    EXPECT_EQ(run(solver, block, {&once}).response.outcome, Outcome::at_rest) << solver.name;
    const double two = run(solver, block, {&twice}).response.slid_path_m;
    const double three = run(solver, block, {&thrice}).response.slid_path_m;
    EXPECT_GT(two, 1e-3) << solver.name;
    EXPECT_GT(three, two + 1e-4) << solver.name;
  }
}

// Random blocks on random floors: samples of a pack are those that go alone, and those of the reference.
TEST(TimeAtRest, InPacksAndAloneTheSame) {
  CaseFamily family;
  family.seed = 77;
  family.one_model = 0;
  family.alpha_high = 0.6;
  family.mu_high = 0.5;
  int mattered = 0;
  std::vector<RandomCase> cases;
  for (std::uint64_t number = 0; number < 64; ++number) {
    cases.push_back(random_case(family, number));
    cases.back().specimen.model = number % 2 ? Model::slide : Model::slide_rock;
  }
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (RandomCase& c : cases) {
    const Response plain = respond(c.specimen, c.shaking);
    c.specimen.effects = {healing(0.25, 0.05)};
    specimens.push_back(c.specimen);
    shakings.push_back(c.shaking);
    mattered += distance(plain, respond(c.specimen, c.shaking)) > 1e-6;
  }
  std::vector<Response> together(cases.size());
  respond_batch(specimens, shakings, {}, together);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Response alone = respond(specimens[i], shakings[i]);
    const double apart = distance(alone, together[i]);
    EXPECT_TRUE(apart < 1e-8 || moved_by(1e-9, specimens[i], shakings[i], {}, alone) >= apart)
        << cases[i].text() << " apart " << apart;
    const double other = distance(alone, respond_reference(specimens[i], shakings[i]));
    EXPECT_TRUE(other < 1e-6 || moved_by(1e-8, specimens[i], shakings[i], {}, alone) >= other)
        << cases[i].text() << " the reference is apart " << other;
  }
  EXPECT_GT(mattered, 20);
}

}  // namespace
}  // namespace freestand::test
