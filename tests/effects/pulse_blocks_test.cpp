// Pulses in blocks of samples: each sample has the bits of the one computed alone, in any company and with any instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pulse_slide.hpp"
#include "effects/mixture.hpp"
#include "motion/pulse.hpp"
#include "support/contact_stepper.hpp"
#include "support/isa.hpp"
#include "support/same_histories.hpp"

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

bool slides_in_closed_form(const Specimen& specimen, const Shaking& shaking, const Settings& settings) {
  return dynamics::slides_on_pulse(dynamics::set_up(specimen, shaking), settings);
}

std::vector<double> numbers(const Response& r) {
  return {double(int(r.outcome)),      r.peak_slip_m,           r.peak_slip_right_m,
          r.peak_slip_left_m,          r.residual_slip_m,       r.slid_path_m,
          r.peak_rotation_rad,         r.residual_rotation_rad, r.peak_acceleration_mps2,
          double(r.connection_failed), double(r.wall_hits),     r.wall_speed_mps,
          double(r.impacts),           double(r.events),        r.end_time_s};
}
bool same_bits_of_responses(const Response& a, const Response& b) {
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
  std::size_t by_themselves = 0;
  for (std::size_t i = 0; i < count; ++i)
    by_themselves += samples.shakings[i].vertical_scale != 0 ||
                     slides_in_closed_form(samples.specimens[i], samples.shakings[i], Settings{});
  for (const Settings& settings : {Settings{}, Settings{.tolerance = 1e-7, .slip_by_side = true}}) {
    const std::vector<Response> alone = one_by_one(samples, settings);
    const auto moved = std::count_if(alone.begin(), alone.end(), [](const Response& r) { return r.events > 0; });
    const auto fell =
        std::count_if(alone.begin(), alone.end(), [](const Response& r) { return r.outcome == Outcome::overturned; });
    std::printf("%td of %zu moved, %td overturned\n", moved, count, fell);
    EXPECT_GT(moved, 2000);
    EXPECT_GT(fell, 200);
    int compared = 0;
    for (const char* name : instruction_sets) {
      const Isa isa(name);
      if (!isa.there()) {
        std::printf("%s is not here\n", name);
        continue;
      }
      std::vector<Response> block(count);
      EXPECT_EQ(dynamics::respond_and_count(samples.specimens, samples.shakings, settings, block), by_themselves)
          << name;
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_TRUE(same_bits_of_responses(block[i], alone[i])) << name << ", sample " << samples.text(i);
      ++compared;
    }
    EXPECT_TRUE(compared > 0 || !dynamics::batch_kernels());
  }
}

// And on after the motion.
TEST(PulsesInBlocks, HistoriesHaveTheBitsOfSingleOnes) {
  constexpr std::size_t count = 300;
  const auto pulses = every_pulse();
  const PulseSamples samples = draw_samples(count, pulses);
  const Settings settings{.free_vibration_s = 4, .slip_by_side = true};
  std::vector<Response> block(count);
  std::vector<History> histories(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double steps_s[] = {0.005, 0.013, 0};
    histories[i] = {.step_s = steps_s[i % 3], .points = {}, .events = {}, .forces = i % 2 == 0};
  }
  std::vector<History> alone = histories;
  respond_batch(samples.specimens, samples.shakings, settings, block, histories);
  std::size_t after = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Response single = respond(samples.specimens[i], samples.shakings[i], settings, &alone[i]);
    EXPECT_TRUE(same_bits_of_responses(block[i], single)) << samples.text(i);
    EXPECT_TRUE(same_histories(histories[i], alone[i])) << samples.text(i);
    after += !alone[i].points.empty() && alone[i].points.back().time_s > samples.shakings[i].duration_s();
  }
  EXPECT_GT(after, 20U);
}

// With a history a sample goes by the integrator, segment by segment: it knows nothing of the integrals. Round-off of 1e-16 over
// some 250 segments is 1e-14 of the path. The integrator takes the root of the squared acceleration, whose series it cuts off after
// order 8: of (1 - cos 2x)/2 over 1/32 of a period that leaves (2 pi/16)^9/(2 9!) = 3e-10 of the pulse's peak squared, half as much of
// the root, 16 times as much where friction holds a quarter of the peak.
TEST(PulsesInClosedForm, SlideAsTheIntegratorSays) {
  const auto pulses = every_pulse();
  const PulseSamples samples = draw_samples(6000, pulses);
  int compared = 0, moved = 0, other_events = 0;
  double worst = 0;
  for (std::size_t i = 0; i < samples.specimens.size(); ++i) {
    for (const Settings& settings : {Settings{}, Settings{.slip_by_side = true}}) {
      if (!slides_in_closed_form(samples.specimens[i], samples.shakings[i], settings)) continue;
      History history;
      const Response closed = respond(samples.specimens[i], samples.shakings[i], settings);
      const Response stepped = respond(samples.specimens[i], samples.shakings[i], settings, &history);
      ++compared;
      moved += stepped.outcome == Outcome::moved;
      other_events += closed.events != stepped.events;
      EXPECT_EQ(closed.outcome, stepped.outcome) << samples.text(i);
      const auto near = [&](const char* what, double a, double b, double size) {
        if (std::isnan(a) && std::isnan(b)) return;
        worst = std::max(worst, std::abs(a - b) / std::max(size, 1e-300));
        EXPECT_NEAR(a, b, 1e-12 * size) << what << " of sample " << samples.text(i);
      };
      near("peak_slip_m", closed.peak_slip_m, stepped.peak_slip_m, stepped.slid_path_m);
      near("peak_slip_right_m", closed.peak_slip_right_m, stepped.peak_slip_right_m, stepped.slid_path_m);
      near("peak_slip_left_m", closed.peak_slip_left_m, stepped.peak_slip_left_m, stepped.slid_path_m);
      near("residual_slip_m", closed.residual_slip_m, stepped.residual_slip_m, stepped.slid_path_m);
      near("slid_path_m", closed.slid_path_m, stepped.slid_path_m, stepped.slid_path_m);
      EXPECT_NEAR(closed.peak_acceleration_mps2, stepped.peak_acceleration_mps2,
                  2.4e-9 * stepped.peak_acceleration_mps2)
          << samples.text(i);
      EXPECT_NEAR(closed.end_time_s, stepped.end_time_s, 1e-7 * samples.shakings[i].duration_s()) << samples.text(i);
    }
  }
  std::printf("%d compared, %d moved, %d with other events; worst %.1e\n", compared, moved, other_events, worst);
  EXPECT_GT(moved, 1000);
  EXPECT_EQ(other_events, 0);
}

