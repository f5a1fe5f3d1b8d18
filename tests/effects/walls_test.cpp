// The wall: either edge of the side face, on both sides, in contact and in flight, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/chain.hpp"
#include "dynamics/laws_by_hand.hpp"
#include "effects/effect_fixture.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

FREESTAND_ON_BOTH_SOLVERS(Wall);

EffectUse wall(double gap, double restitution = 0) { return effect("wall_impact", {gap, restitution}); }

// Distance from the floor's origin to the point of the side face that is farthest to that side, of a block as in the history.
double farthest(const Specimen& specimen, const HistoryPoint& at, int side) {
  const Block& b = specimen.block;
  const double theta = at.rotation_rad, base = b.base_m(), top = 2 * b.height_m;
  // From the middle of the base, which is at slip_m: the base's corner on that side, and the edge over it.
  const double corner = side * at.slip_m + 0.5 * base * std::cos(theta) - 0.5 * base;
  return std::max(corner, corner + side * top * std::sin(theta));
}

// However a block is shaken, no part of it gets through walls on both sides; with gaps of 0 it does not move at all.
TEST_P(Wall, NothingGetsThrough) {
  int hits = 0, flights = 0, rocked = 0;
  for (std::uint64_t number = 0; number < 30; ++number) {
    CaseFamily family;
    family.seed = 91;
    family.alpha_low = 0.12;
    family.alpha_high = 0.5;
    family.one_model = 0;
    family.vertical = 0.7;
    family.vertical_peak_g = 2;
    family.duration_low_s = 3;
    family.duration_high_s = 4;
    RandomCase c = random_case(family, number);
    c.specimen.model = Model::slide_rock;
    const double right = 0.01 * static_cast<double>(number % 5), left = 0.02 * static_cast<double>(number % 3);
    auto shake = effect("vertical_shaking", {1});
    c.specimen.effects = {wall(right > 0 ? right : 0.0, 0.3), shake};
    if (left > 0) c.specimen.effects.push_back(wall(-left, 0.0));
    History history;
    history.step_s = 0.002;
    Settings settings;
    settings.free_vibration_s = 2;
    const Response r = GetParam()(c.specimen, c.shaking, settings, &history);
    EXPECT_NE(r.outcome, Outcome::not_finite) << c.text();
    EXPECT_NE(r.outcome, Outcome::step_limit) << c.text();
    hits += r.wall_hits;
    rocked += r.peak_rotation_rad > 0.01;
    for (const HistoryPoint& at : history.points) {
      ASSERT_LE(farthest(c.specimen, at, 1), right + 1e-7) << number << ' ' << at.time_s << ' ' << c.text();
      if (left > 0) {
        ASSERT_LE(farthest(c.specimen, at, -1), left + 1e-7) << number << ' ' << at.time_s << ' ' << c.text();
      }
      flights += at.mode == Mode::flight;
    }
  }
  EXPECT_GT(hits, 30);
  EXPECT_GT(flights, 30);
  EXPECT_GT(rocked, 5);
}

// A block that tips towards a wall ends leaning on it, upper edge at the gap: it does not overturn. With friction that holds
// it stays, sin(theta) = gap/H.
TEST_P(Wall, ABlockThatTipsLeansOnIt) {
  const double gap = 0.5;
  const FloorMotion push = rectangular_pulse(-6, 0.4);
  const Specimen free = slender(1.2);
  ASSERT_EQ(GetParam()(free, {&push}).outcome, Outcome::overturned);
  for (const double e : {0.0, 0.1}) {
    const Path r = run(GetParam(), slender(1.2, {wall(gap, e)}), {&push}, 20);
    EXPECT_EQ(r.response.outcome, Outcome::moved) << e;
    EXPECT_GT(r.response.residual_rotation_rad, 0.2187) << e;  // beyond alpha, where nothing but a wall holds it
    HistoryPoint end{};
    end.slip_m = r.response.residual_slip_m;
    end.rotation_rad = r.response.residual_rotation_rad;
    EXPECT_NEAR(farthest(slender(1.2), end, 1), gap, 1e-9) << e;
    EXPECT_GE(r.response.wall_hits, 1);
  }
}

