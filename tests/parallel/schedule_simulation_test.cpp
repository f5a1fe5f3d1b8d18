// What a sweep loses with more ranks than a test can start: each rank, the nodes that share what they have taken, the counter and the first
// rank that serves it, and the server of the file system are simulated event by event, with the very rule by which nodes take blocks. Times are those
// that tests/bench/schedule_times.cpp measures.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <queue>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "parallel/schedule.hpp"

namespace freestand::parallel {
namespace {

struct Machine {
  Takers takers;
  double block_s;        // a block of 8192 samples at 10 us each
  double block_scatter;  // of ln of a block's time: blocks of one study differ by some percent
  double rank_scatter;   // of ln of a rank's speed: cores and nodes differ
  double beat_s;         // the first rank serves the others between packs of samples; 0: the network does by itself
  bool log_a_node;       // else each block is a file of its own
};

// Measured by build/release/schedule_times on two cores under `mpirun -n 2`; the network is that of one machine with itself, by
// TCP, which is slower to answer than those of clusters. A server of files answers one request at a time.
constexpr double raise_s =
    20e-6;  // one raise of the counter, by messages: so long the counter is busy, and so long an answer takes besides
constexpr double own_node_s = 0.1e-6;   // taking what the node has
constexpr double new_file_s = 0.24e-3;  // making a file and writing its first page

struct Lost {
  double share;          // of the ranks' time, against blocks that were dealt out perfectly
  double counter_share;  // spent waiting for the counter
  std::int64_t raises;
};

using Rule = BlockRange (*)(std::int64_t ticket, std::int64_t total, const Takers&);

// Serves one after the other.
class Queue {
 public:
  double answered(double asked, double service_s) { return free_at_ = std::max(asked, free_at_) + service_s; }