// Three segments of unit length: the floor runs away to the left at 2 m/s2; then w = w1 (1 + 4 (1 + dip) (x^2 - x)), which has fallen to
// -dip w1 in the middle and is back at w1 at the end; then it stands still. A slip that has ended begins anew where x = 1/2.
TEST(PulsesInClosedForm, SeeASlipThatEndsForAnInstant) {
  constexpr double mu = 0.1, braked = mu * standard_gravity_mps2, q = 2 - braked;
  for (const double dip : {-1e-2, -1e-6, 1e-6, 1e-2})
    for (const double direction : {1.0, -1.0}) {
      FloorMotion motion;
      motion.knot_s = {0, 1, 2, 3};
      motion.horizontal_mps2 = {-2, 0, 4 * q * (1 + dip) - braked, -8 * q * (1 + dip), 0, 0};
      index_runs(motion);
      const Shaking shaking{&motion, direction, 0.5};
      Specimen specimen;
      specimen.model = Model::slide;
      specimen.block = Block::rectangular(0.5, 1, 100);
      specimen.friction = {mu, mu};
      ASSERT_TRUE(slides_in_closed_form(specimen, shaking, {}));
      History history;
      const int begins_and_ends = dip > 0 ? 4 : 2;
      EXPECT_EQ(respond(specimen, shaking).events, begins_and_ends) << dip;
      EXPECT_EQ(respond(specimen, shaking, {}, &history).events, begins_and_ends) << dip;
    }
}

// The stepper of contact impulses, on the closed form of the pulse: it shares neither equations nor tables. Its own change from one step
// to another tells its error; where that has grown beyond 0.1 mm the history is chaotic.
TEST(PulsesInBlocks, HaveThePeaksOfTheContactStepper) {
  const auto pulses = every_pulse();
  const PulseSamples all = draw_samples(400, pulses);
  PulseSamples samples;
  for (std::size_t i = 0; i < all.specimens.size() && samples.specimens.size() < 24; ++i) {
    if (all.specimens[i].model != Model::slide_rock || !all.specimens[i].effects.empty()) continue;
    if (all.shakings[i].vertical_scale != 0 || all.shakings[i].duration_s() > 2.5) continue;
    samples.specimens.push_back(all.specimens[i]);
    samples.specimens.back().impact.law = ImpactLaw::coulomb;
    samples.shakings.push_back(all.shakings[i]);
  }
  std::vector<Response> block(samples.specimens.size());
  respond_batch(samples.specimens, samples.shakings, {}, block);
  int compared = 0, moved = 0;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Shaking& shaking = samples.shakings[i];
    const motion::Pulse pulse = motion::find_pulse(shaking.motion->name);
    const FloorAt floor = [&](double t) {
      const double x = t / shaking.stretch;
      return FloorAcceleration{x < pulse.duration ? shaking.scale * pulse.at(x).acceleration : 0.0, 0.0};
    };
    const bool falls = block[i].outcome == Outcome::overturned;
    const double end = falls ? block[i].end_time_s + 0.1 : std::min(block[i].end_time_s, shaking.duration_s() + 2);
    const StepperResult fine = step_contacts(samples.specimens[i], floor, {1e-5, end, 1e-2});
    const StepperResult coarse = step_contacts(samples.specimens[i], floor, {1e-2 / 590, end, 1e-2});
    if (fine.overturned || falls) {
      EXPECT_EQ(fine.overturned, falls) << samples.text(i);
      continue;
    }
    const double slip = std::abs(fine.peak_slip_m - coarse.peak_slip_m),
                 rotation = std::abs(fine.peak_rotation_rad - coarse.peak_rotation_rad);
    if (slip > 1e-4 || rotation > 1e-4) continue;
    ++compared;
    moved += block[i].outcome == Outcome::moved;
    EXPECT_NEAR(block[i].peak_slip_m, fine.peak_slip_m, 1e-6 + 6 * slip) << samples.text(i);
    EXPECT_NEAR(block[i].peak_rotation_rad, fine.peak_rotation_rad, 1e-6 + 6 * rotation) << samples.text(i);
  }
  std::printf("%d of %zu compared, %d moved\n", compared, block.size(), moved);
  EXPECT_GE(moved, 12);
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
        EXPECT_TRUE(same_bits_of_responses(block[i], alone[first + i]))
            << "in a block of " << size << ", sample " << samples.text(first + i);
    }
}

}  // namespace
}  // namespace freestand::test
