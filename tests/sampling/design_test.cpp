#include "sampling/design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>
#include <set>
#include <vector>

namespace freestand::sampling {
namespace {

constexpr Design every_design[] = {Design::monte_carlo, Design::latin_hypercube, Design::sobol};
const std::vector<std::string> some_names = {"motion.scale",   "friction.mu_k", "motion.period_s", "block.width_m",
                                             "block.height_m", "my.first_key",  "my.second_key"};

std::vector<double> draws(const Plan& plan, const std::string& name, std::uint64_t first, std::uint64_t count) {
  const Stream stream(plan, name);
  std::vector<double> u;
  for (std::uint64_t i = first; i < first + count; ++i) u.push_back(stream(i));
  return u;
}

// Is there exactly one draw in each of the intervals of length 1/n?
bool stratified(const std::vector<double>& u) {
  std::set<std::uint64_t> strata;
  for (const double x : u) strata.insert(static_cast<std::uint64_t>(x * static_cast<double>(u.size())));
  return strata.size() == u.size() && *strata.rbegin() == u.size() - 1;
}

// Sample i is point i/R of design i mod R: each is as even by itself as one alone, and no two are alike.
TEST(Design, ScramblesAreDesignsOfTheirOwn) {
  constexpr std::uint64_t scrambles = 16, points = 64;
  for (const Design design : {Design::latin_hypercube, Design::sobol})
    for (const std::string& name : some_names) {
      const Stream stream({design, 5, scrambles * points, scrambles}, name);
      std::vector<std::vector<double>> u(scrambles);
      for (std::uint64_t i = 0; i < scrambles * points; ++i) u[i % scrambles].push_back(stream(i));
      for (const auto& one : u) EXPECT_TRUE(stratified(one)) << name;
      if (design == Design::sobol) {
        EXPECT_EQ(u[0], draws({design, 5, 0}, name, 0, points));
      }
      // Independent: the correlation of two of them, point by point, is 0 in the mean over all 120 pairs. One of a pair is
      // below 1 (a scramble may swap whole halves), so that their mean scatters by less than sqrt(1/120).
      double sum = 0;
      for (std::size_t a = 0; a < scrambles; ++a)
        for (std::size_t b = a + 1; b < scrambles; ++b)
          for (std::size_t i = 0; i < points; ++i) sum += 12 * (u[a][i] - 0.5) * (u[b][i] - 0.5);
      EXPECT_LT(std::abs(sum / points / 120), 4 / std::sqrt(120)) << name;
    }
  // A number of samples that the scrambles do not divide: the first designs hold one point more.
  const Stream uneven({Design::latin_hypercube, 5, 37, 16}, "friction.mu_k");
  std::vector<std::vector<double>> u(16);
  for (std::uint64_t i = 0; i < 37; ++i) u[i % 16].push_back(uneven(i));
  for (const auto& one : u) EXPECT_TRUE(stratified(one));
}

// Computed by an independent implementation (Python integers; Philox, FNV-1a and the scrambling written out again;
// direction numbers from SciPy).
TEST(Design, DrawsAreReproducibleToTheBit) {
  struct Golden {
    const char* name;
    std::uint64_t seed, sample;
    double monte_carlo, latin_hypercube, sobol;
  };
  const Golden all[] = {
      {"friction.mu_k", 1ULL, 0ULL, 0x1.eb4cd3c0f428fp-1, 0x1.ba096bd60800ap-5, 0x1.db2eb564638bfp-1},
      {"friction.mu_k", 1ULL, 12345ULL, 0x1.3704fd39ed009p-1, 0x1.20fd8bb264930p-5, 0x1.1063a34b2e4c9p-1},
      {"friction.mu_k", 9223372036854775813ULL, 1099511627783ULL, 0x1.db394b8687f8ap-2, 0x1.811bbc954ab2dp-1,
       0x1.ab0acf4eb3841p-1},
      {"effects.offset_mass.eccentricity", 1ULL, 0ULL, 0x1.0aaffae590c81p-1, 0x1.f500b01f76292p-1,
       0x1.3c2723782ef2dp-1},
      {"effects.offset_mass.eccentricity", 1ULL, 12345ULL, 0x1.48c19e0074ce9p-1, 0x1.72d8129639481p-3,
       0x1.00bff00147d87p-1},
      {"effects.offset_mass.eccentricity", 9223372036854775813ULL, 1099511627783ULL, 0x1.4f959d35ddc1ap-2,
       0x1.ba633332fa821p-4, 0x1.ac55068c3654cp-3},
      {"my.own_key", 1ULL, 0ULL, 0x1.000d7e88eeba1p-1, 0x1.66e97fbdb6bfep-2, 0x1.cc98a508764c3p-1},
      {"my.own_key", 1ULL, 12345ULL, 0x1.f76814e1f3faep-2, 0x1.b4347b4a24e98p-2, 0x1.f8b07d8c5c3c2p-2},
      {"my.own_key", 9223372036854775813ULL, 1099511627783ULL, 0x1.4f83d923278ddp-1, 0x1.3fe820705c1e6p-2,
       0x1.54b28f2aa9589p-1},
  };
  for (const auto& g : all) {
    EXPECT_EQ(Stream({Design::monte_carlo, g.seed, 0}, g.name)(g.sample), g.monte_carlo);
    EXPECT_EQ(Stream({Design::latin_hypercube, g.seed, 1000}, g.name)(g.sample % 1000), g.latin_hypercube);
    EXPECT_EQ(Stream({Design::sobol, g.seed, 0}, g.name)(g.sample), g.sobol);
  }
}

TEST(Design, EveryDrawLiesInTheOpenInterval) {
  for (const Design design : every_design)
    for (const auto& name : some_names)
      for (const double u : draws({design, 3, 5000}, name, 0, 5000)) ASSERT_TRUE(u > 0 && u < 1);
}

TEST(Design, SeedAndNameChangeTheDraws) {
  for (const Design design : every_design) {
    const Plan plan{design, 1, 64}, other{design, 2, 64};
    EXPECT_NE(draws(plan, "friction.mu_k", 0, 64), draws(other, "friction.mu_k", 0, 64));
    EXPECT_NE(draws(plan, "my.first_key", 0, 64), draws(plan, "my.second_key", 0, 64));
  }
}

TEST(Design, MoreSamplesChangeNoEarlierDrawButInALatinHypercube) {
  for (const Design design : {Design::monte_carlo, Design::sobol})
    EXPECT_EQ(draws({design, 1, 10}, "friction.mu_k", 0, 10), draws({design, 1, 1000}, "friction.mu_k", 0, 10));
}

TEST(Design, LatinHypercubeHasOneDrawInEachStratum) {
  for (const std::uint64_t n : {1ULL, 2ULL, 3ULL, 17ULL, 1000ULL, 4096ULL, 30001ULL})
    for (const auto& name : {"friction.mu_k", "my.first_key"})
      EXPECT_TRUE(stratified(draws({Design::latin_hypercube, 5, n}, name, 0, n))) << n;
  EXPECT_THROW(Stream({Design::latin_hypercube, 1, 0}, "friction.mu_k"), Error);
}

// Of parameters that have no dimension of their own, of blocks of 64 and more.
TEST(Design, SobolHasOneDrawInEachStratumOfEveryAlignedBlock) {
  for (const auto& name : some_names)
    for (const std::uint64_t n : {2ULL, 64ULL, 4096ULL})
      for (const std::uint64_t block : {0ULL, 1ULL, 5ULL, 1ULL << 40})
        if (n > 2 || sobol_dimension(name) >= 0) {
          EXPECT_TRUE(stratified(draws({Design::sobol, 5, 0}, name, block * n, n))) << name << " " << n;
        }
}

TEST(Design, MonteCarloIsNotStratified) {
  EXPECT_FALSE(stratified(draws({Design::monte_carlo, 5, 0}, "friction.mu_k", 0, 4096)));
}

// Chi-square of an 8 x 8 grid for every pair of names, known and unknown: no pair may hang together. For independent
// draws its mean is 63 and its standard deviation 11; evenly spread designs lie below.
TEST(Design, PairsOfParametersFillTheSquare) {
  constexpr std::uint64_t n = 8192;
  for (const Design design : every_design) {
    std::vector<std::vector<double>> all;
    for (const auto& name : some_names) all.push_back(draws({design, 11, n}, name, 0, n));
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        std::vector<int> counts(64);
        for (std::size_t i = 0; i < n; ++i)
          ++counts[static_cast<std::size_t>(8 * all[a][i]) * 8 + static_cast<std::size_t>(8 * all[b][i])];
        double chi2 = 0;
        for (const int c : counts) chi2 += (c - n / 64.0) * (c - n / 64.0) / (n / 64.0);
        EXPECT_LT(chi2, 63 + 5 * 11) << name(design) << ": " << some_names[a] << " and " << some_names[b];
      }
  }
}

// How many of 1024 samples have both draws on the same side of their middles scatters, from design to design, no more than of independent
// samples. (In blocks of two each half is hit once, in any dimension. Orders that keep such blocks together made pairs of samples
// answer alike: 1.7 times the variance.)
TEST(Design, ProductsOfTwoParametersScatterNoMoreThanOfIndependentSamples) {
  constexpr int designs = 400;
  constexpr std::uint64_t n = 1024;
  for (const auto& [one, other] :
       {std::pair("my.first_key", "my.second_key"), std::pair("friction.mu_k", "my.first_key")}) {
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= designs; ++seed) {
      const auto a = draws({Design::sobol, seed, 0}, one, 0, n), b = draws({Design::sobol, seed, 0}, other, 0, n);
      double alike = 0;
      for (std::size_t i = 0; i < n; ++i) alike += (a[i] - 0.5) * (b[i] - 0.5) > 0;
      squares += (alike / n - 0.5) * (alike / n - 0.5) / designs;
    }
    // A variance from 400 designs is known to sqrt(2/400) = 0.07 of itself.
    EXPECT_LT(squares / (0.25 / n), 64.0 / 63 + 3 * 0.07) << one << " " << other;
  }
}

