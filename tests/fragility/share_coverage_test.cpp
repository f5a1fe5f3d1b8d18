// Do intervals of counted shares hold the truth as often as they say, where samples share records? The table, with errors of 0.003:
//   FREESTAND_REPEATS=10000 build/release/tests/test_fragility --gtest_filter='ShareCoverage.*'
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "fragility/draws.hpp"
#include "fragility/share_interval.hpp"

namespace freestand::fragility {
namespace {

using test::repeats_asked;

// Records whose samples exceed a capacity with probability Phi((z + sqrt(correlation) u)/sqrt(1 - correlation)), u normal from record to
// record and Phi(z) = share: ln demand is normal, `correlation` of its variance is that between records.
// weights: dispersion of the records' weights, by which their samples go.
struct Setting {
  int records, each;
  double share, correlation;
  double weights = 0;
  double heaviest = 1;   // of the first record, times that of the others
  int of_their_own = 0;  // samples that are motions of their own, in which nothing happens
};

struct Misses {
  int below = 0, above = 0, repeats = 0;  // the truth lies below the lower limit, above the upper one
  double coverage() const { return 1 - (below + above) / static_cast<double>(repeats); }
  double error() const { return std::sqrt(coverage() * (1 - coverage()) / repeats); }
};

// GSL's own generator: none of freestand's.
Misses simulate(const Setting& s, int repeats) {
  const std::unique_ptr<gsl_rng, void (*)(gsl_rng*)> rng(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  const double z = gsl_cdf_ugaussian_Pinv(s.share), root = std::sqrt(s.correlation),
               rest = std::sqrt(1 - s.correlation);
  Misses misses;
  std::vector<GroupShare> groups(static_cast<std::size_t>(s.records));
  const auto records = groups.size();
  const double of_record = s.each * (s.records - 1 + s.heaviest),
               truth = s.share * of_record / (of_record + s.of_their_own);
  if (s.of_their_own > 0) groups.push_back({static_cast<double>(s.of_their_own), 0});
  for (misses.repeats = 0; misses.repeats < repeats; ++misses.repeats) {
    for (std::size_t i = 0; i < records; ++i) {
      const double p = gsl_cdf_ugaussian_P((z + root * gsl_ran_ugaussian(rng.get())) / rest);
      const auto samples = s.weights > 0
                               ? gsl_ran_poisson(rng.get(), s.each * gsl_ran_lognormal(rng.get(), 0, s.weights))
                               : static_cast<unsigned>(i == 0 ? s.heaviest * s.each : s.each);
      groups[i] = {static_cast<double>(samples), static_cast<double>(gsl_ran_binomial(rng.get(), p, samples))};
    }
    const Interval found = share_interval(groups, records, 0.9);
    misses.below += truth < found.lower;
    misses.above += truth > found.upper;
  }
  return misses;
}

std::string text(const Setting& s, const Misses& m) {
  return fmt::format("{} records of {}, weights {}, P {}, correlation {}: {:.3f} +- {:.3f} (truth below {}, above {})",
                     s.records, s.each, s.weights, s.share, s.correlation, m.coverage(), m.error(), m.below, m.above);
}

// The table, where more repeats are asked for.
void tell(const Setting& s, const Misses& m) {
  if (std::getenv("FREESTAND_REPEATS")) fmt::print("{}\n", text(s, m));
}

// Three errors of simulation beside what is wanted: of a hundred settings one in 400 lies further off on a side by chance.
void expect_within(const Setting& s, const Misses& m, double least, double most) {
  EXPECT_GE(m.coverage(), least - 3 * m.error()) << text(s, m);
  EXPECT_LE(m.coverage(), most + 3 * m.error()) << text(s, m);
}

// One record of twenty that outweighs all others, and few records beside pulses. (The first held the truth in 0.37 to 0.52 when each residual
// was taken from a mean that the record itself makes, the others in 0.54 to 0.72 when each sample of a pulse counted as much as a record.)
TEST(ShareCoverage, IsKeptByHeavyRecordsAndBesidePulses) {
  const int repeats = repeats_asked(600);
  const Setting settings[] = {{20, 16, 0.5, 0.3, 0, 60},     {20, 16, 0.2, 0.6, 0, 60},
                              {20, 30, 0.3, 0.5, 0, 20},     {4, 188, 0.6, 0.9, 0, 1, 250},
                              {8, 94, 0.06, 0.9, 0, 1, 250}, {14, 36, 0.95, 0.9, 0, 1, 500},
                              {44, 11, 0.02, 0.9, 0, 1, 500}};
  for (const Setting& s : settings) {
    const Misses m = simulate(s, repeats);
    tell(s, m);
    expect_within(s, m, 0.87, 1);
  }
}

// Wanted of nominal 90 %: 87 to 93 %, and that is what comes where a record or more is expected to exceed, but for 14 records that are
// nearly one sample each: 0.92 to 0.945.
TEST(ShareCoverage, IsNinetyPercentWithSharedRecords) {
  const int repeats = repeats_asked(600);
  double sum = 0;
  int settings = 0;
  for (const int records : {14, 22, 40, 100})
    for (const double share : {0.1, 0.2, 0.35, 0.5, 0.7})
      for (const double correlation : {0.0, 0.2, 0.5, 0.8}) {
        const Setting s{records, 25, share, correlation};
        const Misses m = simulate(s, repeats);
        tell(s, m);
        expect_within(s, m, 0.87, records == 14 && correlation == 0.8 ? 0.945 : 0.93);
        sum += m.coverage();
        ++settings;
      }
  EXPECT_NEAR(sum / settings, 0.91, 0.01);
}

// Records that are drawn by weights that differ by half and by twice (dispersion 0.5, 0.8) have as many samples.
TEST(ShareCoverage, IsNinetyPercentWithRecordsOfDifferentWeights) {
  const int repeats = repeats_asked(600);
  for (const int records : {22, 40, 100})
    for (const double weights : {0.5, 0.8})
      for (const double share : {0.2, 0.5})
        for (const double correlation : {0.2, 0.5}) {
          const Setting s{records, 25, share, correlation, weights};
          const Misses m = simulate(s, repeats);
          tell(s, m);
          expect_within(s, m, 0.87, 0.93);
        }
}

// Where less than a record is expected to exceed, or hardly one more, the studies see none, one or two, and what they see does not tell one P
// from another: the limit of none is never crossed. 0.895 and more of 25 samples a record; of 140 and 1000, which tell small shares of a
// record that say nothing of the others, 0.845 and more.
TEST(ShareCoverage, OfFewerRecordsThanOneExpectedIsMore) {
  const int repeats = repeats_asked(600);
  for (const int each : {25, 140, 1000})
    for (const int records : {14, 22, 40})
      for (const double share : {0.03, 0.06})
        for (const double correlation : {0.2, 0.5, 0.8}) {
          const Setting s{records, each, share, correlation};
          const Misses m = simulate(s, repeats);
          tell(s, m);
          expect_within(s, m, each == 25 ? 0.88 : 0.84, 0.98);
        }
}

}  // namespace
}  // namespace freestand::fragility
