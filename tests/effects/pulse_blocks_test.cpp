// Pulses in blocks of samples: each sample has the bits of the one computed alone, in any company and with any instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "dynamics/batch.hpp"
#include "effects/mixture.hpp"
#include "motion/pulse.hpp"
#include "support/isa.hpp"

namespace freestand::test {
namespace {

struct PulseSamples {
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;

  std::string text(std::size_t i) const {
    std::string text = std::to_string(i) + ": " + model_names[static_cast<int>(specimens[i].model)];
    text += ", pulse " + shakings[i].motion->name + (shakings[i].vertical_scale != 0 ? " with a vertical channel" : "");
    for (const EffectUse& use : specimens[i].effects) text += ", " + use.effect->name;
    return text;
  }
};

// Every pulse; the last one shakes vertically too, which packs of pulses do not know.
std::vector<FloorMotion> every_pulse() {
  std::vector<FloorMotion> pulses;
  for (const char* name : {"A", "B", "C1", "C2", "C5", "rectangular", "square", "ricker", "ricker_antisymmetric"})
    pulses.push_back(motion::pulse_motion(motion::find_pulse(name)));
  FloorMotion both = pulses[0];
  both.vertical_mps2 = pulses[1].horizontal_mps2;
  index_runs(both);
  pulses.push_back(both);
  return pulses;
}

// Models, impact laws and pulses in turn; of every four samples two have no effect, one stands on a slope, one has several effects.
PulseSamples draw_samples(std::size_t count, const std::vector<FloorMotion>& pulses) {
  constexpr Model models[] = {Model::slide, Model::rock, Model::slide_rock};
  PulseSamples samples;
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(151, i);
    Specimen specimen;
    specimen.model = models[i % 3];
    const double alpha = random.uniform(0.1, 0.6), size = random.log_uniform(0.4, 3);
    specimen.block = Block::rectangular(2 * size * std::sin(alpha), 2 * size * std::cos(alpha), 100);
    if (random.chance(0.2)) specimen.block.left_m *= random.uniform(0.7, 1);
    const double slenderness = std::tan(alpha), mu = slenderness * random.uniform(0.5, 2);
    specimen.friction = {random.chance(0.5) ? mu : mu * random.uniform(1, 1.3), mu};
    specimen.impact.law = random.chance(0.3) ? ImpactLaw::coulomb : ImpactLaw::housner;
    if (i / 3 % 4 == 2) specimen.effects = {{effects::find("floor_tilt"), {random.uniform(-0.05, 0.05)}}};
    if (i / 3 % 4 == 3 && specimen.model != Model::rock) specimen.effects = mixture(random, specimen.model);
    const double least = 9.81 * (specimen.model == Model::slide ? specimen.friction.mu_s
                                                                : std::min(specimen.friction.mu_s, slenderness));
    const double peak = least * random.log_uniform(0.8, 4) * (random.chance(0.5) ? 1 : -1);
    const bool shaken = i % pulses.size() + 1 == pulses.size();
    samples.specimens.push_back(specimen);
    samples.shakings.push_back(
        {&pulses[i % pulses.size()], peak, random.log_uniform(0.15, 3), shaken ? 0.5 * peak : 0});
  }
  return samples;
}

std::vector<double> numbers(const Response& r) {
  return {double(int(r.outcome)),      r.peak_slip_m,           r.peak_slip_right_m,
          r.peak_slip_left_m,          r.residual_slip_m,       r.slid_path_m,
          r.peak_rotation_rad,         r.residual_rotation_rad, r.peak_acceleration_mps2,
          double(r.connection_failed), double(r.wall_hits),     r.wall_speed_mps,
          double(r.impacts),           double(r.events),        r.end_time_s};
}
bool same_bits(const Response& a, const Response& b) {
  const auto x = numbers(a), y = numbers(b);
  return std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
}

std::vector<Response> one_by_one(const PulseSamples& samples, const Settings& settings) {
  std::vector<Response> responses;
  for (std::size_t i = 0; i < samples.specimens.size(); ++i)
    responses.push_back(respond(samples.specimens[i], samples.shakings[i], settings));
  return responses;
}

// Tolerances change the lengths of steps, and where a row of hops ends.
TEST(PulsesInBlocks, HaveTheBitsOfSingleSamplesWithAnyInstructionSet) {
  constexpr std::size_t count = 3000;
  const auto pulses = every_pulse();
  const PulseSamples samples = draw_samples(count, pulses);
  const auto with_vertical = static_cast<std::size_t>(std::count_if(
      samples.shakings.begin(), samples.shakings.end(), [](const Shaking& s) { return s.vertical_scale != 0; }));
  for (const Settings& settings : {Settings{}, Settings{.tolerance = 1e-7, .slip_by_side = true}}) {
    const std::vector<Response> alone = one_by_one(samples, settings);
    const auto moved = std::count_if(alone.begin(), alone.end(), [](const Response& r) { return r.events > 0; });
    const auto fell =
        std::count_if(alone.begin(), alone.end(), [](const Response& r) { return r.outcome == Outcome::overturned; });
    std::printf("%td of %zu moved, %td overturned\n", moved, count, fell);
    EXPECT_GT(moved, 2000);
    EXPECT_GT(fell, 200);
    for (const char* name : {"v2", "v3", "v4"}) {
      const Isa isa(name);
      if (!isa.there()) {
        std::printf("%s is not here\n", name);
        continue;
      }
      std::vector<Response> block(count);
      EXPECT_EQ(dynamics::respond_and_count(samples.specimens, samples.shakings, settings, block), with_vertical)
          << name;
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_TRUE(same_bits(block[i], alone[i])) << name << ", sample " << samples.text(i);
    }
  }
}

// Lanes that are not full, and neighbours of all kinds.
TEST(PulsesInBlocks, DoNotDependOnTheirCompany) {
  const auto pulses = every_pulse();
  const PulseSamples samples = draw_samples(240, pulses);
  const std::vector<Response> alone = one_by_one(samples, {});
  for (std::size_t size = 1; size <= 11; ++size)
    for (std::size_t first = 0; first + size <= alone.size(); first += size) {
      std::vector<Response> block(size);
      respond_batch(std::span(samples.specimens).subspan(first, size), std::span(samples.shakings).subspan(first, size),
                    {}, block);
      for (std::size_t i = 0; i < size; ++i)
        EXPECT_TRUE(same_bits(block[i], alone[first + i]))
            << "in a block of " << size << ", sample " << samples.text(first + i);
    }
}

}  // namespace
}  // namespace freestand::test