// Centred L2 discrepancy in its closed form (Hickernell 1998).
double centred_discrepancy(const std::vector<std::vector<double>>& x) {
  const std::size_t dimensions = x.size(), n = x[0].size();
  const auto centre = [&](std::size_t d, std::size_t i) { return std::abs(x[d][i] - 0.5); };
  double first = 0, second = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double product = 1;
    for (std::size_t d = 0; d < dimensions; ++d) product *= 1 + 0.5 * centre(d, i) - 0.5 * centre(d, i) * centre(d, i);
    first += product;
    for (std::size_t j = 0; j < n; ++j) {
      double pair = 1;
      for (std::size_t d = 0; d < dimensions; ++d)
        pair *= 1 + 0.5 * centre(d, i) + 0.5 * centre(d, j) - 0.5 * std::abs(x[d][i] - x[d][j]);
      second += pair;
    }
  }
  const double dn = static_cast<double>(n);
  return std::pow(13.0 / 12, static_cast<double>(dimensions)) - 2 / dn * first + second / dn / dn;
}

TEST(Design, SobolIsMoreEvenThanLatinHypercubeAndMonteCarlo) {
  const auto discrepancy = [](Design design, std::uint64_t seed, std::size_t dimensions) {
    std::vector<std::vector<double>> x;
    for (std::size_t d = 0; d < dimensions; ++d) x.push_back(draws({design, seed, 512}, some_names[d], 0, 512));
    return centred_discrepancy(x);
  };
  for (const std::size_t dimensions : {2U, 5U}) {
    double mc = 0, lhs = 0, sobol = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      mc += discrepancy(Design::monte_carlo, seed, dimensions);
      lhs += discrepancy(Design::latin_hypercube, seed, dimensions);
      sobol += discrepancy(Design::sobol, seed, dimensions);
    }
    EXPECT_LT(lhs, 0.8 * mc);
    EXPECT_LT(sobol, 0.2 * lhs);
  }
}

