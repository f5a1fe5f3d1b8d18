#include "dynamics/batch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <optional>
#include <vector>

#include "base/units.hpp"
#include "dynamics/bouc_wen.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/law_lanes.hpp"
#include "dynamics/linear_pull.hpp"
#include "dynamics/overturned.hpp"
#include "dynamics/restraints.hpp"
#include "dynamics/simulate.hpp"

namespace freestand::dynamics {

// kernel_levels.inc is written by module.cmake: FREESTAND_KERNELS(v2) and so on, the narrowest first.
#define FREESTAND_KERNELS(ISA)       \
  namespace ISA {                    \
  extern const BatchKernels kernels; \
  }
#include "kernel_levels.inc"
#undef FREESTAND_KERNELS

namespace {

#define FREESTAND_KERNELS(ISA) &ISA::kernels,
constexpr const BatchKernels* compiled[] = {
#include "kernel_levels.inc"
};
#undef FREESTAND_KERNELS

// v2 and `own` are what the whole program is compiled for.
bool this_machine_has(const BatchKernels& kernels) {
  const bool v4 = !std::strcmp(kernels.name, "v4"), v3 = v4 || !std::strcmp(kernels.name, "v3");
  __builtin_cpu_init();
  return (!v3 || (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))) &&
         (!v4 || (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                  __builtin_cpu_supports("avx512cd")));
}

}  // namespace

const BatchKernels* batch_kernels() {
  const char* wanted = std::getenv("FREESTAND_ISA");
  if (wanted && !std::strcmp(wanted, "scalar")) return nullptr;
  const BatchKernels* widest = compiled[0];
  for (const BatchKernels* kernels : compiled)
    if (this_machine_has(*kernels) && (!wanted || !std::strcmp(wanted, kernels->name))) widest = kernels;
  return widest;
}

