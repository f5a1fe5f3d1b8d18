#include "study/analysis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "study/known.hpp"
#include "study/study_text.hpp"

namespace freestand::study::analysis_test {
namespace {

constexpr std::int64_t in_bin = 200, in_last = 40, samples = 3 * in_bin + in_last;

double uniform(std::int64_t i, std::uint64_t stream) {
  return random::uniform(7, static_cast<std::uint64_t>(i), stream);
}

// Made-up rows over an intensity from 0 to 4, in bins of 1: in the first the demand is lognormal; in the second so little off
// it that the test of fit doubts it, and in the others far off. The last holds few samples.
Table rows() {
  Table table;
  table.columns = {{"im_report", "1", ""}, {"edp_delta", "1", ""}, {"outcome", "1", ""}, {"motion", "1", ""}};
  for (std::int64_t i = 0; i < samples; ++i) {
    const std::int64_t bin = i / in_bin;
    const double im = static_cast<double>(bin) + uniform(i, 1);
    const double z = std::sqrt(-2 * std::log(uniform(i, 2))) * std::cos(6.283185307179586 * uniform(i, 3));
    const double bent = bin == 0 ? 0.4 * z : bin == 1 ? 0.4 * z + 0.02 * z * z : z > 0 ? 1 + 0.2 * z : -1 + 0.2 * z;
    table.values.insert(table.values.end(), {im, std::exp(bent), static_cast<double>(Outcome::moved), 0});
  }
  return table;
}

fragility::EdpResult delta(const std::string& more) {
  const Study study =
      parse_study(test::block + test::friction + test::motions + "samples: 640\nfragility: {edp: [delta], " +
                      "bins: {edges: [0, 1, 2, 3, 4]}, " + more + "}\n",
                  "some.yaml", registries());
  const fragility::Result result = analyse(
      {}, study, Target(study), {0}, 1, samples, [](std::int64_t) { return rows(); }, run_here);
  return result.edps.at(0);
}

using fragility::BinStatus;

TEST(Analysis, MinimumSamplesEmptiesTheBinsThatHoldFewer) {
  const fragility::EdpResult usual = delta("resamples: 20"), more = delta("resamples: 20, minimum_samples: 100");
  const std::size_t last = 3 * usual.capacity.size();
  ASSERT_EQ(usual.bins[3].n, in_last);
  EXPECT_NE(usual.bins[3].status, BinStatus::too_few);
  EXPECT_TRUE(std::isfinite(usual.surface.probability[last]));
  EXPECT_EQ(more.bins[3].status, BinStatus::too_few);
  EXPECT_TRUE(std::isnan(more.surface.probability[last]));  // empty, not zero
  EXPECT_TRUE(std::isfinite(more.surface.probability[last - 1]));
}

TEST(Analysis, FalseDiscoveryIsTheLevelOfTheTests) {
  const fragility::EdpResult lax = delta("resamples: 20, false_discovery: 0.2"),
                             strict = delta("resamples: 20, false_discovery: 0.003");
  const double p = lax.bins[1].ks_p_estimated;
  ASSERT_GT(p, 0.003);
  ASSERT_LT(p, 0.1);  // with two sure rejections among four bins, Benjamini and Hochberg reject it below 0.2 * 3/4
  EXPECT_EQ(lax.bins[1].status, BinStatus::rejected);
  EXPECT_EQ(strict.bins[1].status, BinStatus::not_refuted);
  EXPECT_EQ(strict.bins[2].status, BinStatus::rejected);
}

TEST(Analysis, EmpiricalFallbackDecidesWhatAFailedBinShows) {
  const fragility::EdpResult counted = delta("resamples: 20"), kept = delta("resamples: 20, empirical_fallback: false");
  const std::size_t at = 2 * counted.capacity.size() + 2;
  ASSERT_EQ(counted.bins[2].status, BinStatus::rejected);
  ASSERT_EQ(kept.bins[2].status, BinStatus::rejected);
  EXPECT_EQ(counted.surface.probability[at], counted.surface.empirical[at]);
  EXPECT_GT(std::abs(kept.surface.probability[at] - kept.surface.empirical[at]), 0.02);
}

TEST(Analysis, ConfidenceAndResamplesReachTheBands) {
  const fragility::EdpResult usual = delta("resamples: 20"), narrow = delta("resamples: 20, confidence: 0.5"),
                             more = delta("resamples: 21");
  const double width = usual.surface.upper[1] - usual.surface.lower[1];
  EXPECT_LT(narrow.surface.upper[1] - narrow.surface.lower[1], 0.6 * width);
  EXPECT_NE(more.bins[0].lambda_se, usual.bins[0].lambda_se);
}

}  // namespace
}  // namespace freestand::study::analysis_test
