// What each effect costs, beside a peer: the slide-rock samples of job P3 (jobs.hpp) with one effect of the catalogue, or a
// law written as a formula, within its usual range; freestand in blocks as a sweep computes them, and inlined odeint dopri5
// with the same law written by hand (peer_laws.hpp), with one step a knot and with as many as make it as accurate.
//
//   build/release/benchmark_effects [samples [effect [only]]]        only: freestand alone, for a profiler
//   build/release/benchmark_effects samples "" histories             histories, as fits to measurements compute them: one by one, and
//                                                                    so many at once
//
// Processor time, medians of five runs in turns. Errors are medians over the samples of |demand - demand of a tight run|
// (tolerance 1e-13, one by one), relative to the latter; flips: another outcome.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "answers.hpp"
#include "effects/effects.hpp"
#include "formula/formula.hpp"
#include "support/medians.hpp"

namespace freestand::bench {
namespace {

constexpr int runs = 5;

// Where a range has zero in its middle, an effect vanishes there.
double usual(const dynamics::Parameter& p) {
  if (!p.fitted && p.fallback) return *p.fallback;
  return p.low > 0 ? std::sqrt(p.low * p.high) : p.low + 0.75 * (p.high - p.low);
}

std::vector<Specimen> with(const dynamics::Effect& effect, std::vector<Specimen> specimens) {
  EffectUse use{&effect, {}};
  for (const auto& parameter : effect.parameters) use.parameters.push_back(usual(parameter));
  for (Specimen& specimen : specimens) specimen.effects = {use};
  return specimens;
}

// A drag in proportion to the square of the velocity, as a study's formula.
const dynamics::Effect& drag_by_formula() {
  static const dynamics::Effect effect = [] {
    dynamics::Effect drag = formula::effect("quadratic_drag", "", "-c_per_m*v*abs(v)", {"c_per_m"});
    drag.parameters[0].low = drag.parameters[0].high = 2;
    return drag;
  }();
  return effect;
}

struct Timed {
  Solver solve;
  std::vector<double> microseconds = {};
  std::vector<Answer> answers = {};

  void run(const Job& job) {
    const std::clock_t start = std::clock();
    answers = solve(job, job.samples());
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    microseconds.push_back(1e6 * seconds / static_cast<double>(job.samples()));
  }
  double time() const { return test::median(microseconds); }
};

// Job P1 on records that move the floor in both horizontal directions, and the same under friction that differs between two.
std::vector<FloorMotion> plane_records() {
  const auto records = benchmark_records();
  std::vector<FloorMotion> pairs = records;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].cross_mps2 = records[(i + 7) % records.size()].horizontal_mps2;
    index_runs(pairs[i]);
  }
  return pairs;
}

Job plane_job(Job job, const std::vector<FloorMotion>& pairs, bool elliptic) {
  job.name = elliptic ? "ratio_across" : "two_directions";
  for (std::size_t i = 0; i < job.samples(); ++i) {
    job.shakings[i].motion = &pairs[i % pairs.size()];
    if (elliptic) job.specimens[i].friction.ratio_across = 0.7, job.specimens[i].friction.axis_rad = 0.2;
  }
  return job;
}

void tell(const Job& job, Peer peer, bool alone) {
  auto as_accurate = std::make_shared<AsAccurate>(peer);
  const auto plain = [peer](const Specimen& b, const Shaking& s) { return answer(peer(b, s, {})); };
  std::vector<Timed> solvers = {{in_packs}};
  if (peer && !alone) {
    solvers.push_back({one_by_one(plain)});
    solvers.push_back({[as_accurate](const Job& on, std::size_t count) { return (*as_accurate)(on, count); }});
    solvers.back().solve(job, job.samples());  // finds its steps
  }
  for (int i = 0; i < runs; ++i)
    for (Timed& solver : solvers) solver.run(job);
  std::printf("%-22s %8.1f", job.name.c_str(), solvers[0].time());
  if (alone) return static_cast<void>(std::printf(" us a sample\n"));
  const auto truth = tight_run(job);
  const Accuracy own = accuracy(job, solvers[0].answers, truth);
  std::printf(" %8.0e %3d/%-3d", own.median, own.flips, own.failed);
  for (std::size_t i = 1; i < solvers.size(); ++i) {
    const Accuracy of = accuracy(job, solvers[i].answers, truth);
    std::printf(" | %8.1f %8.0e %3d/%-3d %6.1f", solvers[i].time(), of.median, of.flips, of.failed,
                solvers[i].time() / solvers[0].time());
  }
  std::printf(solvers.size() > 1 ? " %3d\n" : "\n", as_accurate->steps().per_knot);
  std::fflush(stdout);
}

