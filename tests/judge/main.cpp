// judge [--cases 5000] [--first 0] [--seed 1] [--bouc-wen] [--show FROM TO]: the kernel before the contact time-stepper, or on
// Bouc-Wen's contact before Runge-Kutta steps. A table per effect and setting, and every disagreement as a case that can
// be repeated. Exit 1 if there is any.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <mutex>
#include <thread>

#include "judge/known_gaps.hpp"
#include "judge/tally.hpp"

namespace freestand::test {
namespace {

struct Options {
  std::uint64_t seed = 1, first = 0, cases = 5000;
  int threads = 1;
  Family family = Family::rigid;
  std::vector<double> show_s;
};

Tally judge_all(const Options& options) {
  Tally tally;
  std::mutex one_at_a_time;
  std::atomic<std::uint64_t> next{options.first};
  const auto work = [&] {
    for (std::uint64_t n = next++; n < options.first + options.cases; n = next++) {
      const JudgedCase c = judged_case(options.seed, n, options.family);
      const Judgement judgement = judge(c);
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      tally.add(c, judgement);
      if (judgement.finding == Finding::agrees) continue;
      const bool disagrees = judgement.finding == Finding::disagrees;
      const std::string gap = disagrees ? known_gap(c, judgement) : "";
      fmt::print("{} [{}] {}\n    {}\n", disagrees ? gap.empty() ? "DISAGREES" : "disagrees (" + gap + ")" : "edge",
                 name(c.recipe.setting), c.text(), judgement.what);
      std::fflush(stdout);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < options.threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return tally;
}

}  // namespace
}  // namespace freestand::test

int main(int count, char** words) {
  freestand::test::Options options;
  CLI::App parser("the kernel before the contact time-stepper");
  parser.add_option("--seed", options.seed, "of the cases");
  parser.add_option("--first", options.first, "number of the first case");
  parser.add_option("--cases", options.cases, "how many");
  parser.add_option("--threads", options.threads, "side by side")->check(CLI::Range(1, 1024));
  parser.add_option("--show", options.show_s, "from, to [s]: both histories of the first case, and no judgement")
      ->expected(2);
  bool bouc_wen = false;
  parser.add_flag("--bouc-wen", bouc_wen, "cases of model bouc_wen, which have numbers of their own");
  bool formulas = false;
  parser.add_flag("--formulas", formulas, "laws of no catalogue, as formulas, which have numbers of their own");
  CLI11_PARSE(parser, count, words);
  if (bouc_wen) options.family = freestand::test::Family::bouc_wen;
  if (formulas) options.family = freestand::test::Family::formulas;
  if (!options.show_s.empty()) {
    const freestand::test::JudgedCase c = freestand::test::judged_case(options.seed, options.first, options.family);
    fmt::print("{}\n{}", c.text(), freestand::test::side_by_side(c, options.show_s[0], options.show_s[1]));
    return 0;
  }
  const freestand::test::Tally tally = freestand::test::judge_all(options);
  fmt::print("{}", tally.table());
  return tally.total().disagreements ? 1 : 0;
}
