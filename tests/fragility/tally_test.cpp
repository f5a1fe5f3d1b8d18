#include "fragility/tally.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>
#include <numeric>

#include "fragility/draws.hpp"
#include "fragility/fit.hpp"
#include "fragility/histogram.hpp"
#include "fragility/validate.hpp"
#include "support/keyed_random.hpp"

namespace freestand::fragility::tally_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Options options() {
  Options o;
  o.im_name = "report";
  o.im_edge = {0, 1, 2, 4};
  o.edps = {{"delta", "1", "Delta", false, 0, {0.5, 1, 2}}, {"overturned", "1", "", true, 0, {}}};
  o.axes = {{"friction_mu_k", "1", {0.1, 0.3, 0.5}}};
  o.motion_group = {0, 1, 2, -1};
  o.minimum_samples = 20;
  o.resamples = 50;
  return o;
}

// A made-up study in which everything happens.
struct Row {
  double im, edp[2], axis[1];
  int motion;
  Outcome outcome;
};

Row row(std::uint64_t i) {
  const auto u = [&](std::uint64_t stream) { return test::uniform(i, stream); };
  Row r{4.4 * u(1) - 0.2, {}, {0.05 + 0.5 * u(2)}, static_cast<int>(4 * u(3)), Outcome::moved};
  r.edp[0] = 0.7 * std::max(r.im, 0.0) * std::exp(0.5 * test::normal(i, 4));
  if (u(5) < 0.1) r.outcome = Outcome::at_rest, r.edp[0] = 0;
  if (u(6) < 0.2 * r.im - 0.2) r.outcome = Outcome::overturned;
  if (u(7) < 0.01) r.outcome = Outcome::painleve;
  if (u(8) < 0.01) r.edp[0] = nan;
  r.edp[1] = r.outcome == Outcome::overturned;
  return r;
}

void add(Tally& tally, std::uint64_t i) {
  const Row r = row(i);
  tally.add({i, r.im, r.motion, r.outcome, r.edp, r.axis});
}

Counts total(const Tally& tally, std::size_t edp, std::size_t bin) {
  Counts sum;
  for (std::size_t g = 0; g < tally.layout().groups; ++g) {
    const Counts c = tally.counts(edp, bin, g);
    sum.n += c.n, sum.still += c.still, sum.over += c.over, sum.moved += c.moved;
    sum.sum_ln += c.sum_ln, sum.sum_ln2 += c.sum_ln2;
  }
  return sum;
}

TEST(Tally, CountsAreThoseOfTheSamples) {
  Tally tally(options());
  Counts expected;
  std::int64_t outside = 0, missing = 0, painleve = 0, above_one = 0, in_cell = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    add(tally, i);
    const Row r = row(i);
    if (r.outcome == Outcome::painleve) {
      ++painleve;
    } else if (r.im < 0 || r.im > 4) {
      ++outside;
    } else if (r.outcome != Outcome::overturned && std::isnan(r.edp[0])) {
      ++missing;
    } else if (r.im >= 1 && r.im < 2) {
      ++expected.n;
      const bool over = r.outcome == Outcome::overturned;
      ++(over ? expected.over : r.edp[0] == 0 ? expected.still : expected.moved);
      if (over || r.edp[0] > 1) ++above_one;
      if ((over || r.edp[0] > 1) && r.axis[0] >= 0.3 && r.axis[0] <= 0.5) ++in_cell;
      if (!over && r.edp[0] > 0)
        expected.sum_ln += std::log(r.edp[0]), expected.sum_ln2 += std::pow(std::log(r.edp[0]), 2);
    }
  }
  const Counts found = total(tally, 0, 1);
  EXPECT_EQ(found.n, expected.n);
  EXPECT_EQ(found.still, expected.still);
  EXPECT_EQ(found.over, expected.over);
  EXPECT_EQ(found.moved, expected.moved);
  EXPECT_NEAR(found.sum_ln, expected.sum_ln, 1e-8);
  EXPECT_NEAR(found.sum_ln2, expected.sum_ln2, 1e-8);
  EXPECT_EQ(tally.count_of(Outcome::painleve), painleve);
  EXPECT_EQ(tally.outside_im(), outside);
  EXPECT_EQ(tally.missing(0), missing);
  EXPECT_EQ(tally.missing(1), 0);
  EXPECT_EQ(tally.samples(), 3000);
  EXPECT_GT(std::min({painleve, outside, missing, found.still, found.over}), 0);

  std::int64_t above = 0, cell = 0;
  for (std::size_t g = 0; g < tally.layout().groups; ++g) {
    above += tally.exceeding(0, 1, g, 1);
    cell += tally.axis_exceeding(0, 0, 1, 1, g, 1);
  }
  EXPECT_EQ(above, above_one);
  EXPECT_EQ(cell, in_cell);
  const auto histogram = tally.histogram(0, 1);
  EXPECT_EQ(std::accumulate(histogram.begin(), histogram.end(), std::int64_t{0}), expected.moved);
}