namespace {

// That the packs keep; where friction follows a law, a spring or a drag pulls, and of Bouc-Wen's contact.
constexpr double least_tolerance = 1e-13, least_of_laws = 1e-10;
constexpr double endless_base = 1e6;  // half of it, times the height: a block that only slides

bool covered_bouc_wen(const Specimen& specimen, const Shaking& shaking, const FloorInput& floor,
                      const Settings& settings, BatchCase& c) {
  if (!admissible_bouc_wen(specimen, shaking, floor, settings) || !(specimen.friction.mu_k > 0)) return false;
  c = {};
  c.table = shaking.motion->table.get();
  c.scale = shaking.scale;
  c.g = standard_gravity_mps2 * floor.gravity_factor;
  c.free_vibration_s = settings.free_vibration_s;
  c.contact = bouc_wen_contact(specimen.friction.mu_k, specimen.bouc_wen, settings.tolerance);
  c.tolerance = settings.tolerance;
  const double ringing = std::sqrt(c.contact.strength * c.g / c.contact.yield);
  return c.contact.kappa == 0 && c.table->step_s * ringing < 500;
}

// Series about the start of a step see nothing of an exponential that grows by more than e^30 within it: their last terms,
// z^8/8! e^-z at z = 30, would be as small as what they neglect. Then the single samples are right, which look at the end
// of their steps too.
constexpr double largest_exponent = 30;

bool too_steep(const SlipLaw& law, const Specimen& specimen, const Shaking& shaking) {
  const MotionTable& t = *shaking.motion->table;
  const double push = std::abs(shaking.scale) * t.later_peak[0];
  // In a step the slip speed changes by the floor, by friction, and by as much again where the block turns.
  const double change = 2 * t.step_s * (push + (1 + specimen.friction.mu_s) * standard_gravity_mps2);
  return steepest_exponent(law, change, t.step_s) > largest_exponent;
}

// Kernels know vertical shaking, or a slope, or a pull along the floor, of a block that slides, under constant friction.
bool floor_covered(const Specimen& specimen, const Shaking& shaking, bool law, bool shaken, bool slopes, bool pulled) {
  const bool slides = specimen.model == Model::slide_rock || specimen.model == Model::slide;
  if (shaken && shaking.motion->table->vertical.empty()) return false;
  const int kinds = shaken + slopes + pulled;
  return kinds == 0 || (kinds == 1 && slides && !law);
}

// The packs' bounds rest on what bends little within an interval: a pull whose terms fall as 1/k! at least.
bool too_stiff(const LinearPull& pull, const Shaking& shaking) {
  const double step = shaking.motion->table->step_s;
  return !(std::sqrt(pull.stiffness) * step < 1 && pull.drag * step < 1);
}

// The laws as kernels know them, in `law` or `pull`; false: they are others.
bool laws_covered(const Specimen& specimen, const Shaking& shaking, std::optional<SlipLaw>& law,
                  std::optional<LinearPull>& pull) {
  if (!has_laws(specimen)) return true;
  if (specimen.model == Model::bouc_wen) return false;
  const Laws laws(specimen);
  law = slip_law(laws);
  if (law) return !too_steep(*law, specimen, shaking);
  pull = linear_pull(laws);
  return pull && !too_stiff(*pull, shaking);
}

// False: no kernel covers it. `law`: of friction, where it has one. Of a block that only slides nothing else is set than
// its kernel asks for.
bool covered(const Specimen& specimen, const Shaking& shaking, const FloorInput& floor, const Settings& settings,
             BatchCase& c, std::optional<SlipLaw>& law) {
  if (!shaking.motion || !shaking.motion->table || shaking.stretch != 1 || settings.slip_by_side) return false;
  std::optional<LinearPull> pull;
  if (!laws_covered(specimen, shaking, law, pull)) return false;
  const bool shaken = shaking.vertical_scale != 0 && !shaking.motion->vertical_mps2.empty(),
             slopes = floor.push_mps2 != 0;
  if (!floor_covered(specimen, shaking, law.has_value(), shaken, slopes, pull.has_value())) return false;
  const bool exact = !law && !pull && specimen.model != Model::bouc_wen;
  if (settings.tolerance < (exact ? least_tolerance : least_of_laws) || settings.event_limit < 10000) return false;
  if (specimen.model == Model::bouc_wen) return covered_bouc_wen(specimen, shaking, floor, settings, c);
  if (!admissible(specimen, shaking, floor, settings)) return false;
  if (specimen.model == Model::slide && exact && !shaken && !slopes) {
    c.table = shaking.motion->table.get();
    c.scale = shaking.scale;
    c.vertical_scale = 0;
    c.law = nullptr;
    c.stiffness = c.drag = 0;
    c.mu_s = specimen.friction.mu_s;
    c.mu_k = specimen.friction.mu_k;
    c.g = standard_gravity_mps2 * floor.gravity_factor;
    c.along = 0;
    c.free_vibration_s = settings.free_vibration_s;
    return true;
  }
  const bool coulomb = specimen.impact.law == ImpactLaw::coulomb;
  if (coulomb && law) return false;
  const Rig rig(specimen, settings, floor);
  c = {shaking.motion->table.get(),
       shaking.scale,
       shaken ? shaking.vertical_scale : 0.0,
       rig.right,
       rig.left,
       rig.h,
       rig.k2,
       rig.mu_s,
       rig.mu_k,
       rig.g,
       rig.push,
       coulomb ? 1 : rig.impact.factor,
       rig.rest_rotation,
       rig.told_rotation,
       settings.free_vibration_s,
       {},
       settings.tolerance,
       coulomb,
       nullptr};
  if (pull) c.stiffness = pull->stiffness, c.drag = pull->drag;
  if (specimen.model == Model::slide) c.left = c.right = endless_base * c.h;
  return true;
}

// The same for a sample as it was given. Effects change a copy of it first.
bool covered(const Specimen& specimen, const Shaking& shaking, const Settings& settings, BatchCase& c,
             std::optional<SlipLaw>& law) {
  if (specimen.effects.empty()) return covered(specimen, shaking, {}, settings, c, law);
  const Setup setup = set_up(specimen, shaking);
  return covered(setup.specimen, setup.shaking, setup.floor, settings, c, law);
}

// Length of a step, times p, up to which the closed step (order 7 of the rate) and the series of order 9 are good for
// every tolerance down to the first one given here; below it they shrink, as the first term left out must.
constexpr double fine_step = 0.06, coarse_step = 0.15, good_for = 1e-10;

double longest_step(double step, int order, double tolerance) {
  return tolerance < good_for ? step * std::pow(tolerance / good_for, 1.0 / (order + 1)) : step;
}

double step_in_own_time(const BatchCase& c) {
  const double size = std::hypot(c.h, std::fmin(c.left, c.right));
  return c.table->step_s * std::sqrt(c.g * size / (c.k2 + size * size));
}

// Null: one by one.
BatchKernel kernel_of(const BatchKernels& kernels, const Specimen& specimen, const BatchCase& c, bool law) {
  const bool shaken = c.vertical_scale != 0, pulled = c.stiffness != 0 || c.drag != 0;
  if (specimen.model == Model::slide)
    return pulled         ? kernels.slide_rock_pulled
           : shaken       ? kernels.slide_rock_shaken
           : law          ? kernels.slide_rock_by_slip
           : c.along != 0 ? kernels.slide_rock
                          : kernels.slide;
  if (specimen.model == Model::bouc_wen) return kernels.bouc_wen;
  if (specimen.model != Model::rock && specimen.model != Model::slide_rock) return nullptr;
  const double step = step_in_own_time(c);
  if (!(step < longest_step(coarse_step, 9, c.tolerance))) return nullptr;
  const bool fine = step < longest_step(fine_step, 7, c.tolerance);
  if (specimen.model == Model::rock) return fine ? kernels.rock : kernels.rock_coarse;
  if (pulled) return fine ? kernels.slide_rock_pulled : kernels.slide_rock_pulled_coarse;
  if (shaken) return fine ? kernels.slide_rock_shaken : kernels.slide_rock_shaken_coarse;
  if (law) return fine ? kernels.slide_rock_by_slip : kernels.slide_rock_by_slip_coarse;
  return fine ? kernels.slide_rock : kernels.slide_rock_coarse;
}

Response without_fall(Response response, const BatchCase& c) {
  if (response.outcome == Outcome::overturned)
    leave_out_fall(response, 0.5 * (c.left + c.right), response.residual_rotation_rad < 0 ? c.left : c.right, c.h, 0);
  return response;
}

struct Queue {
  BatchKernel kernel = nullptr;
  std::vector<BatchCase> cases = {};
  std::deque<SlipLaw> laws = {};     // of the cases, one each or none at all
  std::vector<std::size_t> at = {};  // which sample each is
};

class Queues {
 public:
  explicit Queues(std::size_t capacity) : capacity_(capacity) {}