// Root mean square error, over 32 seeds, of the mean of a smooth function of five parameters whose integral is 1.
double error_of_mean(Design design, std::uint64_t n, bool additive) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 32; ++seed) {
    std::vector<Stream> streams;
    for (std::size_t d = 0; d < 5; ++d) streams.emplace_back(Plan{design, seed, n}, some_names[d]);
    double sum = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
      double product = 1, total = 0;
      for (const auto& stream : streams) {
        const double f = std::exp(stream(i)) / (std::exp(1.0) - 1);
        product *= f;
        total += f / 5;
      }
      sum += additive ? total : product;
    }
    squares += (sum / static_cast<double>(n) - 1) * (sum / static_cast<double>(n) - 1);
  }
  return std::sqrt(squares / 32);
}

// Order of convergence between 2^7 and 2^12 samples: 1/2 for Monte Carlo, about 3/2 for scrambled Sobol on smooth
// functions, and a Latin hypercube takes the additive part away.
TEST(Design, MeansConvergeFasterThanMonteCarlo) {
  const auto order = [](Design design) {
    return std::log2(error_of_mean(design, 1 << 7, false) / error_of_mean(design, 1 << 12, false)) / 5;
  };
  EXPECT_NEAR(order(Design::monte_carlo), 0.5, 0.12);
  EXPECT_GT(order(Design::sobol), 1.0);
  EXPECT_LT(error_of_mean(Design::sobol, 1 << 12, false), 0.03 * error_of_mean(Design::monte_carlo, 1 << 12, false));
  EXPECT_LT(error_of_mean(Design::latin_hypercube, 1 << 10, true),
            0.01 * error_of_mean(Design::monte_carlo, 1 << 10, true));
}

