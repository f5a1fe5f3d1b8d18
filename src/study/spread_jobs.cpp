#include "study/spread_jobs.hpp"

#include <bit>
#include <chrono>
#include <memory>
#include <numeric>

#include "parallel/schedule.hpp"
#include "parallel/step_display.hpp"

namespace freestand::study {
namespace {

using Values = std::vector<double>;
using parallel::Words;

// Every rank's answers on every rank: lengths first, then the bits of the numbers, each written by one rank.
std::vector<Values> share(const parallel::Communicator& world, const std::vector<Values>& mine) {
  Words lengths;
  for (const Values& values : mine) lengths.push_back(static_cast<std::int64_t>(values.size()));
  world.sum_in_place(lengths);
  Words bits(static_cast<std::size_t>(std::accumulate(lengths.begin(), lengths.end(), std::int64_t{0})), 0);
  std::size_t at = 0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    for (std::size_t k = 0; k < mine[i].size(); ++k) bits[at + k] = std::bit_cast<std::int64_t>(mine[i][k]);
    at += static_cast<std::size_t>(lengths[i]);
  }
  world.sum_in_place(bits);
  std::vector<Values> all;
  auto next = bits.begin();
  for (const std::int64_t length : lengths) {
    Values values;
    for (std::int64_t k = 0; k < length; ++k) values.push_back(std::bit_cast<double>(*next++));
    all.push_back(std::move(values));
  }
  return all;
}

// Of one job of a call: what is kept, or found now.
Values answer(KeptAnswers* kept, std::int64_t call, std::size_t i, const Job& job) {
  if (!kept) return job(i);
  if (auto known = kept->find(call, i)) return std::move(*known);
  const auto start = std::chrono::steady_clock::now();
  Values found = job(i);
  kept->keep(call, i, found, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return found;
}

}  // namespace

Jobs spread_jobs(const parallel::Communicator& world, bool quiet, std::function<void()> leave,
                 std::shared_ptr<KeptAnswers> kept) {
  const auto display = std::make_shared<parallel::StepDisplay>(quiet || !world.is_root());
  return [world, display, leave = std::move(leave), kept = std::move(kept), call = std::int64_t{0}](
             const std::string& what, std::size_t n, const Job& job) mutable {
    ++call;
    std::vector<Values> mine(n);
    std::vector<std::int64_t> todo(n);
    std::iota(todo.begin(), todo.end(), 0);
    const auto compute = [&](std::int64_t i, const parallel::Beat&) {
      mine[static_cast<std::size_t>(i)] = answer(kept.get(), call, static_cast<std::size_t>(i), job);
      display->show(what, static_cast<std::size_t>(i), n);
      return parallel::Counts{.samples = 1};
    };
    const bool complete = parallel::for_each_block(world, todo, compute);
    if (!complete && leave) leave();
    if (!complete) throw Error("stopped on request (nothing of the fits is kept): start again", Exit::resumable);
    return world.size() == 1 ? mine : share(world, mine);
  };
}

}  // namespace freestand::study
