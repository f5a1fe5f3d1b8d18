// Blocks of samples in packs against the same samples one by one; and that a sample's answer is its own: to the bit the
// same in any order, in any company, with any instruction set.
//
// Stated tolerance against single samples: 1e-7 m and rad, 1e-6 of the peak acceleration, the same outcome.
// The hops of a row that dies out are counted as if the floor stood still: events may differ by 3 and a tenth. Samples that
// a change of the shaking by 1e-9 moves as far as packs and single ones are apart, or a tighter tolerance half as far (both are
// off by as much), are sensitive: counted, not compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <freestand/simulate.hpp>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "support/isa.hpp"
#include "support/keyed_random.hpp"
#include "support/random_cases.hpp"
#include "support/repeats.hpp"
#include "support/same_bits.hpp"
#include "support/slip_laws.hpp"

namespace freestand::test {
namespace {

struct Samples {
  std::vector<RandomCase> cases;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
};

struct Wanted {
  bool slender = false, coulomb = false, vertical = false;
  std::size_t first = 0;         // of the seed's cases
  double vertical_peak_g = 0.8;  // at most
};

Samples random_block(Model model, std::uint64_t seed, std::size_t samples, Wanted wanted = {}) {
  CaseFamily family;
  family.seed = seed;
  if (wanted.slender) family.alpha_low = family.mu_low = 0.05;
  family.one_model = 0;
  family.vertical = wanted.vertical ? 1 : 0;
  family.vertical_peak_g = wanted.vertical_peak_g;
  family.coulomb = wanted.coulomb ? 1 : 0;
  family.alpha_high = wanted.slender ? 0.3 : 0.8;
  Samples block;
  for (std::size_t i = wanted.first; i < wanted.first + samples; ++i) {
    block.cases.push_back(random_case(family, i));
    block.cases.back().specimen.model = model;
    block.specimens.push_back(block.cases.back().specimen);
    block.shakings.push_back(block.cases.back().shaking);
    block.shakings.back().scale *= 1 + 0.01 * static_cast<double>(i % 7);
  }
  return block;
}

std::vector<Response> compute(const Samples& block, double tolerance = 1e-9) {
  std::vector<Response> responses(block.specimens.size());
  respond_batch(block.specimens, block.shakings, {.tolerance = tolerance}, responses);
  return responses;
}

int differing(const std::vector<Response>& a, const std::vector<Response>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += !same_bits(a[i], b[i]);
  return count;
}

// The largest difference, in what it may be.
double apart(const Response& a, const Response& b) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto off = [](double x, double y, double limit) {
    const double d = std::abs(x - y) / (limit * std::max({1.0, std::abs(x), std::abs(y)}));
    return std::isnan(d) ? infinite : d;
  };
  if (a.outcome != b.outcome) return infinite;
  if (*failure(a.outcome) != 0) return 0;  // no answer; where one stalls is its own
  const double slides = std::max({off(a.peak_slip_m, b.peak_slip_m, 1e-7), off(a.slid_path_m, b.slid_path_m, 1e-7),
                                  off(a.residual_slip_m, b.residual_slip_m, 1e-7),
                                  off(a.peak_acceleration_mps2, b.peak_acceleration_mps2, 1e-6)});
  if (a.outcome == Outcome::overturned) return slides;
  return std::max({slides, off(a.peak_rotation_rad, b.peak_rotation_rad, 1e-7), off(a.end_time_s, b.end_time_s, 1e-5)});
}

bool close(const Response& a, const Response& b) { return apart(a, b) <= 1; }

struct Count {
  int differ = 0, sensitive = 0, flips = 0, events = 0, overturned = 0, still = 0;
};

Response single(const Samples& samples, std::size_t i, double factor, double tolerance) {
  Shaking shaking = samples.shakings[i];
  shaking.scale *= factor;
  return respond(samples.specimens[i], shaking, {.tolerance = tolerance});
}

bool sensitive(const Samples& samples, std::size_t i, const Response& expected, double as_far_as) {
  return 2 * apart(expected, single(samples, i, 1, 1e-12)) >= as_far_as ||
         apart(expected, single(samples, i, 1 + 1e-9, 1e-9)) >= as_far_as ||
         apart(expected, single(samples, i, 1 - 1e-9, 1e-9)) >= as_far_as;
}

Count compare(const char* label, const Samples& block) {
  const auto packs = compute(block);
  Count count;
  for (std::size_t i = 0; i < packs.size(); ++i) {
    const Response truth = single(block, i, 1, 1e-9);
    EXPECT_GE(packs[i].events, 0) << "sample " << i;
    count.overturned += truth.outcome == Outcome::overturned;
    count.still += truth.outcome == Outcome::at_rest;
    if (close(packs[i], truth)) {
      count.events += std::abs(packs[i].events - truth.events) > 3 + truth.events / 10 ||
                      std::abs(packs[i].impacts - truth.impacts) > 1;
      continue;
    }
    if (sensitive(block, i, truth, apart(packs[i], truth))) {
      ++count.sensitive;
      continue;
    }
    count.flips += packs[i].outcome != truth.outcome;
    ++count.differ;
    std::printf(
        "  sample %zu: %s/%s slip %.10f/%.10f rotation %.10f/%.10f acceleration %.8f/%.8f events %d/%d end %.8f/%.8f "
        "residual %.9f/%.9f path %.9f/%.9f; %s\n",
        i, name(packs[i].outcome), name(truth.outcome), packs[i].peak_slip_m, truth.peak_slip_m,
        packs[i].peak_rotation_rad, truth.peak_rotation_rad, packs[i].peak_acceleration_mps2,
        truth.peak_acceleration_mps2, packs[i].events, truth.events, packs[i].end_time_s, truth.end_time_s,
        packs[i].residual_slip_m, truth.residual_slip_m, packs[i].slid_path_m, truth.slid_path_m,
        block.cases[i].text().c_str());
  }
  std::printf(
      "%s: %zu samples, %d still, %d overturned; differ: %d (%d in outcome), %d sensitive, %d in events alone\n", label,
      packs.size(), count.still, count.overturned, count.differ, count.flips, count.sensitive, count.events);
  return count;
}

struct Kind {
  std::string name;
  Model model;
  With with = With::nothing;
  bool coulomb = false, vertical = false;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

Samples block_of(const Kind& kind, std::size_t samples) {
  Samples all = random_block(kind.model, 40 + static_cast<std::uint64_t>(kind.model), samples,
                             {.coulomb = kind.coulomb, .vertical = kind.vertical});
  for (std::size_t i = 0; i < samples && kind.with != With::nothing; ++i)
    all.specimens[i].effects = {effect_with(kind.with, i)};
  return all;
}

class Batch : public testing::TestWithParam<Kind> {
 protected:
  Samples block(std::size_t samples) const { return block_of(GetParam(), samples); }
};

TEST_P(Batch, AgreesWithSingleSamples) {
  const int samples = long_tests() ? 10000 : 1000;
  const Count count = compare("packs", block(static_cast<std::size_t>(samples)));
  EXPECT_LE(count.differ, samples / 500);  // rows of small hops amplify the error of the steps
  EXPECT_LE(count.sensitive, 0.01 * samples);
  EXPECT_LE(count.events, 0.01 * samples);
  EXPECT_LT(count.still, samples / 2);
}

// Of the peaks of slip and rotation, against single runs at the tightest tolerance, from the least to the largest.
std::vector<double> errors(const Samples& all, const std::vector<Response>& packs) {
  std::vector<double> errors;
  const auto add = [&](double value, double truth) {
    if (truth > 1e-6) errors.push_back(std::abs(value - truth) / truth);
  };
  for (std::size_t i = 0; i < packs.size(); ++i) {
    const Response truth = single(all, i, 1, 1e-13);
    if (truth.outcome != Outcome::moved || packs[i].outcome != Outcome::moved) continue;
    add(packs[i].peak_slip_m, truth.peak_slip_m);
    add(packs[i].peak_rotation_rad, truth.peak_rotation_rad);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

std::vector<Response> one_by_one(const Samples& all, double tolerance) {
  std::vector<Response> responses;
  for (std::size_t i = 0; i < all.specimens.size(); ++i) responses.push_back(single(all, i, 1, tolerance));
  return responses;
}

// What freestand/simulate.hpp promises. Steps of one order less would miss it in rocking.
TEST_P(Batch, IsAsAccurateAsPromised) {
  const Samples all = block(300);
  for (const double tolerance : {1e-9, 1e-12}) {
    const auto found = errors(all, compute(all, tolerance)), alone = errors(all, one_by_one(all, tolerance));
    ASSERT_GT(found.size(), 100U);
    const std::size_t half = found.size() / 2, most = found.size() * 9 / 10;
    std::printf("tolerance %.0e: median error %.1e, 90 %% %.1e; one by one %.1e, %.1e\n", tolerance, found[half],
                found[most], alone[half], alone[most]);
    const bool law = GetParam().with != With::nothing && GetParam().with != With::slope;
    EXPECT_LT(found[half], law ? 1e-10 : 1e-12);
    EXPECT_LT(found[most], 10 * std::max(alone[most], 1e-12));
  }
}

// All but a few: a flight, a dip of a rough record, a law that is too steep for its steps are left to single samples. Here
// that is up to 8 of 300.
TEST_P(Batch, IsComputedInPacks) {
  if (!dynamics::batch_kernels()) GTEST_SKIP() << "no kernels";
  const Samples all = block(300);
  std::vector<Response> responses(all.specimens.size());
  const std::size_t alone = dynamics::respond_and_count(all.specimens, all.shakings, {}, responses);
  std::printf("%zu of %zu alone\n", alone, responses.size());
  EXPECT_LE(alone, responses.size() / 30);
}

TEST_P(Batch, SameBitsInAnyOrderAndCompany) {
  const Samples all = block(300);
  const auto expected = compute(all);
  std::vector<std::size_t> order(all.specimens.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < order.size(); ++i) std::swap(order[i], order[(i * 7919 + 13) % order.size()]);
  Samples shuffled;
  for (const std::size_t i : order) {
    shuffled.specimens.push_back(all.specimens[i]);
    shuffled.shakings.push_back(all.shakings[i]);
  }
  const auto mixed = compute(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_TRUE(same_bits(mixed[i], expected[order[i]])) << i;
  for (const std::size_t count : {1, 2, 3, 5, 8, 13}) {
    Samples few;
    few.specimens.assign(all.specimens.begin(), all.specimens.begin() + static_cast<std::ptrdiff_t>(count));
    few.shakings.assign(all.shakings.begin(), all.shakings.begin() + static_cast<std::ptrdiff_t>(count));
    const auto responses = compute(few);
    for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(same_bits(responses[i], expected[i])) << count << " " << i;
  }
}

TEST_P(Batch, MirrorsWithTheShaking) {
  Samples all = block(200);
  const auto expected = compute(all);
  for (Shaking& shaking : all.shakings) shaking.scale = -shaking.scale;
  for (Specimen& specimen : all.specimens) {
    std::swap(specimen.block.left_m, specimen.block.right_m);
    if (has_sides(GetParam().with)) specimen.effects[0].parameters[0] = -specimen.effects[0].parameters[0];
  }
  const auto mirrored = compute(all);
  const auto residuals = [](Response response, int sign) {  // a zero without a sign
    response.residual_slip_m = sign * response.residual_slip_m + 0.0;
    response.residual_rotation_rad = sign * response.residual_rotation_rad + 0.0;
    return response;
  };
  for (std::size_t i = 0; i < mirrored.size(); ++i)
    EXPECT_TRUE(same_bits(residuals(mirrored[i], -1), residuals(expected[i], 1))) << i;
}

const Kind kinds[] = {{"Slide", Model::slide},
                      {"Rock", Model::rock},
                      {"SlideRock", Model::slide_rock},
                      {"SlideBySpeed", Model::slide, With::speed},
                      {"SlideRockBySpeed", Model::slide_rock, With::speed},
                      {"SlideByPath", Model::slide, With::path},
                      {"SlideRockByPath", Model::slide_rock, With::path},
                      {"SlideOnSpring", Model::slide, With::spring},
                      {"SlideRockOnSpring", Model::slide_rock, With::spring},
                      {"SlideRockWithDrag", Model::slide_rock, With::drag},
                      {"SlideWithSpringAndDrag", Model::slide, With::spring_and_drag},
                      {"SlideRockWithSpringAndDrag", Model::slide_rock, With::spring_and_drag},
                      {"SlideRockOnSpringWithCoulomb", Model::slide_rock, With::spring, true},
                      {"SlideByDirection", Model::slide, With::direction},
                      {"SlideRockByDirection", Model::slide_rock, With::direction},
                      {"SlideByAllOfSlip", Model::slide, With::all_of_slip},
                      {"SlideRockByAllOfSlip", Model::slide_rock, With::all_of_slip},
                      {"SlideOnSlope", Model::slide, With::slope},
                      {"SlideRockOnSlope", Model::slide_rock, With::slope},
                      {"SlideRockOnSlopeWithCoulomb", Model::slide_rock, With::slope, true},
                      {"RockWithCoulomb", Model::rock, With::nothing, true},
                      {"SlideRockWithCoulomb", Model::slide_rock, With::nothing, true},
                      {"SlideShaken", Model::slide, With::nothing, false, true},
                      {"SlideRockShaken", Model::slide_rock, With::nothing, false, true},
                      {"SlideRockShakenWithCoulomb", Model::slide_rock, With::nothing, true, true}};
INSTANTIATE_TEST_SUITE_P(Kinds, Batch, testing::ValuesIn(kinds), [](const auto& info) { return info.param.name; });

class BatchOnEachMachine : public testing::TestWithParam<std::tuple<Kind, const char*>> {};

TEST_P(BatchOnEachMachine, SameBits) {
  const auto& [kind, level] = GetParam();
  const Samples all = block_of(kind, 300);
  const auto with = [&](const char* name) {
    const Isa forced(name);
    return forced.there() ? compute(all) : std::vector<Response>();
  };
  const auto least = with("v2"), wider = with(level);
  if (least.empty() || wider.empty()) GTEST_SKIP() << "this machine, or this build, lacks v2 or " << level;
  EXPECT_EQ(differing(wider, least), 0);
}

INSTANTIATE_TEST_SUITE_P(Levels, BatchOnEachMachine,
                         testing::Combine(testing::ValuesIn(kinds), testing::Values("v3", "v4")),
                         [](const auto& info) { return std::get<0>(info.param).name + "_" + std::get<1>(info.param); });

// Low friction, many hops that die out slowly. Where the floor might tip the block before a row is over, a single sample goes through all
// of it, and tells more events; packs look further ahead.
TEST(BatchOfSlenderBlocks, AgreesWithSingleSamples) {
  const int samples = 500;
  const Count count = compare("slender", random_block(Model::slide_rock, 143, samples, {.slender = true}));
  EXPECT_LE(count.differ, 1);
  EXPECT_LE(count.sensitive, 0.02 * samples);
  EXPECT_LE(count.events, 0.03 * samples);
}

// Friction that falls within a speed of a micrometre a second: series that hold for a small part of a step only.
TEST(BatchOfSteepSpeedLaws, AgreesWithSingleSamples) {
  const int samples = 100;
  for (const Model model : {Model::slide, Model::slide_rock}) {
    Samples block = random_block(model, 145, samples);
    for (std::size_t i = 0; i < block.specimens.size(); ++i) {
      KeyedRandom random(172, i);
      const double drop = random.uniform(-0.3, 0.6), speed = random.log_uniform(1e-8, 1e-3);
      block.specimens[i].effects = {{i % 3 == 0 ? &rational : &exponential, {drop, speed}}};
    }
    const Count count = compare("steep", block);
    EXPECT_EQ(count.differ, 0);
    EXPECT_LE(count.sensitive, 0.02 * samples);
  }
}

// The floor falls away under blocks that rest, slide and rock.
TEST(BatchOnFloorsThatDrop, AgreesWithSingleSamples) {
  const int samples = 500;
  for (const Model model : {Model::slide, Model::slide_rock}) {
    const Count count = compare("drop", random_block(model, 144, samples, {.vertical = true, .vertical_peak_g = 3}));
    EXPECT_LE(count.differ, 1);
    EXPECT_LE(count.sensitive, 0.02 * samples);
    EXPECT_LE(count.events, 0.01 * samples);
  }
}

// Within one interval it strikes the floor, and without it would turn just below and rise again.
TEST(BatchOfRockingBlocks, DoNotMissADip) {
  const Samples one = random_block(Model::rock, 41, 1, {.first = 4243});
  EXPECT_TRUE(close(compute(one)[0], single(one, 0, 1, 1e-9)));
}

TEST(BatchOfAnything, FallsBackToSingleSamples) {
  std::vector<RandomCase> cases;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (std::uint64_t i = 0; i < 60; ++i) {
    cases.push_back(random_case({}, i));
    specimens.push_back(cases.back().specimen);
    shakings.push_back(cases.back().shaking);
  }
  specimens[7].block.height_m = -1;
  shakings[8].scale = 0;
  std::vector<Response> responses(specimens.size());
  respond_batch(specimens, shakings, {.tolerance = 1e-14}, responses);
  for (std::size_t i = 0; i < specimens.size(); ++i)
    EXPECT_TRUE(same_bits(responses[i], respond(specimens[i], shakings[i], {.tolerance = 1e-14}))) << i;
}

// White noise between knots 0.02 s apart: a slip may end and begin again within one interval, and its speed dip to zero
// between two knots at which it is positive.
TEST(BatchOfRoughRecords, SlidesAsSingleSamplesDo) {
  std::vector<FloorMotion> records;
  for (std::uint64_t k = 0; k < 20; ++k) {
    KeyedRandom random(81, k);
    std::vector<double> a(401);
    for (double& value : a) value = random.normal();
    records.push_back(piecewise_linear("noise", 0.02, a));
  }
  std::vector<Specimen> specimens(2000);
  std::vector<Shaking> shakings(2000);
  for (std::size_t i = 0; i < 2000; ++i) {
    KeyedRandom random(82, i);
    specimens[i].block = Block::rectangular(0.6, 1.8, 100);
    specimens[i].model = Model::slide;
    const double mu = random.uniform(0.05, 0.5);
    specimens[i].friction = {mu * random.uniform(1, 1.2), mu};
    shakings[i] = {&records[i % 20], mu * standard_gravity_mps2 * random.log_uniform(0.3, 3)};
  }
  std::vector<Response> responses(2000);
  respond_batch(specimens, shakings, {}, responses);
  int wrong = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    const Response truth = respond(specimens[i], shakings[i], {.tolerance = 1e-12});
    wrong += !close(responses[i], truth) || responses[i].events != truth.events;
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace freestand::test
