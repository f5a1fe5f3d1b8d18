// Model bouc_wen in packs against the same samples one by one; to the bit the same in any order, in any company, with
// any instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <freestand/simulate.hpp>
#include <limits>
#include <vector>

#include "support/bouc_wen_cases.hpp"
#include "support/isa.hpp"
#include "support/repeats.hpp"
#include "support/same_bits.hpp"

namespace freestand::test::bouc_wen_batch_test {
namespace {

struct Samples {
  std::vector<RandomCase> cases;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
};

Samples block_of(const BoucWenFamily& family, std::size_t samples) {
  Samples block;
  for (std::size_t i = 0; i < samples; ++i) {
    block.cases.push_back(random_bouc_wen_case(family, i));
    block.specimens.push_back(block.cases.back().specimen);
    block.shakings.push_back(block.cases.back().shaking);
  }
  return block;
}

// Those that the packs take: gamma = beta, level shaking. Time steps from a small to a large part of a swing.
constexpr BoucWenFamily plain{.seed = 11, .yield_low_m = 2.54e-6, .other_shapes = 0, .vertical = 0, .longest_s = 8};

std::vector<Response> compute(const Samples& block, const Settings& settings = {}) {
  std::vector<Response> responses(block.specimens.size());
  respond_batch(block.specimens, block.shakings, settings, responses);
  return responses;
}

double difference(const Response& a, const Response& b, double yield) {
  return std::max({std::abs(a.peak_slip_m - b.peak_slip_m), std::abs(a.residual_slip_m - b.residual_slip_m),
                   std::abs(a.slid_path_m - b.slid_path_m)}) /
         (yield + b.peak_slip_m);
}

TEST(BoucWenBatch, AgreesWithSingleSamples) {
  const Samples block = block_of(plain, long_tests() ? 3000 : 300);
  const auto packs = compute(block);
  int moved = 0, differ = 0, sensitive = 0;
  std::vector<double> errors;
  for (std::size_t i = 0; i < packs.size(); ++i) {
    const Specimen& specimen = block.specimens[i];
    const double yield = specimen.bouc_wen.yield_displacement_m;
    const Response truth = respond(specimen, block.shakings[i], {.tolerance = 1e-12});
    moved += truth.outcome == Outcome::moved ? 1 : 0;
    const double error = difference(packs[i], truth, yield);
    errors.push_back(error);
    const double limit = 1e-6;
    if (packs[i].outcome == truth.outcome && packs[i].events == truth.events && error < limit &&
        std::abs(packs[i].peak_acceleration_mps2 - truth.peak_acceleration_mps2) < 1e-6 &&
        std::abs(packs[i].end_time_s - truth.end_time_s) < 1e-5)
      continue;
    const Response usual = respond(specimen, block.shakings[i]);
    Shaking changed = block.shakings[i];
    changed.scale *= 1 + 1e-9;
    const Response other = respond(specimen, changed, {.tolerance = 1e-12});
    const double by_nudges = std::max(difference(usual, truth, yield), difference(other, truth, yield));
    if (error < limit ? by_nudges > 0.1 * limit || usual.events != truth.events || other.events != truth.events
                      : by_nudges >= error) {
      ++sensitive;
      continue;
    }
    ++differ;
    std::printf("  sample %zu: %s%s; peak %.9e %.9e, residual %.9e %.9e, path %.9e %.9e, events %d %d, end %.7f %.7f\n",
                i, text(specimen.bouc_wen).c_str(), block.cases[i].text().c_str(), packs[i].peak_slip_m,
                truth.peak_slip_m, packs[i].residual_slip_m, truth.residual_slip_m, packs[i].slid_path_m,
                truth.slid_path_m, packs[i].events, truth.events, packs[i].end_time_s, truth.end_time_s);
  }
  std::sort(errors.begin(), errors.end());
  std::printf("%zu samples, %d moved; differ: %d, sensitive: %d; error median %.1e, 90 %% %.1e of the slip\n",
              packs.size(), moved, differ, sensitive, errors[errors.size() / 2], errors[errors.size() * 9 / 10]);
  EXPECT_EQ(differ, 0);
  EXPECT_LE(sensitive, 0.01 * static_cast<double>(packs.size()));
  EXPECT_LT(errors[errors.size() / 2], 1e-8);
  EXPECT_GT(moved, 0.6 * static_cast<double>(packs.size()));
}

TEST(BoucWenBatch, SameBitsInAnyOrderAndCompany) {
  const Samples all = block_of(plain, 100);
  const auto expected = compute(all);
  Samples backwards;
  for (std::size_t i = all.specimens.size(); i-- > 0;) {
    backwards.specimens.push_back(all.specimens[i]);
    backwards.shakings.push_back(all.shakings[i]);
  }
  const auto reversed = compute(backwards);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(same_bits(reversed[expected.size() - 1 - i], expected[i])) << i;
  for (const std::size_t count : {1, 3, 17}) {
    Samples few;
    few.specimens.assign(all.specimens.begin(), all.specimens.begin() + static_cast<std::ptrdiff_t>(count));
    few.shakings.assign(all.shakings.begin(), all.shakings.begin() + static_cast<std::ptrdiff_t>(count));
    const auto responses = compute(few);
    for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(same_bits(responses[i], expected[i])) << count << ' ' << i;
  }
}

class BoucWenBatchOnEachMachine : public testing::TestWithParam<const char*> {};

TEST_P(BoucWenBatchOnEachMachine, SameBits) {
  const Samples all = block_of(plain, 100);
  const auto with = [&](const char* name) {
    const Isa forced(name);
    return forced.there() ? compute(all) : std::vector<Response>();
  };
  const auto least = with("v2"), wider = with(GetParam());
  if (least.empty() || wider.empty()) GTEST_SKIP() << "this machine, or this build, lacks v2 or " << GetParam();
  for (std::size_t i = 0; i < least.size(); ++i) EXPECT_TRUE(same_bits(wider[i], least[i])) << i;
}

INSTANTIATE_TEST_SUITE_P(Levels, BoucWenBatchOnEachMachine, testing::Values("v3", "v4"),
                         [](const auto& info) { return std::string(info.param); });

TEST(BoucWenBatch, MirrorsWithTheShaking) {
  Samples all = block_of(plain, 60);
  const auto expected = compute(all);
  for (Shaking& shaking : all.shakings) shaking.scale = -shaking.scale;
  auto mirrored = compute(all);
  for (std::size_t i = 0; i < mirrored.size(); ++i) {
    EXPECT_EQ(mirrored[i].residual_slip_m, -expected[i].residual_slip_m);
    mirrored[i].residual_slip_m = expected[i].residual_slip_m;
    EXPECT_TRUE(same_bits(mirrored[i], expected[i])) << i;
  }
}

// What no pack covers, or what makes no sense, is answered as alone.
TEST(BoucWenBatch, TheRestIsComputedOneByOne) {
  Samples block = block_of({.seed = 12, .yield_low_m = 1e-4, .other_shapes = 0.5, .vertical = 0.5}, 40);
  block.specimens[3].bouc_wen.exponent = std::numeric_limits<double>::quiet_NaN();
  block.shakings[4].scale = std::numeric_limits<double>::infinity();
  block.shakings[5].scale = 0;
  block.shakings[6].scale = 1e200;
  block.specimens[7].friction.mu_k = 0;
  block.specimens[8].bouc_wen.yield_displacement_m = 1e30;
  const auto packs = compute(block, {.tolerance = 1e-12});
  for (std::size_t i = 0; i < packs.size(); ++i)
    EXPECT_TRUE(same_bits(packs[i], respond(block.specimens[i], block.shakings[i], {.tolerance = 1e-12}))) << i;
  const auto usual = compute(block);
  for (const Response& r : usual)
    EXPECT_TRUE(std::isfinite(r.peak_slip_m) || r.outcome == Outcome::not_finite || r.outcome == Outcome::step_limit);
}

}  // namespace
}  // namespace freestand::test::bouc_wen_batch_test
