#include "study/bins.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "support/error_text.hpp"

namespace freestand::study {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");

TEST(Bins, GivenEdgesStayAsTheyAre) {
  EXPECT_THAT(bin_edges({{1, 2, 5}, 0, 0, Spacing::equal_count}, {}), ElementsAre(1, 2, 5));
}

TEST(Bins, EqualWidthAndLogSpanTheValues) {
  EXPECT_THAT(bin_edges({{}, 0, 4, Spacing::equal_width}, {3, 1, nan, 5, inf}), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(bin_edges({{}, 0, 2, Spacing::log}, {0.01, 100, 0, -4}), ElementsAre(0.01, DoubleEq(1), 100));
}

TEST(Bins, WidthGivesMultiplesThatEncloseEverything) {
  EXPECT_THAT(bin_edges({{}, 0.5, 0, Spacing::equal_count}, {0.6, 1.9, -0.2}), ElementsAre(-0.5, 0, 0.5, 1, 1.5, 2));
}

// A thousand are held; few values fill fewer, but up to a hundred may stay empty.
TEST(Bins, AWidthThatMakesMoreBinsThanCanBeHeldOrFilledIsAMistakeOfTheStudy) {
  const auto of_width = [](double width, std::size_t values) {
    std::vector<double> many(values, 0.5);
    many.front() = 0.0005;
    many.back() = 0.9995;
    return bin_edges({{}, width, 0, Spacing::equal_count}, many).size() - 1;
  };
  EXPECT_EQ(of_width(0.001, 5000), 1000U);
  EXPECT_EQ(of_width(0.01, 3), 100U);
  EXPECT_EQ(of_width(0.005, 200), 200U);
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { of_width(0.0009, 5000); }),
              testing::HasSubstr("1000 are held"));
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { of_width(0.005, 199); }),
              testing::HasSubstr("199 samples do not fill so many): choose a width of at least 0.01"));
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { of_width(1e-300, 3); }),
              testing::HasSubstr("a width of 1e-300"));
  for (const double width : {1e-310, 1e-320})
    EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { of_width(width, 3); }),
                testing::HasSubstr("makes countless bins"));
}

TEST(Bins, EqualCountPutsAsManyIntoEach) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(std::exp(0.01 * ((i * 617) % 1000)));
  const auto edges = bin_edges({{}, 0, 8, Spacing::equal_count}, values);
  ASSERT_EQ(edges.size(), 9U);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    EXPECT_EQ(std::count_if(values.begin(), values.end(),
                            [&](double x) { return x >= edges[i] && (x < edges[i + 1] || (i == 7 && x == edges[8])); }),
              125);
}

TEST(Bins, RepeatedValuesGiveFewerBinsAndIncreasingEdges) {
  const auto edges = bin_edges({{}, 0, 10, Spacing::equal_count}, {1, 1, 1, 1, 1, 1, 2, 2, 2, 3});
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>()), edges.end());
  EXPECT_EQ(edges.front(), 1);
  EXPECT_EQ(edges.back(), 3);
  const auto alike = bin_edges({{}, 0, 5, Spacing::equal_width}, {7, 7, 7});
  ASSERT_EQ(alike.size(), 2U);
  EXPECT_LT(alike[0], 7);
  EXPECT_GT(alike[1], 7);
}

TEST(Bins, NothingToBinIsAnError) {
  EXPECT_THROW(bin_edges({{}, 0, 5, Spacing::equal_width}, {nan, inf}), Error);
  EXPECT_THROW(bin_edges({{}, 0, 5, Spacing::log}, {-1, 0}), Error);
}

// 44 records scaled to each of four intensities, which come back with other last digits.
TEST(Bins, PartNoStripes) {
  std::vector<double> values;
  for (const double stripe : {0.2, 0.4, 0.8, 1.6})
    for (int record = 0; record < 44; ++record) values.push_back(stripe * (1 + (record % 7 - 3) * 1.1e-16));
  const auto bin_of = [](const std::vector<double>& edges, double value) {
    return std::upper_bound(edges.begin() + 1, edges.end() - 1, value) - edges.begin();
  };
  for (const BinsPart& part : {BinsPart{{}, 0, 8, Spacing::equal_count}, BinsPart{{}, 0.2, 0, Spacing::equal_count},
                               BinsPart{{}, 0, 7, Spacing::equal_width}, BinsPart{{}, 0, 3, Spacing::log},
                               BinsPart{{0.1, 0.4, 0.8, 2}, 0, 0, Spacing::equal_count}}) {
    const std::vector<double> edges = bin_edges(part, values);
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_EQ(bin_of(edges, values[i]), bin_of(edges, values[44 * (i / 44)])) << part.count << ' ' << i;
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
  }
  EXPECT_EQ(bin_edges({{}, 0, 8, Spacing::equal_count}, values).size(), 5U);
}

}  // namespace
}  // namespace freestand::study