// The binary EDP: its "moved" are the ones that are not overturned and yet 1; here there are none.
TEST(Tally, BinaryDemandIsItselfTheProbability) {
  Tally tally(options());
  for (std::uint64_t i = 0; i < 500; ++i) add(tally, i);
  for (std::size_t bin = 0; bin < 3; ++bin) {
    const Counts c = total(tally, 1, bin);
    std::int64_t above = 0;
    for (std::size_t g = 0; g < tally.layout().groups; ++g) above += tally.exceeding(1, bin, g, 0);
    EXPECT_EQ(c.moved, 0);
    EXPECT_EQ(above, c.over);
    EXPECT_EQ(c.n, c.still + c.over);
  }
  EXPECT_TRUE(tally.histogram(1, 0).empty());
}

// Of a demand that is known of overturned samples too (a connection broke before, or it did not), these count by what it
// was; of the others, as above every capacity.
TEST(Tally, OverturnedSamplesCountByTheirOwnValueWhereTheyHaveOne) {
  Options o = options();
  o.edps = {{.name = "connection_failed", .binary = true, .capacities = {}, .censored = false},
            {.name = "delta", .capacities = {0.5}}};
  o.axes[0].edge = {0, 1};
  Tally tally(o);
  // Of 100 samples 40 overturn, of these 10 after the connection broke; it breaks in 5 of those that stand.
  for (std::uint64_t i = 0; i < 100; ++i) {
    const bool over = i < 40, broken = i % 4 == 0 && i < 60;
    const double edp[] = {broken ? 1.0 : 0.0, over ? nan : 0.1}, axis[] = {0.5};
    tally.add({i, 0.5, 3, over ? Outcome::overturned : Outcome::moved, edp, axis});
  }
  std::int64_t broken = 0, above = 0, in_cell = 0;
  for (std::size_t g = 0; g < tally.layout().groups; ++g) {
    broken += tally.exceeding(0, 0, g, 0);
    above += tally.exceeding(1, 0, g, 0);
    in_cell += tally.axis_exceeding(0, 0, 0, 0, g, 0);
  }
  EXPECT_EQ(broken, 15);
  EXPECT_EQ(in_cell, 15);
  EXPECT_EQ(above, 40);
  EXPECT_EQ(total(tally, 0, 0).n, 100);
  EXPECT_EQ(total(tally, 0, 0).over, 40);
  const Result result = fit(tally);
  EXPECT_DOUBLE_EQ(result.edps[0].surface.probability[0], 0.15);
}

// The speed at a wall that was struck before the block fell, and 0 where none was: three ways of asking agree.
TEST(Tally, OverturnedSamplesWithASpeedOfTheirOwnAreFittedByIt) {
  Options o = options();
  o.edps = {{.name = "wall_hit", .binary = true, .capacities = {}, .censored = false},
            {.name = "wall_speed_mps", .capacities = {1e-6, 0.5}, .censored = false}};
  o.axes[0].edge = {0, 1};
  Tally tally(o);
  test::KeyedRandom random(3, 1);
  constexpr int samples = 4000;
  int struck = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const bool over = i % 5 < 2, hit = random.chance(over ? 0.1 : 0.4);
    struck += hit;
    const double speed = hit ? std::exp(-1 + 0.5 * random.normal()) : 0.0;
    const double edp[] = {hit ? 1.0 : 0.0, speed}, axis[] = {0.5};
    tally.add({i, 0.5, 3, over ? Outcome::overturned : Outcome::moved, edp, axis});
  }
  const Result result = fit(tally);
  const double share = static_cast<double>(struck) / samples;
  EXPECT_DOUBLE_EQ(result.edps[0].surface.probability[0], share);
  EXPECT_NEAR(result.edps[1].surface.probability[0], share, 1e-3);
  EXPECT_EQ(total(tally, 1, 0).over, 0);
  EXPECT_EQ(total(tally, 1, 0).moved, struck);
}

TEST(Tally, AnySplitInAnyOrderGivesTheSameBits) {
  Tally whole(options());
  constexpr std::uint64_t n = 4000;
  for (std::uint64_t i = 0; i < n; ++i) add(whole, i);
  for (const std::uint64_t parts : {2, 3, 5, 17}) {
    std::vector<Tally> tallies(parts, Tally(options()));
    for (std::uint64_t i = 0; i < n; ++i) add(tallies[(n - 1 - i) * 7919 % parts], n - 1 - i);
    Tally merged(options());
    for (std::uint64_t p = 0; p < parts; ++p) merged.merge(tallies[(3 * p + 1) % parts]);
    if (parts % 3 != 0) {
      EXPECT_TRUE(merged == whole) << parts;
    }
    Tally backward(options());
    for (std::uint64_t p = parts; p-- > 0;) backward.merge(tallies[p]);
    EXPECT_TRUE(backward == whole) << parts;
    EXPECT_EQ(backward.words(), whole.words()) << parts;
  }
}

