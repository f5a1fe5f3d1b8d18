#include "jobs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/units.hpp"
#include "effects/effects.hpp"
#include "motion/pulse.hpp"
#include "support/keyed_random.hpp"

namespace freestand::bench {
namespace {

using test::KeyedRandom;

constexpr std::size_t record_count = 20, record_points = 4001;
constexpr double record_step_s = 0.005;

// Build-up over 2 s, plateau to 8 s, exponential decay.
double envelope(double t) {
  if (t < 2) return (t / 2) * (t / 2);
  return t < 8 ? 1 : std::exp(-0.45 * (t - 8));
}

std::vector<double> record_values(KeyedRandom& random) {
  const double wg = 2 * pi * random.log_uniform(1.5, 5), zg = random.uniform(0.3, 0.7);  // ground
  const double wf = 2 * pi * 0.25, zf = 0.8;                                             // takes the drift out
  const double h = record_step_s;
  double x = 0, v = 0, y = 0, u = 0;
  std::vector<double> a(record_points);
  for (std::size_t i = 0; i < record_points; ++i) {
    const double noise = random.normal() * envelope(static_cast<double>(i) * h);
    v = (v + h * (noise - wg * wg * x)) / (1 + 2 * zg * wg * h);
    x += h * v;
    const double ground = 2 * zg * wg * v + wg * wg * x;
    const double before = u;
    u = (u + h * (ground - wf * wf * y)) / (1 + 2 * zf * wf * h);
    y += h * u;
    a[i] = (u - before) / h;
  }
  return a;
}

void scale_to_peak(std::vector<double>& a, double peak) {
  double most = 0;
  for (const double value : a) most = std::max(most, std::abs(value));
  for (double& value : a) value *= peak / most;
}

void add_pulse(KeyedRandom& random, std::vector<double>& a) {
  const double period = random.log_uniform(0.5, 2.5), start = random.uniform(2, 5), height = random.uniform(0.5, 1.2);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double t = static_cast<double>(i) * record_step_s - start;
    if (t > 0 && t < period) a[i] += height * std::sin(2 * pi * t / period);
  }
}

Block random_block(KeyedRandom& random) {
  const double alpha = random.uniform(0.12, 0.4), size = random.log_uniform(0.6, 3);
  return Block::rectangular(2 * size * std::sin(alpha), 2 * size * std::cos(alpha), 100);
}

void random_specimen(KeyedRandom& random, Model model, Specimen& specimen, double& threshold) {
  specimen.model = model;
  specimen.block = random_block(random);
  const double slenderness = std::tan(specimen.block.alpha_rad());
  double mu_k = random.uniform(0.05, 0.5);
  if (model == Model::slide_rock) mu_k = slenderness * random.uniform(0.6, 2.0);
  const double ratio = random.chance(0.5) ? 1.0 : random.uniform(1, 1.3);
  specimen.friction = {ratio * mu_k, mu_k};
  specimen.impact = {ImpactLaw::housner, random.chance(0.5) ? 1.0 : random.uniform(0.8, 1)};
  threshold = model == Model::slide  ? specimen.friction.mu_s
              : model == Model::rock ? slenderness
                                     : std::min(specimen.friction.mu_s, slenderness);
}

Job make_job(const char* name, const char* title, Model model, std::uint64_t seed, double most,
             const std::vector<FloorMotion>& records, std::size_t samples) {
  Job job{name, title, std::vector<Specimen>(samples), std::vector<Shaking>(samples), {}, samples, samples};
  if (model != Model::rock) job.demands.push_back("slip");
  if (model != Model::slide) job.demands.push_back("rotation");
  for (std::size_t i = 0; i < samples; ++i) {
    KeyedRandom random(seed, i);
    double threshold = 0;
    random_specimen(random, model, job.specimens[i], threshold);
    const double peak = standard_gravity_mps2 * threshold * random.log_uniform(0.9, most);
    job.shakings[i] = {&records[i % records.size()], random.chance(0.5) ? peak : -peak};
  }
  return job;
}

Job bouc_wen_job(const char* name, const char* title, double yield_m, std::size_t for_cvode, std::size_t for_odeint,
                 const std::vector<FloorMotion>& records, std::size_t samples) {
  Job job = make_job(name, title, Model::slide, 4, 5, records, samples);
  for (Specimen& specimen : job.specimens) {
    specimen.model = Model::bouc_wen;
    specimen.bouc_wen = {yield_m, 20, 0.5, 0.5};
    specimen.friction.mu_s = specimen.friction.mu_k;
  }
  job.for_cvode = std::min(for_cvode, samples);
  job.for_odeint = std::min(for_odeint, samples);
  return job;
}

Job pulse_job(const char* name, const char* title, Model model, std::uint64_t seed, double most,
              const std::vector<FloorMotion>& pulses, std::size_t samples) {
  Job job = make_job(name, title, model, seed, most, pulses, samples);
  job.pulses = true;
  for (std::size_t i = 0; i < samples; ++i)
    job.shakings[i].stretch = KeyedRandom(seed, samples + i).log_uniform(0.2, 2);
  return job;
}

Job effects_job(const std::vector<FloorMotion>& records, std::size_t samples) {
  Job job = make_job("P5", "slide-rock with effects", Model::slide_rock, 5, 3, records, samples);
  for (std::size_t i = 0; i < samples; ++i) {
    KeyedRandom random(6, i);
    job.specimens[i].effects = {
        {effects::find("static_friction"), {random.uniform(1.05, 1.4)}},
        {effects::find("rate_weakening"), {random.uniform(0.1, 0.4), random.uniform(0.05, 0.5)}},
        {effects::find("impact_loss"), {random.uniform(0.8, 1)}}};
  }
  job.for_cvode = std::min<std::size_t>(240, samples);
  return job;
}

}  // namespace