 private:
  double free_at_ = 0;
};

struct Node {
  BlockRange taken, next;
  double answered = 0;  // when the counter answers what is asked last, or has answered
  bool no_more = false, has_log = false;
};

Lost simulate(const Machine& m, std::int64_t blocks, Rule rule) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const std::int64_t ranks = m.takers.ranks, ranks_of_node = ranks / m.takers.nodes;
  std::vector<double> slowness(static_cast<std::size_t>(ranks));
  for (double& s : slowness) s = std::exp(m.rank_scatter * normal(random));
  std::vector<Node> nodes(static_cast<std::size_t>(m.takers.nodes));
  struct Event {
    double time;  // when a rank is free; of its last block, so long ago was it free first
    std::int64_t rank;
    double asked;
    bool operator>(const Event& other) const { return std::tie(time, rank) > std::tie(other.time, other.rank); }
  };
  std::priority_queue<Event, std::vector<Event>, std::greater<>> asks;
  for (std::int64_t rank = 0; rank < ranks; ++rank) asks.push({0, rank, 0});
  double waited = 0, last = 0, speed = 0, work = 0;
  for (const double s : slowness) speed += 1 / s;
  Queue counter, files;
  std::int64_t ticket = 0;
  while (!asks.empty()) {
    Event ask = asks.top();
    asks.pop();
    Node& node = nodes[static_cast<std::size_t>(ask.rank / ranks_of_node)];
    const bool answered = node.answered <= ask.time;
    if (node.taken.empty() && answered) node.taken = std::exchange(node.next, {});
    const bool begins = !node.taken.empty();
    if (answered && node.next.empty() && !node.no_more &&
        (!begins || m.takers.asks_ahead(node.taken.end - node.taken.first - 1))) {
      const double heard = m.beat_s > 0 && ask.rank > 0 ? std::ceil(ask.time / m.beat_s) * m.beat_s : ask.time;
      node.answered = counter.answered(heard, raise_s) + raise_s;
      node.next = rule(ticket++, blocks, m.takers);
      node.no_more = node.next.empty();
      ask.time = node.answered;
    } else if (!begins && !answered) {  // another rank of the node has asked
      ask.time = node.answered;
    } else if (!begins) {
      waited += ask.time - ask.asked;
      last = std::max(last, ask.time);
      continue;
    }
    if (!begins) {
      asks.push(ask);
      continue;
    }
    waited += ask.time - ask.asked;
    ++node.taken.first;
    const double time = m.block_s * std::exp(m.block_scatter * normal(random));
    work += time;
    double end = ask.time + own_node_s + time * slowness[static_cast<std::size_t>(ask.rank)];
    if (!m.log_a_node || !node.has_log) end = files.answered(end, new_file_s);
    node.has_log = true;
    last = std::max(last, end);
    asks.push({end, ask.rank, end});
  }
  return {1 - work / speed / last, waited / (static_cast<double>(ranks) * last), ticket};
}

BlockRange one_at_a_time(std::int64_t ticket, std::int64_t total, const Takers&) {
  return {std::min(ticket, total), std::min(ticket + 1, total)};
}

TEST(Schedule, TicketsTakeEveryBlockOnceAndSingleOnesAtTheEnd) {
  for (const Takers& takers :
       {Takers{1, 1}, Takers{1, 2}, Takers{2, 3}, Takers{7, 7}, Takers{3, 96}, Takers{1000, 1000}, Takers{100, 10000}})
    for (const std::int64_t total : {0, 1, 2, 5, 13, 100, 2000, 123457}) {
      std::int64_t next = 0, ticket = 0;
      for (;; ++ticket) {
        const BlockRange range = blocks_of_ticket(ticket, total, takers);
        if (range.empty()) break;
        const std::int64_t size = range.end - range.first, left = total - next;
        ASSERT_EQ(range.first, next);
        EXPECT_LE(size, takers.most());
        // Of a round that began with what is left and what was taken since: half of it, among the nodes.
        EXPECT_LE(size, std::max<std::int64_t>(1, (left + takers.nodes * size) / (2 * takers.nodes)));
        if (left <= 2 * takers.nodes) {
          EXPECT_EQ(size, 1);
        }
        next = range.end;
      }
      EXPECT_EQ(next, total);
      EXPECT_TRUE(blocks_of_ticket(ticket + total, total, takers).empty());
      const std::int64_t rounds =
          2 + std::bit_width(static_cast<std::uint64_t>(takers.most()));  // those that get shorter
      EXPECT_LE(ticket, total / takers.most() + 2 * takers.nodes * rounds);
    }
}

TEST(Schedule, AMillionBlocksOfOneNodeAreTakenInNoTime) {
  const Takers takers{1, 2};
  for (std::int64_t ticket = 0; ticket < 500'000; ++ticket)
    ASSERT_FALSE(blocks_of_ticket(ticket, 1'000'000, takers).empty());
}

TEST(Schedule, TenThousandRanksLoseLessThanTwoPercent) {
  for (const Takers& takers : {Takers{10, 1000}, Takers{100, 10000}, Takers{125, 1000}}) {
    const std::int64_t blocks = 120 * takers.ranks;  // a short sweep: ten seconds of each rank
    for (const double served_each : {0.0, beat_s}) {
      const Machine m{takers, 0.08, 0.05, 0.05, served_each, true};
      const Lost two_levels = simulate(m, blocks, blocks_of_ticket);
      const Lost one =
          simulate({{takers.ranks, takers.ranks}, 0.08, 0.05, 0.05, served_each, true}, blocks, one_at_a_time);
      Machine many_files = m;
      many_files.log_a_node = false;
      fmt::print(
          "{:4} nodes, {:5} ranks, counter {}: lost {:.2f} %, at the counter {:.2f} %, {} raises; each rank one block "
          "at a "
          "time {:.2f} %, {:.2f} %, {}; with a file a block {:.1f} %\n",
          takers.nodes, takers.ranks, served_each > 0 ? "served by rank 0" : "by the network  ", 100 * two_levels.share,
          100 * two_levels.counter_share, two_levels.raises, 100 * one.share, 100 * one.counter_share, one.raises,
          100 * simulate(many_files, blocks, blocks_of_ticket).share);
      EXPECT_LT(two_levels.share, 0.02);
      EXPECT_LT(two_levels.counter_share, 0.01);
    }
  }
}

}  // namespace
}  // namespace freestand::parallel
