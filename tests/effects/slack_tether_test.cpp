// Law: beyond slack a spring m W^2 and a dashpot m c, pulling only.
#include "effects/effect_fixture.hpp"
#include "support/same_bits.hpp"

namespace freestand::test {
namespace {

TEST(SlackTether, General) {
  expect_general({"slack_tether", {0.01, 2, 1}, {-0.01, 2, 1}, {0.01, 0, 0}, {Model::slide, Model::slide_rock}, 40, 4});
}

// On ice a block of speed v runs into the tether: half a swing of pi/W_d, reaching v/W exp(-(z/r) acos(z)) with
// r = sqrt(1 - z^2), c = 2 z W; the pull ends before the stretch does, when W^2 x + c x' = 0, at W_d t = 2 acos(z), with
// speed -v exp(-(z/r) 2 acos(z)).
TEST(SlackTether, CatchesABlockAsSpringAndDashpotDo) {
  const double slack = 0.05, f = 1.5, W = 2 * pi * f, z = 0.2, c = 2 * z * W, v = 0.4;
  const FloorMotion push = staircase({0.05, 1.5}, {-v / 0.05, 0});
  const double root = std::sqrt(1 - z * z), angle = std::acos(z);
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(0, {effect("slack_tether", {slack, f, c})}), {&push});
    double most = 0;
    for (const auto& p : r.points) most = std::fmax(most, p.slip_m);
    EXPECT_NEAR(most, slack + v / W * std::exp(-z / root * angle), 1e-6) << solver.name;
    EXPECT_NEAR(r.points.at(1200).slip_velocity_mps, -v * std::exp(-z / root * 2 * angle), 1e-9) << solver.name;
  }
}

// A wall that gives way: it turns a block that slides round within half a swing, 1/(2 f), and gives back that share of its speed. The stiffer it
// is, the more the answer is that of `wall_impact` with this share; what differs goes with the length of the contact.
TEST(SlackTether, IsAWallThatGivesWay) {
  const double gap = 0.03, z = 0.25, back = std::exp(-z / std::sqrt(1 - z * z) * 2 * std::acos(z));
  const FloorMotion push = staircase({0.1, 1}, {-6, 0});
  const Response rigid = respond(sliding(0.2, {effect("wall_impact", {gap, back})}), {&push});
  ASSERT_EQ(rigid.wall_hits, 1);
  double before = 0;
  for (const double f : {100.0, 200.0, 400.0, 800.0}) {
    const Response r = respond(sliding(0.2, {effect("slack_tether", {gap, f, 4 * pi * f * z})}), {&push});
    const double differs = std::abs(r.residual_slip_m - rigid.residual_slip_m);
    // The next term goes with the square of the length, some 3 ms over the 0.1 s in which the block comes to rest, halved each time.
    if (before > 0) {
      EXPECT_NEAR(differs / before, 0.5, 0.01) << f;
    }
    before = differs;
  }
  EXPECT_LT(before, 0.01 * std::abs(rigid.residual_slip_m));
}

TEST(SlackTether, DoesNothingOnTheOtherSide) {
  const FloorMotion push = rectangular_pulse(6, 0.3);
  const Response plain = respond(sliding(0.2), {&push});
  EXPECT_NEAR(respond(sliding(0.2, {effect("slack_tether", {0.01, 3, 1})}), {&push}).residual_slip_m,
              plain.residual_slip_m, 1e-12);
  EXPECT_LT(plain.residual_slip_m, -0.05);
}

// In blocks one that never reaches its tether is the block without it, to the bit; one that does, by however little, is answered as alone.
TEST(SlackTether, DoesNothingToABlockThatStaysWithinItsSlack) {
  CaseFamily family;
  family.one_model = family.vertical = 0;
  family.duration_low_s = 3, family.duration_high_s = 5;
  std::vector<RandomCase> cases;  // which own the motions
  std::vector<Specimen> plain;
  std::vector<Shaking> shakings;
  for (std::uint64_t i = 0; i < 40; ++i) {
    cases.push_back(random_case(family, i));
    plain.push_back(cases.back().specimen);
    shakings.push_back(cases.back().shaking);
  }
  std::vector<Response> without(plain.size()), with(plain.size());
  respond_batch(plain, shakings, {}, without);
  for (const double slack : {1.5, 1 + 1e-5, 1 + 1e-9, 1 - 1e-9, 1 - 1e-5, 0.5}) {
    std::vector<Specimen> tethered = plain;
    for (std::size_t i = 0; i < plain.size(); ++i)
      tethered[i].effects = {effect("slack_tether", {slack * without[i].peak_slip_m, 3, 1})};
    respond_batch(tethered, shakings, {}, with);
    int held = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (without[i].outcome == Outcome::overturned || without[i].peak_slip_m == 0) continue;
      if (slack > 1 + 1e-6) {
        EXPECT_TRUE(same_bits(with[i], without[i])) << slack << ' ' << cases[i].text();
        continue;
      }
      const Response alone = respond(tethered[i], shakings[i]);
      EXPECT_LE(distance(with[i], alone), 1e-7 + moved_by(1e-8, tethered[i], shakings[i], {}, alone))
          << slack << ' ' << cases[i].text();
      held += distance(with[i], without[i]) > 1e-4;
    }
    if (slack < 0.6) {
      EXPECT_GT(held, 5);
    }
  }
}

}  // namespace
}  // namespace freestand::test
