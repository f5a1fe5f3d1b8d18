#include "motion/building_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "motion/channel.hpp"
#include "motion/oscillator.hpp"

namespace freestand::motion {
namespace {

constexpr int most_parts = 64;  // of a step of the record
constexpr double longest_tail_s = 3600;

// The largest distance of every other sample from the line between its neighbours.
double off_the_lines(const std::vector<double>& samples) {
  double off = 0;
  for (std::size_t i = 1; i + 1 < samples.size(); i += 2)
    off = std::max(off, std::abs(samples[i] - (samples[i - 1] + samples[i + 1]) / 2));
  return off;
}

double step_of(const FloorMotion& motion) {
  if (motion.degree != 1 || motion.segments() < 1)
    throw Error(motion.name + " has no floors (it is no record with samples at equal steps): give a record");
  return motion.duration_s() / static_cast<double>(motion.segments());
}

double restoring(const Mode& mode, OscillatorState q) {
  return 2 * mode.damping * mode.w_radps * q.v + mode.w_radps * mode.w_radps * q.u;
}

// w^2 times the amplitude of a free vibration from this state: of the mode's absolute acceleration, falling by exp(-z w t).
double free_amplitude(const Mode& mode, OscillatorState q) {
  const double zw = mode.damping * mode.w_radps, wd = mode.w_radps * std::sqrt(1 - mode.damping * mode.damping);
  return mode.w_radps * mode.w_radps * std::hypot(q.u, (q.v + zw * q.u) / wd);
}

// Fills the history at so many steps of the record, each in parts; behind its end the ground is still. Ends in this state.
OscillatorState shake(const FloorMotion& ground, double step_s, const Mode& mode, int parts, std::size_t steps,
                      std::vector<double>& history) {
  const double part_s = step_s / parts;
  Oscillator oscillator(mode.w_radps, mode.damping);
  OscillatorState q;
  history.assign(1, 0.0);
  history.reserve(steps * static_cast<std::size_t>(parts) + 1);
  for (std::size_t i = 0; i < steps; ++i) {
    Polynomial a = i < ground.segments() ? segment(ground, ground.horizontal_mps2, i) : Polynomial{};
    a.degree = 1;
    for (int part = 0; part < parts; ++part, a.c[0] += a.c[1] * part_s) {
      q = oscillator.after(a, part_s, q);
      history.push_back(restoring(mode, q));
    }
  }
  return q;
}

}  // namespace

BuildingResponse::BuildingResponse(const FloorMotion& ground, std::vector<Mode> modes, double straightness)
    : ground_(ground), modes_(std::move(modes)), straightness_(straightness), step_s_(step_of(ground)) {
  look_at_the_shaking();
}

// Of a piecewise linear channel of the ground, at a sample or a part of a step behind it; 0 behind the end.
double BuildingResponse::ground_at(const MotionValues& coefficients, std::size_t knot, int parts) const {
  const std::size_t n = static_cast<std::size_t>(parts), segment = knot / n, part = knot % n;
  if (segment > ground_.segments() || (segment == ground_.segments() && part > 0)) return 0;
  const bool last = segment == ground_.segments();
  const std::size_t i = 2 * (last ? segment - 1 : segment);
  const double share = last ? 1 : static_cast<double>(part) / parts;
  return coefficients[i] + coefficients[i + 1] * step_s_ * share;
}

// Steps until the free vibrations together are below the share of the peak.
std::size_t BuildingResponse::tail(int floor, const std::vector<double>& amplitude, double peak) const {
  const auto left = [&](double t) {
    double sum = 0;
    for (std::size_t m = 0; m < modes_.size(); ++m)
      sum += std::abs(modes_[m].floors[static_cast<std::size_t>(floor)]) * amplitude[m] *
             std::exp(-modes_[m].damping * modes_[m].w_radps * t);
    return sum;
  };
  const double enough = straightness_ * peak;
  const auto most = static_cast<std::size_t>(longest_tail_s / step_s_);
  std::size_t moving = 0, still = 1;
  while (left(static_cast<double>(still) * step_s_) > enough) {
    moving = still;
    still *= 2;
    if (moving > most)
      throw Error(
          fmt::format("floor {} would swing for more than {:.0f} s after {} (its first mode has a period of {:.3g} s "
                      "and {:.2g} of critical "
                      "damping): give more damping",
                      floor, longest_tail_s, ground_.name, modes_.front().period_s(), modes_.front().damping));
  }
  while (still - moving > 1) {
    const std::size_t middle = (moving + still) / 2;
    (left(static_cast<double>(middle) * step_s_) > enough ? moving : still) = middle;
  }
  return still;
}

void BuildingResponse::look_at_the_shaking() {
  Histories shaken;
  std::vector<double> amplitude;
  for (const Mode& mode : modes_)
    amplitude.push_back(
        free_amplitude(mode, shake(ground_, step_s_, mode, 1, ground_.segments(), shaken.emplace_back())));
  for (std::size_t f = 0; f <= modes_.size(); ++f) {
    double peak = 0;
    for (std::size_t knot = 0; knot <= ground_.segments(); ++knot) {
      double sum = 0;
      for (std::size_t m = 0; m < modes_.size(); ++m) sum -= modes_[m].floors[f] * shaken[m][knot];
      peak = std::max(peak, std::abs(sum));
    }
    peak_.push_back(peak);
    tail_.push_back(f == 0 ? 0 : tail(static_cast<int>(f), amplitude, peak));
  }
}

const BuildingResponse::Histories& BuildingResponse::histories(int parts) {
  const auto [place, fresh] = known_.try_emplace(parts);
  if (!fresh) return place->second;
  const std::size_t steps = ground_.segments() + *std::max_element(tail_.begin(), tail_.end());
  for (const Mode& mode : modes_) shake(ground_, step_s_, mode, parts, steps, place->second.emplace_back());
  return place->second;
}

std::vector<double> BuildingResponse::acceleration(int floor, int parts) {
  const Histories& modal = histories(parts);
  const auto f = static_cast<std::size_t>(floor);
  std::vector<double> sum((ground_.segments() + tail_[f]) * static_cast<std::size_t>(parts) + 1, 0.0);
  for (std::size_t m = 0; m < modes_.size(); ++m)
    for (std::size_t knot = 0; knot < sum.size(); ++knot) sum[knot] -= modes_[m].floors[f] * modal[m][knot];
  return sum;
}

FloorMotion BuildingResponse::floor(int floor, std::string name) {
  if (floor < 0 || static_cast<std::size_t>(floor) > modes_.size())
    throw Error(
        fmt::format("floor {} is none of the building (it has floors 1 to {}, and 0 is the ground): name one of these",
                    floor, modes_.size()));
  if (floor == 0) {
    FloorMotion ground = ground_;
    ground.name = std::move(name);
    return ground;
  }
  int parts = 1;
  std::vector<double> samples = acceleration(floor, parts);
  while (parts < most_parts) {
    std::vector<double> finer = acceleration(floor, 2 * parts);
    if (off_the_lines(finer) <= straightness_ * peak_[static_cast<std::size_t>(floor)]) break;
    samples = std::move(finer);
    parts *= 2;
  }
  std::vector<double> vertical;
  if (!ground_.vertical_mps2.empty())
    for (std::size_t knot = 0; knot < samples.size(); ++knot)
      vertical.push_back(ground_at(ground_.vertical_mps2, knot, parts));
  return piecewise_linear(std::move(name), step_s_ / parts, samples, vertical);
}

std::string outside_the_band(const FloorMotion& ground, const std::vector<Mode>& modes) {
  const double step = step_of(ground);
  const bool excited = std::any_of(modes.begin(), modes.end(), [&](const Mode& mode) {
    return mode.period_s() >= 2 * step && mode.period_s() <= ground.duration_s();
  });
  if (excited) return "";
  return fmt::format(
      "no mode of the building lies in the record's band (its periods reach from {:.3g} to {:.3g} s; a record with a "
      "step "
      "of {:.3g} s and {:.4g} s long holds periods from {:.3g} to {:.4g} s): correct the building's period, or take "
      "other "
      "records",
      modes.back().period_s(), modes.front().period_s(), step, ground.duration_s(), 2 * step, ground.duration_s());
}

}  // namespace freestand::motion
