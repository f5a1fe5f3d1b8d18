// What each effect costs: the slide-rock samples of job P3 (jobs.hpp) with one effect of the catalogue, within its usual
// range, in blocks as a sweep computes them, beside the same samples without it, in packs and one by one.
//
//   build/release/benchmark_effects [samples [effect [only]]]        only: its row alone, for a profiler
//
// Processor time, medians of five runs in turns.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "effects/effects.hpp"
#include "jobs.hpp"
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

struct Row {
  const char* name;
  std::vector<Specimen> specimens;
  bool alone;  // one by one
  std::vector<double> microseconds;
};

void run(Row& row, const std::vector<Shaking>& shakings) {
  std::vector<Response> responses(shakings.size());
  const std::clock_t start = std::clock();
  if (row.alone)
    for (std::size_t i = 0; i < shakings.size(); ++i) responses[i] = respond(row.specimens[i], shakings[i]);
  else
    respond_batch(row.specimens, shakings, {}, responses);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  row.microseconds.push_back(1e6 * seconds / static_cast<double>(shakings.size()));
}

void tell(std::size_t samples, const std::string& only, bool alone) {
  const auto records = benchmark_records(0.6);
  const Job job = benchmark_jobs(records, samples)[2];
  std::vector<Row> rows = {{"none, in packs", job.specimens, false, {}}, {"none, one by one", job.specimens, true, {}}};
  for (const dynamics::Effect& effect : effects::all())
    if (only.empty() || effect.name == only)
      rows.push_back({effect.name.c_str(), with(effect, job.specimens), false, {}});
  if (alone) rows.erase(rows.begin(), rows.begin() + 2);
  for (int i = 0; i < runs; ++i)
    for (Row& row : rows) run(row, job.shakings);
  if (alone)
    return static_cast<void>(std::printf("%s: %.1f us a sample\n", only.c_str(), test::median(rows[0].microseconds)));

  std::printf("%-22s %14s %14s %18s\n", "effect", "us a sample", "to packs", "to one by one");
  const double packs = test::median(rows[0].microseconds), singly = test::median(rows[1].microseconds);
  for (const Row& row : rows) {
    const double time = test::median(row.microseconds);
    std::printf("%-22s %14.1f %+12.0f %% %+16.0f %%\n", row.name, time, 100 * (time / packs - 1),
                100 * (time / singly - 1));
  }
}

}  // namespace
}  // namespace freestand::bench

int main(int argc, char** argv) {
  freestand::bench::tell(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 960, argc > 2 ? argv[2] : "", argc > 3);
  return 0;
}