TEST(Tally, WordsMayBeAddedElementByElement) {
  Tally whole(options()), first(options()), second(options());
  for (std::uint64_t i = 0; i < 2000; ++i) {
    add(whole, i);
    add(i % 3 ? first : second, i);
  }
  auto words = first.words();
  const auto more = second.words();
  for (std::size_t i = 0; i < words.size(); ++i) words[i] += more[i];
  EXPECT_TRUE(Tally::from_words(options(), words) == whole);
  EXPECT_TRUE(Tally::from_words(options(), whole.words()) == whole);
  words.pop_back();
  EXPECT_THROW(Tally::from_words(options(), words), Error);
}

TEST(Tally, SizeDoesNotGrowWithTheSamples) {
  Tally tally(options());
  const std::size_t before = tally.words().size();
  for (std::uint64_t i = 0; i < 2000; ++i) add(tally, i);
  EXPECT_EQ(tally.words().size(), before);
}

TEST(Tally, ReadsTheTableOfASweep) {
  Table table;
  for (const char* name : {"friction_mu_k", "motion", "im_report", "edp_delta", "edp_overturned", "outcome"})
    table.columns.push_back({name, "1", "", ColumnKind::real});
  Tally direct(options()), from_table(options());
  for (std::uint64_t i = 40; i < 400; ++i) {
    add(direct, i);
    const Row r = row(i);
    for (const double v :
         {r.axis[0], static_cast<double>(r.motion), r.im, r.edp[0], r.edp[1], static_cast<double>(r.outcome)})
      table.values.push_back(v);
  }
  from_table.add(table, 40);
  EXPECT_TRUE(direct == from_table);

  table.values[5] = 17;
  EXPECT_THROW(from_table.add(table, 40), Error);
  table.columns[3].name = "edp_other";
  EXPECT_THROW(from_table.add(table, 40), Error);
}

TEST(Tally, RefusesTalliesOfOtherOptionsAndUnknownMotions) {
  Tally tally(options());
  Options other = options();
  other.im_edge.push_back(5);
  EXPECT_THROW(tally.merge(Tally(other)), Error);
  const Row r = row(1);
  EXPECT_THROW(tally.add({1, r.im, 9, Outcome::moved, r.edp, r.axis}), Error);
  EXPECT_THROW(tally.add({1, r.im, 0, Outcome::moved, {}, r.axis}), Error);
}

TEST(Tally, StillThreshold) {
  Options o = options();
  o.edps[0].still_threshold = 0.1;
  Tally tally(o);
  const double axis[] = {0.2};
  for (const double value : {0.05, 0.1, 0.1000001, 0.3}) {
    const double edp[] = {value, 0};
    tally.add({1, 0.5, 0, Outcome::moved, edp, axis});
  }
  EXPECT_EQ(total(tally, 0, 0).still, 2);
  EXPECT_EQ(total(tally, 0, 0).moved, 2);
}

TEST(Tally, EveryProblemOfTheOptionsIsNamed) {
  Options o;
  o.im_edge = {1, 0};
  o.edps = {{"delta", "1", "", false, 0, {2, 1}}, {"slip", "m", "", false, -1, {}}, {"slip", "m", "", false, 0, {1}}};
  o.axes = {{"mu", "1", {0.1}}};
  o.minimum_samples = 1;
  o.confidence = 1.5;
  try {
    Tally tally(o);
    FAIL() << "accepted";
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const char* part : {"bin edges", "capacities of delta", "no capacities for slip", "still threshold",
                             "asked for twice", "axis mu", "minimum of 1", "confidence 1.5"})
      EXPECT_THAT(text, testing::HasSubstr(part));
  }
}

TEST(Bins, EdgesOfEqualWidthAndEqualCount) {
  EXPECT_EQ(equal_width_edges(0, 3, 3), (std::vector<double>{0, 1, 2, 3}));
  EXPECT_THROW(equal_width_edges(1, 1, 3), Error);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 1000; ++i) values.push_back(std::exp(test::normal(i, 9)));
  const auto edge = equal_count_edges(values, 8);
  ASSERT_EQ(edge.size(), 9u);
  std::vector<int> count(8);
  for (const double v : values) ++count[static_cast<std::size_t>(bin_index(edge, v))];
  for (const int c : count) EXPECT_NEAR(c, 125, 1);
  EXPECT_THROW(equal_count_edges({2, 2, 2}, 3), Error);
}

TEST(Bins, IndexAtTheEdges) {
  const std::vector<double> edge{0, 1, 2};
  EXPECT_EQ(bin_index(edge, 0), 0);
  EXPECT_EQ(bin_index(edge, 1), 1);
  EXPECT_EQ(bin_index(edge, 2), 1);
  EXPECT_EQ(bin_index(edge, -1e-9), -1);
  EXPECT_EQ(bin_index(edge, 2.0000001), -1);
  EXPECT_EQ(bin_index(edge, nan), -1);
}

}  // namespace
}  // namespace freestand::fragility::tally_test