std::vector<FloorMotion> benchmark_records(double vertical_share) {
  std::vector<std::vector<double>> channels;
  for (std::size_t i = 0; i < record_count; ++i) {
    KeyedRandom random(20, i);
    auto values = record_values(random);
    scale_to_peak(values, 1);
    if (i % 2 == 1) add_pulse(random, values);
    scale_to_peak(values, 1);
    channels.push_back(values);
  }
  std::vector<FloorMotion> records;
  for (std::size_t i = 0; i < record_count; ++i) {
    std::vector<double> vertical;
    if (vertical_share > 0)
      for (const double value : channels[(i + record_count / 2) % record_count])
        vertical.push_back(vertical_share * value);
    records.push_back(piecewise_linear("record " + std::to_string(i), record_step_s, channels[i], vertical));
  }
  return records;
}

std::vector<FloorMotion> benchmark_pulses() {
  std::vector<FloorMotion> pulses;
  for (const char* name : {"A", "B", "C1", "C2", "ricker"})
    pulses.push_back(motion::pulse_motion(motion::find_pulse(name)));
  return pulses;
}

std::vector<Job> benchmark_jobs(const std::vector<FloorMotion>& records, const std::vector<FloorMotion>& pulses,
                                std::size_t samples) {
  return {make_job("P1", "sliding", Model::slide, 1, 5, records, samples),
          make_job("P2", "rocking", Model::rock, 2, 3, records, samples),
          make_job("P3", "slide-rock", Model::slide_rock, 3, 3, records, samples),
          bouc_wen_job("P4", "Bouc-Wen", 2.54e-3, 24, samples, records, samples),
          bouc_wen_job("P4s", "Bouc-Wen, stiff", 2.54e-7, 2, 4, records, std::min<std::size_t>(16, samples)),
          effects_job(records, samples),
          pulse_job("P6", "sliding, pulses", Model::slide, 7, 5, pulses, samples),
          pulse_job("P7", "rocking, pulses", Model::rock, 8, 3, pulses, samples),
          pulse_job("P8", "slide-rock, pulses", Model::slide_rock, 9, 3, pulses, samples)};
}

}  // namespace freestand::bench
