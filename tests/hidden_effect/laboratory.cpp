#include "hidden_effect/laboratory.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace freestand::test {
namespace {

constexpr double correlation_s = 0.3, friction_deviation = 0.06;

// Of the first order, with the deviation given and the correlation exp(-t/correlation_s).
std::vector<double> coloured(KeyedRandom& random, std::size_t count, double deviation, double dt_s) {
  const double kept = std::exp(-dt_s / correlation_s), fresh = std::sqrt(1 - kept * kept);
  std::vector<double> noise;
  for (double last = deviation * random.normal(); noise.size() < count;
       last = kept * last + fresh * deviation * random.normal())
    noise.push_back(last);
  return noise;
}

void add(std::vector<double>& to, const std::vector<double>& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

void colour(MadeSet& set, KeyedRandom& random) {
  for (MadeTest& test : set.tests) {
    test.slip_m = test.truth.slip_m;
    add(test.slip_m, coloured(random, test.slip_m.size(), set.slip_noise_m, test.floor.dt_s));
    if (test.rotation_rad.empty()) continue;
    test.rotation_rad = test.truth.rotation_rad;
    add(test.rotation_rad, coloured(random, test.rotation_rad.size(), set.rotation_noise_rad, test.floor.dt_s));
  }
}

void drift(MadeSet& set, KeyedRandom& random) {
  for (MadeTest& test : set.tests) {
    const double end_m = (random.chance(0.5) ? 1 : -1) * random.uniform(3, 6) * set.slip_noise_m;
    const auto n = static_cast<double>(test.slip_m.size());
    for (std::size_t i = 0; i < test.slip_m.size(); ++i) test.slip_m[i] += end_m * static_cast<double>(i) / n;
  }
}

void misread_floor(MadeSet& set, KeyedRandom& random) {
  const double gain = 1 + (random.chance(0.5) ? 1 : -1) * random.uniform(0.01, 0.03);
  for (MadeTest& test : set.tests)
    for (double& value : test.measured_floor.horizontal_mps2) value *= gain;
}

// The first tests only, or all: those responses are written as if they came so much later, or sooner.
void shift_clock(MadeSet& set, KeyedRandom& random, std::size_t tests) {
  const double behind_s = (random.chance(0.5) ? 1 : -1) * random.uniform(0.01, 0.025);
  for (std::size_t i = 0; i < std::min(tests, set.tests.size()); ++i)
    for (std::vector<double>* samples : {&set.tests[i].slip_m, &set.tests[i].rotation_rad}) {
      const std::vector<double> before = *samples;
      const long steps = std::lround(behind_s / set.tests[i].floor.dt_s), last = static_cast<long>(before.size()) - 1;
      for (long k = 0; k <= last; ++k)
        (*samples)[static_cast<std::size_t>(k)] = before[static_cast<std::size_t>(std::clamp(k - steps, 0L, last))];
    }
}

// What the specimen does with the friction of that test, and the sensors' noise as it was. A test that would overturn
// keeps the friction of the set.
void scatter_friction(MadeSet& set, KeyedRandom& random, double step_s) {
  for (MadeTest& test : set.tests) {
    const double factor = std::exp(friction_deviation * random.normal());
    Truth truth = set.drawn.truth;
    truth.mu_k *= factor;
    truth.mu_s *= factor;
    TruthHistory other = simulate(truth, test.floor, step_s);
    if (other.outcome == "overturned" || other.outcome == "painleve") continue;
    for (std::size_t i = 0; i < test.slip_m.size(); ++i) test.slip_m[i] += other.slip_m[i] - test.truth.slip_m[i];
    for (std::size_t i = 0; i < test.rotation_rad.size(); ++i)
      test.rotation_rad[i] += other.rotation_rad[i] - test.truth.rotation_rad[i];
    test.truth = std::move(other);
  }
}

}  // namespace

const std::vector<std::string>& laboratory_faults() {
  static const std::vector<std::string> all{
      "coloured_noise",   "drift",      "gain",           "wrong_width", "friction_scatter", "understated_noise",
      "overstated_noise", "late_clock", "one_late_clock", "no_filter"};
  return all;
}

void spoil(MadeSet& set, const std::string& fault, KeyedRandom random, double step_s) {
  const auto& all = laboratory_faults();
  if (std::find(all.begin(), all.end(), fault) == all.end())
    throw std::invalid_argument("no fault of a laboratory is called " + fault);
  set.name += "-" + fault;
  set.fault = fault;
  if (fault == "coloured_noise") colour(set, random);
  if (fault == "drift") drift(set, random);
  if (fault == "gain") misread_floor(set, random);
  if (fault == "wrong_width") set.stated_width = random.chance(0.5) ? 1.02 : 0.98;
  if (fault == "friction_scatter") scatter_friction(set, random, step_s);
  if (fault == "understated_noise") set.stated_noise = 0.5;
  if (fault == "overstated_noise") set.stated_noise = 2;
  if (fault == "late_clock") shift_clock(set, random, set.tests.size());
  if (fault == "one_late_clock") shift_clock(set, random, 1);
}

}  // namespace freestand::test
