// Benchmark of the kernel on the standard jobs (jobs.hpp), beside two peers on the same samples in the same run. Odeint
// runs in three ways: (b) dopri5 with one step per knot, the fastest that makes sense; (c) dopri5 and (d) fehlberg78, of
// order 8, with as many steps as it takes to be as accurate as the kernel. Under pulses dopri5 chooses its own steps: (b) at a
// tolerance of 1e-9, (c) at the one that makes it as accurate.
//
//   build/release/benchmark_kernel [--benchmark_filter=P2] [--benchmark_repetitions=9] ...
//
// Times are of the processor, so that other work on the machine counts little.
// FREESTAND_BENCH_SAMPLES sets the number of samples per job. The runs are interleaved at random, medians are told.
// Errors are medians over the samples of |demand - demand of a tight run| (tolerance 1e-13), relative to the latter,
// among samples that moved and stand in both; `flips` counts samples with another outcome. Where a peer is too slow for
// all samples of a job, its time and errors are those of the first ones.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "answers.hpp"

namespace freestand::bench {
namespace {

struct Row {
  const Job* job;
  std::string solver;
  Solver solve;
  bool slow;  // one run is enough
  std::size_t count;
  std::vector<Answer> answers;
  Accuracy accuracy;
  std::vector<double> seconds;

  double seconds_a_sample() const { return part(seconds, 0.5) / static_cast<double>(count); }
};

std::vector<Row> rows_of(const Job& job) {
  const bool bouc_wen = job.specimens[0].model == Model::bouc_wen;
  const auto scalar = [](const Specimen& b, const Shaking& s) { return answer(respond(b, s)); };
  const auto odeint = [bouc_wen](const Specimen& b, const Shaking& s) {
    return answer(bouc_wen ? odeint_bouc_wen(b, s) : dopri5_peer(b, s, {}));
  };
  const auto cvode = [bouc_wen, peer = std::make_shared<CvodePeer>(1e-9)](const Specimen& b, const Shaking& s) {
    return answer(bouc_wen ? cvode_bouc_wen(b, s) : (*peer)(b, s));
  };
  const std::size_t all = job.samples();
  if (job.pulses) {
    const auto pulse = [](const Specimen& b, const Shaking& s) { return answer(pulse_peer(b, s, {})); };
    return {{&job, "freestand, packs", in_packs, false, all, {}, {}, {}},
            {&job, "freestand, one by one", one_by_one(scalar), false, all, {}, {}, {}},
            {&job, "(b) odeint dopri5", one_by_one(pulse), false, all, {}, {}, {}},
            {&job, "(c) dopri5, as accurate", AsAccurate(pulse_peer), false, all, {}, {}, {}}};
  }
  std::vector<Row> rows = {
      {&job, "freestand, packs", in_packs, false, all, {}, {}, {}},
      {&job, "freestand, one by one", one_by_one(scalar), false, all, {}, {}, {}},
      {&job, "(a) CVODE", one_by_one(cvode), true, job.for_cvode, {}, {}, {}},
      {&job, "(b) odeint dopri5", one_by_one(odeint), job.for_odeint < all, job.for_odeint, {}, {}, {}}};
  if (bouc_wen) return rows;
  rows.push_back({&job, "(c) dopri5, as accurate", AsAccurate(dopri5_peer), false, all, {}, {}, {}});
  rows.push_back({&job, "(d) fehlberg78, same", AsAccurate(fehlberg78_peer), false, all, {}, {}, {}});
  return rows;
}

// Collects the repetitions; the table is printed at the end.
class Collector : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(std::map<std::string, Row*> rows) : rows_(std::move(rows)) {}
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
        rows_.at(run.run_name.function_name)
            ->seconds.push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
  }

 private:
  std::map<std::string, Row*> rows_;
};

void print(const std::vector<Row>& rows) {
  std::printf("\n%-4s %-24s %12s %10s %8s %9s %9s %6s %6s %8s %8s %8s %8s\n", "job", "solver", "samples/s", "us/sample",
              "events", "error", "99 %", "flips", "failed", "to (a)", "to (b)", "to (c)", "to (d)");
  std::map<std::string, std::map<char, double>> peers;
  for (const Row& row : rows)
    if (row.solver[0] == '(' && !row.seconds.empty()) peers[row.job->name][row.solver[1]] = row.seconds_a_sample();
  for (const Row& row : rows) {
    if (row.seconds.empty()) continue;
    const double seconds = row.seconds_a_sample();
    const auto ratio = [&](char peer) { return peers[row.job->name][peer] / seconds; };
    std::printf("%-4s %-24s %12.0f %10.3f %8.1f %9.1e %9.1e %6d %6d %8.1f %8.1f %8.1f %8.1f\n", row.job->name.c_str(),
                row.solver.c_str(), 1 / seconds, 1e6 * seconds, row.accuracy.events, row.accuracy.median,
                row.accuracy.high, row.accuracy.flips, row.accuracy.failed, ratio('a'), ratio('b'), ratio('c'),
                ratio('d'));
  }
}

int run(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  char repetitions[] = "--benchmark_repetitions=7", interleaved[] = "--benchmark_enable_random_interleaving=true",
       time[] = "--benchmark_min_time=0.05";
  arguments.insert(arguments.begin() + 1, {repetitions, interleaved, time});
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());

  const char* wanted = std::getenv("FREESTAND_BENCH_SAMPLES");
  const auto records = benchmark_records(), pulses = benchmark_pulses();
  const auto jobs = benchmark_jobs(records, pulses, wanted ? std::strtoul(wanted, nullptr, 10) : 960);
  std::vector<Row> rows;
  for (const Job& job : jobs)
    for (Row& row : rows_of(job)) rows.push_back(std::move(row));

  std::map<std::string, Row*> by_name;
  for (Row& row : rows) {
    const std::string name = row.job->name + " " + row.solver;
    by_name[name] = &row;
    auto* registered = benchmark::RegisterBenchmark(name.c_str(), [&row](benchmark::State& state) {
      if (row.answers.empty() && !row.slow) row.solve(*row.job, row.count);  // what a first call does is not timed
      for (auto _ : state) row.answers = row.solve(*row.job, row.count);
    });
    if (row.slow) registered->Iterations(1)->Repetitions(1);
  }
  Collector collector(by_name);
  benchmark::RunSpecifiedBenchmarks(&collector);

  std::map<const Job*, std::vector<Answer>> truth;
  for (Row& row : rows) {
    if (row.seconds.empty()) continue;
    if (!truth.count(row.job)) truth[row.job] = tight_run(*row.job);
    row.accuracy = accuracy(*row.job, row.answers, truth[row.job]);
  }
  print(rows);
  return 0;
}

}  // namespace
}  // namespace freestand::bench

int main(int argc, char** argv) { return freestand::bench::run(argc, argv); }