// A leaning block whose friction vanishes is a ladder on ice: its foot slides away, its upper edge down the wall, energy kept.
// At the start it is at rest: v^2 of the centre of mass and k^2 omega^2 come from its fall.
TEST_P(Wall, ALadderOnIceKeepsItsEnergy) {
  const double melts_s = 12;
  const double gap = 0.5;
  const Specimen ladder =
      slender(1.2, {wall(gap), friction_law([=](const dynamics::At& at) { return dynamics::step(melts_s - at.t); })});
  const FloorMotion push = rectangular_pulse(-6, 0.4);
  const Path r = run(GetParam(), ladder, {&push}, 20);
  const Block& b = ladder.block;
  const auto energy = [&](const HistoryPoint& at) {
    const double s = std::sin(at.rotation_rad), c = std::cos(at.rotation_rad), w = at.rotation_rate_radps;
    const double x = at.slip_velocity_mps + b.height_m * c * w, y = (b.right_m * c - b.height_m * s) * w;
    return 0.5 * (x * x + y * y + b.gyration2_m2 * w * w) + g * (b.right_m * s + b.height_m * c);
  };
  double least = 1e9, most = -1e9;
  int leaning = 0;
  for (const HistoryPoint& at : r.points) {
    const bool at_the_wall =
        at.time_s > melts_s && at.mode == Mode::slide_rock && std::abs(farthest(ladder, at, 1) - gap) < 1e-8;
    if (!at_the_wall) continue;
    ++leaning;
    least = std::min(least, energy(at));
    most = std::max(most, energy(at));
  }
  ASSERT_GT(leaning, 10);
  EXPECT_NEAR(most, least, 1e-7 * most);
}

// In the air the wall throws back the edge that meets it; the centre of mass and the rotation share the push.
TEST_P(Wall, ThrowsBackWhatFlies) {
  const FloorMotion falls = staircase({0.5, 1.0}, {-2.0, 0.0}, {-2 * g, 0.0});
  const double gap = 0.05;
  Specimen block = sliding(0.3, {wall(gap, 0.5), effect("vertical_shaking", {1})});
  block.model = Model::slide_rock;
  History history;
  history.step_s = 0.001;
  Settings settings;
  settings.tolerance = 1e-12;
  settings.free_vibration_s = 1;
  const Response r = GetParam()(block, Shaking{&falls, 1, 1, 1}, settings, &history);
  EXPECT_GE(r.wall_hits, 1);
  const double hit = std::sqrt(2 * gap / 2.0);  // x = t^2 from the start
  EXPECT_NEAR(r.wall_speed_mps, 2.0 * hit, 1e-9);
  for (const HistoryPoint& at : history.points) ASSERT_LE(at.slip_m, gap + 1e-9) << at.time_s;
  const auto after = history.points.at(static_cast<std::size_t>(1000 * hit) + 2);
  EXPECT_EQ(after.mode, Mode::flight);
  EXPECT_NEAR(after.slip_velocity_mps, -0.5 * 2.0 * hit + 2.0 * (after.time_s - hit), 1e-9);
}

// At gap 0 the lower edge of a block that rocks away from the wall comes back to it just as the base comes down, without speed:
// the block keeps its rotation, and its upper edge strikes at H times Housner's rate.
TEST_P(Wall, AtGapZeroABlockThatComesDownKeepsItsRotation) {
  const FloorMotion push = staircase({0.15, 0.5}, {4, 0});
  Specimen block = slender(1.2, {wall(0.0, 0.3)});
  block.impact = {ImpactLaw::housner, 1};
  Specimen free = block;
  free.effects.clear();
  History history;
  history.step_s = 0.001;
  GetParam()(free, {&push}, {}, &history);
  const auto down = std::find_if(history.events.begin(), history.events.end(), [](const Event& e) { return e.impact; });
  ASSERT_NE(down, history.events.end());
  const auto after = std::find_if(history.points.begin(), history.points.end(),
                                  [&](const HistoryPoint& at) { return at.time_s > down->time_s; });
  const Response r = GetParam()(block, {&push});
  EXPECT_GE(r.wall_hits, 1);
  EXPECT_NEAR(r.wall_speed_mps, 2 * block.block.height_m * after->rotation_rate_radps, 0.01 * r.wall_speed_mps);
}