TEST(Design, KnownNamesHaveFixedDimensions) {
  EXPECT_EQ(sobol_dimension("motion.pta_g"), 0);
  EXPECT_EQ(sobol_dimension("friction.mu"), sobol_dimension("friction.mu_k"));
  EXPECT_EQ(sobol_dimension("motion.period_s"), 2);
  EXPECT_EQ(sobol_dimension("block.mass_kg"), 9);
  EXPECT_EQ(sobol_dimension("effects.offset_mass.eccentricity"), 35);
  EXPECT_EQ(sobol_dimension("my.first_key"), -1);
  EXPECT_EQ(sobol_dimension(""), -1);
}

TEST(Design, AParameterThatIsDrawnAgainIsIndependentOfAllDesigns) {
  for (const Design design : every_design) {
    const Plan plan{design, 5, 4096}, again{design, 5, 4096, 1, {"friction.mu_k"}};
    const std::vector<double> first = draws(plan, "friction.mu_k", 0, 4096),
                              second = draws(again, "friction.mu_k", 0, 4096);
    EXPECT_EQ(draws(plan, "block.width_m", 0, 64), draws(again, "block.width_m", 0, 64));
    // 16 x 16 cells of pairs, 16 in each: chi squared with 255 degrees of freedom (its 0.1 % points are 190 and 330). Another
    // scramble of the same design would leave most of them empty.
    std::vector<double> cell(256, 0);
    for (std::size_t i = 0; i < first.size(); ++i)
      cell[static_cast<std::size_t>(first[i] * 16) * 16 + static_cast<std::size_t>(second[i] * 16)] += 1;
    double chi_squared = 0;
    for (const double n : cell) chi_squared += (n - 16) * (n - 16) / 16;
    EXPECT_GT(chi_squared, 190);
    EXPECT_LT(chi_squared, 330);
  }
}

}  // namespace
}  // namespace freestand::sampling