  void add(BatchKernel kernel, const BatchCase& c, const std::optional<SlipLaw>& law, std::size_t sample) {
    Queue& queue = find(kernel, law);
    queue.cases.push_back(c);
    queue.at.push_back(sample);
    if (law) queue.cases.back().law = &queue.laws.emplace_back(*law);
  }

  // Samples that a kernel declined, or that their restraints would have held, are added to `single`. The queues are empty then.
  void compute(std::span<const Specimen> specimens, std::span<Response> responses, std::vector<std::size_t>& single) {
    for (Queue& queue : queues_) {
      const std::size_t count = queue.at.size();
      answers_.resize(std::max(count, answers_.size()));
      declined_.assign(count, 0);
      queue.kernel(queue.cases.data(), count, answers_.data(), declined_.data());
      for (std::size_t i = 0; i < count; ++i)
        if (declined_[i] || !stays_clear(specimens[queue.at[i]], answers_[i].peak_slip_m))
          single.push_back(queue.at[i]);
        else
          responses[queue.at[i]] = without_fall(answers_[i], queue.cases[i]);
      queue.cases.clear();
      queue.laws.clear();
      queue.at.clear();
    }
  }

 private:
  // The queue of those that go through the kernel together.
  Queue& find(BatchKernel kernel, const std::optional<SlipLaw>& law) {
    for (Queue& queue : queues_)
      if (queue.kernel == kernel && (!law || queue.laws.empty() || same_shape(queue.laws.front(), *law))) return queue;
    Queue& queue = queues_.emplace_back(Queue{kernel});
    queue.cases.reserve(capacity_);
    queue.at.reserve(capacity_);
    return queue;
  }

