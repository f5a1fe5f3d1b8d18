#include "sampling/design.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <freestand/error.hpp>

#include "base/random.hpp"
#include "sampling/sobol.hpp"

namespace freestand::sampling {
namespace {

// One line a dimension, in an order that never changes: new names go to the end. Names on one line exclude each other
// in any one sample. Effects by their fixed names.
constexpr std::array<std::array<std::string_view, 4>, 42> catalogue = {{
    {"motion.peak_acceleration_g", "motion.peak_velocity_mps", "motion.pta_g", "motion.scale"},
    {"friction.mu", "friction.mu_k"},
    {"motion.period_s"},
    {"motion.pulse", "motion.record"},
    {"motion.source"},
    {"block.width_m", "block.slenderness_rad"},
    {"block.height_m", "block.size_m"},
    {"friction.mu_s", "friction.static_ratio"},
    {"impact.factor"},
    {"block.mass_kg"},
    {"effects.vertical_shaking.scale"},
    {"effects.static_friction.ratio"},
    {"effects.rate_weakening.drop"},
    {"effects.rate_weakening.speed_mps"},
    {"effects.rate_strengthening.rise"},
    {"effects.rate_strengthening.speed_mps"},
    {"effects.friction_wear.ratio"},
    {"effects.friction_wear.path_m"},
    {"effects.directional_friction.asymmetry"},
    {"effects.pressure_friction.exponent"},
    {"effects.viscous_drag.rate_per_s"},
    {"effects.floor_tilt.angle_rad"},
    {"effects.flexible_legs.frequency_hz"},
    {"effects.flexible_legs.damping"},
    {"effects.slack_tether.slack_m"},
    {"effects.slack_tether.frequency_hz"},
    {"effects.slack_tether.rate_per_s"},
    {"effects.centering_spring.frequency_hz"},
    {"effects.wall_impact.gap_m"},
    {"effects.wall_impact.restitution"},
    {"effects.moving_contents.mass_ratio"},
    {"effects.moving_contents.frequency_hz"},
    {"effects.moving_contents.damping"},
    {"effects.impact_loss.factor"},
    {"effects.reduced_base.ratio"},
    {"effects.offset_mass.eccentricity"},
    {"block.centre_height_m"},
    {"block.gyration_radius_m", "block.inertia_kgm2"},
    {"start.rotation_rad"},
    {"start.rotation_rate_radps"},
    {"start.slip_m"},
    {"start.slip_velocity_mps"},
}};
static_assert(catalogue.size() <= sobol_dimensions);

// Balanced Feistel network: a permutation of the words of 2 * half_bits bits, keyed.
std::uint64_t feistel(std::uint64_t word, int half_bits, std::uint64_t key) {
  constexpr int rounds = 6;
  const std::uint64_t mask = (1ULL << half_bits) - 1;
  std::uint64_t left = word >> half_bits, right = word & mask;
  for (std::uint64_t round = 1; round <= rounds; ++round) {
    const std::uint64_t mixed = random::mix(random::mix(key + round * 0x9e3779b97f4a7c15ULL) ^ right);
    const std::uint64_t next = left ^ (mixed & mask);
    left = right;
    right = next;
  }
  return (left << half_bits) | right;
}

// Blocks of so many points are taken in any order; within Owen's shuffle alone points 2j and 2j + 1 would stay together in each such
// dimension, in opposite halves, and what depends on the sign of a product of two of them would be the same of both.
constexpr int mixed_bits = 6;  // of B points a product then scatters B/(B - 1) times as much as of independent ones

std::uint64_t own_order(std::uint64_t point, std::uint64_t key) {
  const std::uint64_t shuffled = owen_scramble(point, key), within = (1ULL << mixed_bits) - 1;
  return (shuffled & ~within) | feistel(shuffled & within, mixed_bits / 2, random::mix(key ^ (shuffled >> mixed_bits)));
}

std::uint64_t of_replicate(std::uint64_t key, std::uint64_t replicate) {
  return replicate == 0 ? key : random::mix(key + replicate * 0x9e3779b97f4a7c15ULL);
}

}  // namespace

const char* name(Design design) {
  constexpr const char* names[] = {"monte_carlo", "latin_hypercube", "sobol"};
  return names[static_cast<int>(design)];
}

int sobol_dimension(std::string_view parameter) {
  for (std::size_t d = 0; d < catalogue.size(); ++d)
    if (!parameter.empty() && std::find(catalogue[d].begin(), catalogue[d].end(), parameter) != catalogue[d].end())
      return static_cast<int>(d);
  return -1;
}

Stream::Stream(const Plan& plan, std::string_view parameter)
    : plan_(plan),
      redrawn_(std::find(plan.redrawn.begin(), plan.redrawn.end(), parameter) != plan.redrawn.end()),
      stream_(random::stable_hash(redrawn_ ? "/redrawn" : "", random::stable_hash(parameter))),
      dimension_(sobol_dimension(parameter)) {
  constexpr std::uint64_t key_counter = ~0ULL;  // no sample has this index
  const auto [first, second] = random::bits(plan.seed, key_counter, stream_);
  key_ = first;
  order_key_ = dimension_ < 0 ? second | 1U : 0;
  if (plan.design == Design::latin_hypercube && plan.samples == 0)
    throw Error("design latin_hypercube without a number of samples (its strata depend on it): give samples");
}

double Stream::operator()(std::uint64_t sample) const {
  switch (redrawn_ ? Design::monte_carlo : plan_.design) {
    case Design::latin_hypercube:
      return latin_hypercube(sample);
    case Design::sobol:
      return sobol(sample);
    case Design::monte_carlo:
      break;
  }
  return random::uniform(plan_.seed, sample, stream_);
}

double Stream::latin_hypercube(std::uint64_t sample) const {
  const auto scrambles = static_cast<std::uint64_t>(plan_.scrambles);
  const std::uint64_t strata = (plan_.samples + scrambles - 1 - replicate(sample)) / scrambles;
  const int half_bits = std::max(1, (static_cast<int>(std::bit_width(strata - 1)) + 1) / 2);
  const std::uint64_t key = of_replicate(key_, replicate(sample));
  std::uint64_t stratum = point(sample);
  do stratum = feistel(stratum, half_bits, key);
  while (stratum >= strata);
  const double jitter = random::uniform(plan_.seed, sample, stream_);
  const double u = (static_cast<double>(stratum) + jitter) / static_cast<double>(strata);
  return std::min(u, 1 - 0x1.0p-53);
}

double Stream::sobol(std::uint64_t sample) const {
  const std::uint64_t i = point(sample), r = replicate(sample);
  const std::uint64_t index = order_key_ == 0 ? i : own_order(i, of_replicate(order_key_, r));
  return random::unit_interval(owen_scramble(sobol_word(std::max(dimension_, 0), index), of_replicate(key_, r)));
}

}  // namespace freestand::sampling