// Beside a wall nothing but the weight holds a block on the floor: where the floor falls away it hangs in the air, and friction
// pushes it nowhere.
TEST_P(Wall, NothingPushesABlockThatTheFloorLeaves) {
  // The smallest push decides nothing, at whatever instant the weight has gone.
  for (const double a : {0.0, 2e-5, -2e-5}) {
    FloorMotion falls;
    falls.degree = 1;
    falls.knot_s = {0.0, 0.1, 0.2, 0.3, 0.4};
    falls.horizontal_mps2 = {a, 0, a, 0, a, 0, a, 0};
    falls.vertical_mps2 = {0, -8 * g, -0.8 * g, -4 * g, -1.2 * g, 4 * g, -0.8 * g, 8 * g};
    const Specimen block = slender(0.4, {wall(0.0, 0.3), effect("vertical_shaking", {1})});
    History history;
    history.step_s = 0.001;
    GetParam()(block, Shaking{&falls, 1, 1, 1}, {}, &history);
    EXPECT_EQ(history.points.at(200).mode, Mode::flight);
    for (std::size_t i = 0; i <= 200; ++i) {
      EXPECT_LT(std::abs(history.points[i].slip_m), 1e-6) << a << ' ' << i;
      EXPECT_LT(std::abs(history.points[i].rotation_rad), 1e-6) << a << ' ' << i;
    }
  }
}

// A wall at gap 0 is a wall.
TEST_P(Wall, AtGapZeroHolds) {
  const FloorMotion push = staircase({0.3, 0.5}, {-6, 0});
  const Path held = run(GetParam(), sliding(0.2, {wall(0.0)}), {&push});
  EXPECT_EQ(held.response.peak_slip_m, 0);
  const FloorMotion pull = staircase({0.3, 0.5}, {6, 0});
  const Path free = run(GetParam(), sliding(0.2), {&pull}), away = run(GetParam(), sliding(0.2, {wall(0.0)}), {&pull});
  EXPECT_NEAR(away.response.peak_slip_m, free.response.peak_slip_m, 1e-12);
}

// Thrown up beside it, without a push at first: what begins to push the block at the wall while it flies leaves it where it is.
TEST_P(Wall, HoldsWhatIsPushedAtItInFlight) {
  const FloorMotion falls = staircase({0.3, 1.0}, {0, 0}, {-2 * g, 0});
  const EffectUse push = force_law([](const dynamics::At& at) { return 10 * positive(at.t - 0.1); });
  for (Specimen block : {sliding(0.2, {wall(0.0), push}), slender(0.2, {wall(0.0), push})}) {
    block.effects.push_back(effect("vertical_shaking", {1}));
    const Path held = run(GetParam(), block, {&falls}, 2);
    EXPECT_EQ(held.response.outcome, Outcome::moved);
    EXPECT_NEAR(held.response.peak_slip_m, 0, 1e-12);
    EXPECT_NEAR(held.response.peak_rotation_rad, 0, 1e-12);
    EXPECT_TRUE(std::ranges::any_of(
        held.points, [](const HistoryPoint& at) { return at.mode == Mode::flight && at.time_s > 0.15; }));
  }
}

// Blows are told, with the speed at which the block comes.
TEST_P(Wall, TellsItsBlows) {
  const double v = 0.45;
  const FloorMotion push = staircase({0.05, 1}, {-v / 0.05, 0});
  const Response r = run(GetParam(), sliding(0, {wall(0.1, 0.0)}), {&push}).response;
  EXPECT_EQ(r.wall_hits, 1);
  EXPECT_NEAR(r.wall_speed_mps, v, 1e-9);
  EXPECT_EQ(r.impacts, 0);
}

