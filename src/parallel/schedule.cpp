#include "parallel/schedule.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "parallel/node_memory.hpp"
#include "parallel/requests.hpp"
#include "parallel/root_counters.hpp"
#include "parallel/stop.hpp"

namespace freestand::parallel {
namespace {

using Clock = std::chrono::steady_clock;

// So often is the counter raised in the time that a block takes, or less often: with blocks of ten milliseconds and 2 us a raise it is
// busy for one part in eighty.
constexpr std::int64_t asks_in_a_block = 64;

// All ranks together tell what they have counted a thousand times a second.
constexpr std::chrono::milliseconds pause_per_rank{1};

// What rank 0 keeps for all: how often the counter of blocks was raised, and what was counted in the blocks that are done.
class Ledger {
 public:
  explicit Ledger(const Communicator& world) : numbers_(world, slots) {}

  std::int64_t next_ticket() { return numbers_.fetch_add(tickets, 1); }
  void end(std::int64_t blocks) { numbers_.fetch_add(tickets, blocks); }  // more than there are

  void add(const Counts& counts) {
    if (counts.samples) numbers_.fetch_add(samples, counts.samples);
    if (counts.overturned) numbers_.fetch_add(overturned, counts.overturned);
    if (counts.failed) numbers_.fetch_add(failed, counts.failed);
  }
  Counts counts() {
    return {numbers_.fetch_add(samples, 0), numbers_.fetch_add(overturned, 0), numbers_.fetch_add(failed, 0)};
  }
  void serve() const { numbers_.serve(); }

 private:
  enum Slot : int { tickets, samples, overturned, failed, slots };
  RootCounters numbers_;
};

// What this node has taken and none of its ranks has begun: a range that they share, and the one after it. Who takes one of the last blocks of a
// range asks for the next, so that an answer that takes its time keeps one rank of the node waiting, not all of them.
class NodeBlocks {
 public:
  // Collective.
  explicit NodeBlocks(const Communicator& world) : memory_(world, numbers) {
    Words nodes{memory_.node() == world.rank()};
    world.sum_in_place(nodes);
    takers_ = {nodes[0], world.size()};
  }

  const Takers& takers() const { return takers_; }

  // The next one; none where `take`, which asks for a range, gives none any more. `wait`: for another rank that asks.
  std::optional<std::int64_t> next(const std::function<BlockRange()>& take, const std::function<void()>& wait) {
    for (;;) {
      std::optional<std::int64_t> block;
      bool asks = false, over = false;
      {
        const NodeMemory::Lock lock(memory_);
        const std::span<std::int64_t> held = memory_.numbers();
        if (held[first] == held[end]) {
          held[first] = std::exchange(held[next_first], 0);
          held[end] = std::exchange(held[next_end], 0);
        }
        if (held[first] < held[end]) block = held[first]++;
        over = held[no_more];
        asks = held[next_first] == held[next_end] && !held[asking] && !over &&
               (!block || takers_.asks_ahead(held[end] - held[first]));
        if (asks) held[asking] = 1;
      }
      if (asks) {
        const BlockRange taken = take();
        const NodeMemory::Lock lock(memory_);
        const std::span<std::int64_t> held = memory_.numbers();
        held[next_first] = taken.first;
        held[next_end] = taken.end;
        held[no_more] = taken.empty();
        held[asking] = 0;
      }
      if (block || over) return block;
      if (!asks) wait();
    }
  }

 private:
  enum Number : std::size_t { first, end, next_first, next_end, asking, no_more, numbers };
  NodeMemory memory_;
  Takers takers_;
};

}  // namespace

std::int64_t samples_to_beat(std::int64_t samples, double seconds, std::int64_t most) {
  constexpr std::int64_t least = 32;
  const double each = seconds / static_cast<double>(samples);
  return each * static_cast<double>(most) <= beat_s ? most
                                                    : std::clamp(static_cast<std::int64_t>(beat_s / each), least, most);
}

std::int64_t Takers::most() const { return std::max((ranks + nodes - 1) / nodes, ranks / asks_in_a_block); }

bool Takers::asks_ahead(std::int64_t left) const { return left < ranks / nodes / 2; }

BlockRange blocks_of_ticket(std::int64_t ticket, std::int64_t total, const Takers& takers) {
  const std::int64_t most = takers.most(), round = takers.nodes * most;
  const std::int64_t whole_rounds = total < 2 * round ? 0 : total / round - 1;  // each of `most` blocks a node
  std::int64_t first = std::min(ticket / takers.nodes, whole_rounds) * round;
  for (ticket -= first / most; first < total; ticket -= takers.nodes) {
    const std::int64_t size = std::max<std::int64_t>(1, std::min((total - first) / (2 * takers.nodes), most));
    if (ticket < takers.nodes || size == 1)
      return {std::min(first + ticket * size, total), std::min(first + (ticket + 1) * size, total)};
    first += takers.nodes * size;
  }
  return {total, total};
}

bool for_each_block(const Communicator& world, const BlockList& todo, const BlockFunction& compute,
                    Progress* progress) {
  const std::int64_t total = todo.size();
  Ledger ledger(world);
  NodeBlocks node(world);
  auto last = Clock::now();
  const auto look = [&] {
    ledger.serve();
    if (progress && progress->due()) progress->show(ledger.counts());
  };
  const Beat beat = [&] {
    if (!world.is_root() || Clock::now() - last < std::chrono::milliseconds(1)) return;
    look();
    last = Clock::now();
  };

  Counts told_later;
  auto told = Clock::now();
  const auto tell_counts = [&] {
    ledger.add(std::exchange(told_later, {}));
    told = Clock::now();
  };
  Words done{0};
  const auto take = [&] { return blocks_of_ticket(ledger.next_ticket(), total, node.takers()); };
  const auto wait_for_others = [&] {
    if (world.is_root()) look();
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  };
  while (!stop_requested()) {
    const std::optional<std::int64_t> next = node.next(take, wait_for_others);
    if (!next) break;
    const Counts counts = compute(todo[*next], beat);
    told_later.samples += counts.samples;
    told_later.overturned += counts.overturned;
    told_later.failed += counts.failed;
    ++done[0];
    if (Clock::now() - told >= world.size() * pause_per_rank) tell_counts();
    beat();
  }
  tell_counts();
  if (stop_requested()) ledger.end(total);
  if (world.size() > 1)
    wait([](MPI_Request* request) { return MPI_Ibarrier(MPI_COMM_WORLD, request); },
         [&] {
           if (world.is_root()) look();
         });
  if (progress && world.is_root()) progress->finish(ledger.counts());
  world.sum_in_place(done);
  return done[0] == total;
}

}  // namespace freestand::parallel
