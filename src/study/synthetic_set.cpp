#include "study/synthetic_set.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>

#include "motion/pulse.hpp"
#include "study/keyed_draw.hpp"

namespace freestand::study {
namespace {

// The draws of one realisation.
class Draws {
 public:
  Draws(const SyntheticPart& part, std::uint64_t seed, std::uint64_t n) : set_(part.name), seed_(seed), n_(n) {}

  double operator()(const Quantity& quantity) const { return keyed_draw(seed_, n_, set_, quantity); }
  const std::string& operator()(const sampling::Names& names) const {
    return names.values[sampling::pick(names.values.size(), names.weights,
                                       keyed_uniform(seed_, n_, set_, "synthetic.pulse.type"))];
  }
  std::vector<double> white_noise(std::size_t count) const {
    const std::uint64_t stream = random::stable_hash(set_ + ".white_noise");
    std::vector<double> noise;
    for (std::size_t i = 0; i < count; ++i) noise.push_back(random::standard_normal(seed_, (n_ << 32) + i, stream));
    return noise;
  }

 private:
  const std::string& set_;
  std::uint64_t seed_, n_;
};

std::string name_of(const SyntheticPart& part, std::uint64_t n) { return fmt::format("{} {}", part.name, n); }

}  // namespace

motion::SyntheticParameters synthetic_parameters(const SyntheticPart& part, std::uint64_t seed, std::uint64_t n) {
  const Draws draw(part, seed, n);
  motion::SyntheticParameters p{.arias_mps = draw(part.arias),
                                .duration_s = draw(part.duration),
                                .middle_s = draw(part.middle),
                                .frequency_hz = draw(part.frequency),
                                .frequency_slope_hzps = draw(part.slope),
                                .bandwidth = draw(part.bandwidth),
                                .corner_hz = draw(part.corner),
                                .step_s = part.step_s};
  if (const auto& pulse = part.pulse)
    p.pulse = motion::SyntheticPulse{.type = draw(pulse->types),
                                     .period_s = draw(pulse->period),
                                     .peak_velocity_mps = draw(pulse->peak_velocity),
                                     .middle_s = draw(pulse->middle)};
  return p;
}

FloorMotion realisation(const SyntheticPart& part, std::uint64_t seed, std::uint64_t n) {
  const motion::SyntheticParameters parameters = synthetic_parameters(part, seed, n);
  const std::string name = name_of(part, n);
  if (const std::string why = motion::refusal(parameters); !why.empty()) throw Error(name + " is " + why);
  return synthetic_motion(parameters, Draws(part, seed, n).white_noise(motion::noise_samples(parameters)), name);
}

std::vector<motion::RecordNumber> synthetic_numbers(const SyntheticPart& part) {
  std::vector<std::string> names = {"arias_expected_mps", "significant_5_95_expected_s", "middle_s",
                                    "frequency_hz",       "frequency_slope_hzps",        "bandwidth",
                                    "corner_hz"};
  if (part.pulse) names.insert(names.end(), {"pulse_peak_velocity_mps", "pulse_middle_s"});
  std::vector<motion::RecordNumber> numbers;
  for (const std::string& name : names) numbers.push_back(motion::record_number(name).value());
  return numbers;
}

std::vector<double> synthetic_values(const motion::SyntheticParameters& p) {
  std::vector<double> values = {p.arias_mps, p.duration_s, p.middle_s, p.frequency_hz, p.frequency_slope_hzps,
                                p.bandwidth, p.corner_hz};
  if (p.pulse) values.insert(values.end(), {p.pulse->peak_velocity_mps, p.pulse->middle_s});
  return values;
}

std::string refusal(const SyntheticPart& part, std::uint64_t seed) {
  std::string first;
  int refused = 0;
  for (int n = 0; n < part.count; ++n) {
    const auto number = static_cast<std::uint64_t>(n);
    const std::string why = motion::refusal(synthetic_parameters(part, seed, number));
    if (!why.empty() && refused++ == 0) first = fmt::format("{} is {}", name_of(part, number), why);
  }
  return refused > 1 ? fmt::format("{}; so it is with {} of {}", first, refused, part.count) : first;
}

}  // namespace freestand::study