// A block on a chain that holds neither falls away from the wall nor through it.
TEST_P(Wall, AChainedBlockDoesNotFallThroughTheWallBehind) {
  int free_falls = 0, held_falls = 0;
  for (std::uint64_t number = 0; number < 20; ++number) {
    CaseFamily family;
    family.seed = 17;
    family.one_model = family.vertical = family.asymmetric = 0;
    family.duration_low_s = 3;
    family.duration_high_s = 4;
    family.excess_low = 2;
    family.excess_high = 4;
    RandomCase c = random_case(family, number);
    c.specimen = {Block::rectangular(0.6, 1.8, 200), {0.5, 0.5}, {}, Model::slide_rock};
    free_falls += GetParam()(c.specimen, c.shaking, {}, nullptr).outcome == Outcome::overturned;
    c.specimen.effects = {dynamics::use(
        {.slack_m = 0.02, .stiffness_npm = 4e5, .strength_n = 1e9, .height_m = 1.8, .side = 1, .wall_gap_m = 0.05},
        c.specimen.block)};
    History history;
    history.step_s = 0.005;
    const Response held = GetParam()(c.specimen, c.shaking, {}, &history);
    EXPECT_TRUE(held.outcome <= Outcome::overturned) << name(held.outcome) << ' ' << c.text();
    held_falls += held.outcome == Outcome::overturned;
    for (const HistoryPoint& at : history.points) {
      ASSERT_LE(farthest(c.specimen, at, -1), 0.05 + 1e-7) << number << ' ' << at.time_s << ' ' << c.text();
    }
  }
  EXPECT_GE(free_falls, 5);
  EXPECT_LE(held_falls, free_falls / 4);  // its base may be drawn from under it
}

// In packs the upper edge stands where it does alone, of a block whose centre of mass is not in the middle of its height too.
TEST(Walls, PacksKnowHowHighTheUpperEdgeStands) {
  CaseFamily family;
  family.seed = 171;
  family.one_model = family.vertical = family.asymmetric = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 4;
  family.excess_low = 1.5;
  std::vector<RandomCase> cases;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (std::uint64_t i = 0; i < 60; ++i) {
    cases.push_back(random_case(family, i));
    Specimen specimen = cases.back().specimen;
    const double height = 2 * specimen.block.height_m;
    specimen.block = Block::of_outline(specimen.block.base_m(), height, 100, 0.35 * height, std::nullopt);
    specimen.friction = {2, 2};
    specimen.model = Model::slide_rock;
    specimen.effects = {wall(0.02 + 0.001 * static_cast<double>(i), 0.5)};
    specimens.push_back(specimen);
    shakings.push_back(cases.back().shaking);
  }
  std::vector<Response> together(specimens.size());
  respond_batch(specimens, shakings, {}, together);
  int struck = 0;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Response alone = respond(specimens[i], shakings[i]);
    EXPECT_EQ(together[i].wall_hits, alone.wall_hits) << i;
    EXPECT_EQ(together[i].peak_rotation_rad, alone.peak_rotation_rad) << i;
    struck += alone.wall_hits > 0 && alone.impacts > 1;
  }
  EXPECT_GT(struck, 10);
}

// A block that is all but upright beside a wall, thrown between wall and floor ever more slowly, has an answer.
TEST(Walls, BlocksThatSettleBesideOneHaveAnAnswer) {
  CaseFamily family;
  family.seed = 97;
  family.one_model = 0;
  family.duration_low_s = 5;
  family.duration_high_s = 8;
  int struck = 0;
  for (std::uint64_t i = 0; i < 1500; ++i) {
    RandomCase c = random_case(family, i);
    KeyedRandom random(98, i);
    c.specimen.model = Model::slide_rock;
    const double gap = random.uniform(-0.06, 0.06);
    c.specimen.effects = {wall(gap, random.uniform(0, 0.8))};
    const Response response = respond(c.specimen, c.shaking);
    struck += response.wall_hits > 0;
    EXPECT_NE(response.outcome, Outcome::painleve) << i << ' ' << c.text();
  }
  EXPECT_GT(struck, 300);
}

}  // namespace
}  // namespace freestand::test