  std::size_t capacity_;      // samples between two calls of compute()
  std::deque<Queue> queues_;  // which stay where they are, as cases point to laws
  std::vector<Response> answers_;
  std::vector<std::uint8_t> declined_;
};

// As many samples as stay in the cache with all that belongs to them, those of one record next to each other.
constexpr std::size_t group = 2048;

void sort_by_record(std::span<const Shaking> shakings, std::vector<std::size_t>& order) {
  constexpr std::size_t bins = 64;
  const auto bin = [&](std::size_t i) {
    return static_cast<std::size_t>(
        (reinterpret_cast<std::uintptr_t>(shakings[i].motion) >> 4) * 0x9e3779b97f4a7c15ULL >> 58);
  };
  std::size_t starts[bins + 1] = {};
  for (std::size_t i = 0; i < shakings.size(); ++i) ++starts[bin(i) + 1];
  for (std::size_t k = 0; k < bins; ++k) starts[k + 1] += starts[k];
  order.resize(shakings.size());
  for (std::size_t i = 0; i < shakings.size(); ++i) order[starts[bin(i)]++] = i;
}

// No pack begins on its way, has a neighbour or legs that give way, or follows a point or forces.
bool goes_alone(const Specimen& specimen, const Settings& settings) {
  return !specimen.start.upright_at_rest() || specimen.neighbour || specimen.legs ||
         !std::isnan(settings.acceleration_height_m) || settings.contact_forces;
}

}  // namespace

std::size_t respond_and_count(std::span<const Specimen> specimens, std::span<const Shaking> shakings,
                              const Settings& settings, std::span<Response> responses, std::span<History> histories) {
  const BatchKernels* kernels = batch_kernels();
  Queues queues(std::min(group, specimens.size()));
  std::vector<std::size_t> single, alone, order;
  BatchCase c{};
  std::optional<SlipLaw> law;
  for (std::size_t first = 0; first < specimens.size(); first += group) {
    sort_by_record(shakings.subspan(first, std::min(group, specimens.size() - first)), order);
    for (const std::size_t place : order) {
      const std::size_t i = first + place;
      law.reset();
      if (goes_alone(specimens[i], settings)) {
        alone.push_back(i);
        continue;
      }
      bool packs = kernels && histories.empty();
      if (packs) {
        const std::optional<Specimen> without = unrestrained(specimens[i]);
        packs = covered(without ? *without : specimens[i], shakings[i], settings, c, law);
      }
      if (const BatchKernel kernel = packs ? kernel_of(*kernels, specimens[i], c, law.has_value()) : nullptr)
        queues.add(kernel, c, law, i);
      else
        single.push_back(i);
    }
    queues.compute(specimens, responses, single);
  }
  std::vector<std::size_t> under_laws;
  for (const std::size_t i : single) {
    const bool lanes = kernels && goes_in_law_lanes(set_up(specimens[i], shakings[i]), settings);
    (lanes ? under_laws : alone).push_back(i);
  }
  // Two histories go no faster together.
  if (!histories.empty() && under_laws.size() <= 2)
    alone.insert(alone.end(), under_laws.begin(), under_laws.end()), under_laws.clear();
  if (!under_laws.empty())
    respond_in_law_lanes(*kernels, specimens, shakings, settings, under_laws, responses, histories);
  for (const std::size_t i : alone)
    responses[i] = respond_on_line(specimens[i], shakings[i], settings, histories.empty() ? nullptr : &histories[i]);
  return alone.size();
}

}  // namespace freestand::dynamics