// With a history of each, in steps of 5 ms, so many at once.
double time_of_histories(const Job& job, std::size_t at_once) {
  const Settings settings{.tolerance = 1e-8, .free_vibration_s = 0};
  thread_local std::vector<History> histories;  // kept, as fits keep theirs
  histories.resize(at_once);
  std::vector<Response> responses(at_once);
  const std::clock_t start = std::clock();
  for (std::size_t i = 0; i + at_once <= job.samples(); i += at_once)
    respond_batch(std::span(job.specimens).subspan(i, at_once), std::span(job.shakings).subspan(i, at_once), settings,
                  responses, histories);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return 1e6 * seconds / static_cast<double>(job.samples() / at_once * at_once);
}

void tell_histories(const Job& job) {
  constexpr std::size_t sizes[] = {1, 7, 30};  // alone, the tests of a laboratory, those and several models
  std::vector<double> times[std::size(sizes)];
  for (int i = 0; i < runs; ++i)
    for (std::size_t k = 0; k < std::size(sizes); ++k) times[k].push_back(time_of_histories(job, sizes[k]));
  std::printf("%-22s", job.name.c_str());
  const double alone = test::median(times[0]);
  for (std::size_t k = 0; k < std::size(sizes); ++k)
    std::printf(" | %2zu at once %8.1f us %5.2f", sizes[k], test::median(times[k]), alone / test::median(times[k]));
  std::printf("\n");
  std::fflush(stdout);
}

void tell_all(std::size_t samples, const std::string& only, const std::string& what) {
  const bool alone = what == "only", histories = what == "histories";
  const auto records = benchmark_records(0.6), pulses = benchmark_pulses();
  const Job job = benchmark_jobs(records, pulses, samples)[2];
  if (!alone && !histories)
    std::printf("%-22s %8s %8s %7s | %-33s | %-33s\n%-22s %8s %8s %7s | %8s %8s %7s %6s | %8s %8s %7s %6s %s\n", "",
                "freestand", "", "", "dopri5, one step a knot", "dopri5, as accurate", "effect", "us", "error",
                "fl/fail", "us", "error", "fl/fail", "ratio", "us", "error", "fl/fail", "ratio", "steps");
  const auto row = [&](const std::string& name, std::vector<Specimen> specimens) {
    if (!only.empty() && name != only) return;
    Job on = job;
    on.name = name;
    on.specimens = std::move(specimens);
    histories ? tell_histories(on) : tell(on, law_peer(name), alone);
  };
  row("none", job.specimens);
  for (const dynamics::Effect& effect : effects::all()) row(effect.name, with(effect, job.specimens));
  row(drag_by_formula().name, with(drag_by_formula(), job.specimens));
  if (histories) return;
  const auto pairs = plane_records();
  for (const bool elliptic : {false, true}) {
    const Job in_plane = plane_job(benchmark_jobs(records, pulses, samples)[0], pairs, elliptic);
    if (only.empty() || in_plane.name == only) tell(in_plane, plane_peer, alone);
  }
}

}  // namespace
}  // namespace freestand::bench

int main(int argc, char** argv) {
  freestand::bench::tell_all(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 960, argc > 2 ? argv[2] : "",
                             argc > 3 ? argv[3] : "");
  return 0;
}
