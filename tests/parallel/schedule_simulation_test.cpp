// What the schedule loses with more ranks than a test can start: each rank, the counter and the first rank that serves it are
// simulated event by event, with the very rule by which ranks take blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>

#include "parallel/schedule.hpp"

namespace freestand::parallel {
namespace {

struct Machine {
  std::int64_t ranks;
  double block_s;        // a block of 8192 samples at 10 us each
  double block_scatter;  // of ln of a block's time, measured: blocks of one study differ by some percent
  double rank_scatter;   // of ln of a rank's speed: cores and nodes differ
  double service_s;      // of one raise of the counter; assumed
  double beat_s;         // the first rank serves the others between packs of samples; 0: the network does by itself
};

struct Lost {
  double share;          // of the ranks' time, against blocks that were dealt out perfectly
  double counter_share;  // spent waiting for the counter
  std::int64_t raises;
};

using Rule = BlockRange (*)(std::int64_t ticket, std::int64_t total, std::int64_t ranks);

Lost simulate(const Machine& m, std::int64_t blocks, Rule rule) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> slowness(static_cast<std::size_t>(m.ranks));
  for (double& s : slowness) s = std::exp(m.rank_scatter * normal(random));
  struct Event {
    double time;
    std::int64_t rank;
    bool operator>(const Event& other) const { return time > other.time; }
  };
  std::priority_queue<Event, std::vector<Event>, std::greater<>> asks;
  for (std::int64_t rank = 0; rank < m.ranks; ++rank) asks.push({0, rank});
  double free_at = 0, waited = 0, last = 0, speed = 0, work = 0;
  for (const double s : slowness) speed += 1 / s;
  std::int64_t ticket = 0;
  while (!asks.empty()) {
    const Event ask = asks.top();
    asks.pop();
    const double heard = m.beat_s > 0 && ask.rank > 0 ? std::ceil(ask.time / m.beat_s) * m.beat_s : ask.time;
    const double answered = std::max(heard, free_at) + m.service_s;
    free_at = answered;
    waited += answered - ask.time;
    const BlockRange range = rule(ticket++, blocks, m.ranks);
    double end = answered;
    for (std::int64_t block = range.first; block < range.end; ++block) {
      const double time = m.block_s * std::exp(m.block_scatter * normal(random));
      work += time;
      end += time * slowness[static_cast<std::size_t>(ask.rank)];
    }
    last = std::max(last, end);
    if (!range.empty()) asks.push({end, ask.rank});
  }
  return {1 - work / speed / last, waited / (static_cast<double>(m.ranks) * last), ticket};
}

BlockRange one_at_a_time(std::int64_t ticket, std::int64_t total, std::int64_t) {
  return {std::min(ticket, total), std::min(ticket + 1, total)};
}

TEST(Schedule, TicketsTakeEveryBlockOnceAndSingleOnesAtTheEnd) {
  for (const std::int64_t ranks : {1, 2, 3, 7, 1000})
    for (const std::int64_t total : {0, 1, 2, 5, 13, 100, 2000, 123457}) {
      std::int64_t next = 0, ticket = 0;
      for (;; ++ticket) {
        const BlockRange range = blocks_of_ticket(ticket, total, ranks);
        if (range.empty()) break;
        ASSERT_EQ(range.first, next);
        EXPECT_LE(range.end - range.first,
                  std::max<std::int64_t>(1, (total - next + ranks * (range.end - range.first)) / (2 * ranks)));
        if (total - next <= 2 * ranks) {
          EXPECT_EQ(range.end - range.first, 1);
        }
        next = range.end;
      }
      EXPECT_EQ(next, total);
      EXPECT_TRUE(blocks_of_ticket(ticket + total, total, ranks).empty());
      const std::int64_t most = ranks < 128 || total < 4 * ranks ? total : total / 8;
      EXPECT_LE(ticket, most) << total << " over " << ranks;
    }
}

TEST(Schedule, TenThousandRanksLoseLessThanTwoPercent) {
  for (const std::int64_t ranks : {1000, 10000}) {
    const std::int64_t blocks = 120 * ranks;  // a short sweep: ten seconds of each rank
    for (const double served_each : {0.0, beat_s}) {
      const Machine m{ranks, 0.08, 0.05, 0.05, 2e-6, served_each};
      const Lost guided = simulate(m, blocks, blocks_of_ticket), single = simulate(m, blocks, one_at_a_time);
      fmt::print(
          "{:6} ranks, counter {}: lost {:.2f} %, at the counter {:.2f} %, {} raises; one block at a time {:.2f} %, "
          "{:.2f} %, {}\n",
          ranks, served_each > 0 ? "served by rank 0" : "by the network  ", 100 * guided.share,
          100 * guided.counter_share, guided.raises, 100 * single.share, 100 * single.counter_share, single.raises);
      EXPECT_LT(guided.share, 0.02);
      EXPECT_LT(guided.counter_share, 0.01);
    }
  }
}

}  // namespace
}  // namespace freestand::parallel
