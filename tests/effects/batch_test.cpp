// The effects of the catalogue in blocks of samples: each sample is answered as alone. To the bit where it is computed
// alone, and to what freestand/simulate.hpp promises of packs where these take the effect.
#include <cstdio>
#include <set>

#include "effects/effect_fixture.hpp"
#include "effects/mixture.hpp"
#include "support/isa.hpp"
#include "support/same_histories.hpp"

namespace freestand::test {
namespace {

// Those that change block, impact, friction or floor in ways that packs know.
const std::set<std::string> in_packs = {
    "centering_spring", "directional_friction", "floor_tilt",     "friction_wear", "impact_loss",
    "offset_mass",      "rate_strengthening",   "rate_weakening", "reduced_base",  "slack_tether",
    "static_friction",  "vertical_shaking",     "viscous_drag"};

const std::set<std::string> no_laws = {"impact_loss", "offset_mass", "reduced_base", "static_friction",
                                       "vertical_shaking"};

struct Samples {
  std::vector<RandomCase> cases;  // which own the motions
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
};

// Random samples, every third without the effect.
Samples samples_with(const effects::Effect& effect, Model model, std::size_t count) {
  CaseFamily family;
  family.seed = 91;
  family.one_model = 0;
  family.vertical = effect.name == "vertical_shaking" ? 1 : 0;
  family.vertical_peak_g = 0.6;
  family.duration_low_s = 3;
  family.duration_high_s = 5;
  Samples samples;
  for (std::size_t i = 0; i < count; ++i) {
    samples.cases.push_back(random_case(family, i));
    samples.specimens.push_back(samples.cases.back().specimen);
    samples.shakings.push_back(samples.cases.back().shaking);
    Specimen& specimen = samples.specimens.back();
    specimen.model = model;
    // Kernels of their own take laws of the slip with Housner's impacts only.
    if (effect.name == "impact_loss" || (effect.friction && effect.name != "pressure_friction"))
      specimen.impact.law = ImpactLaw::housner;
    if (i % 3 == 2) continue;
    KeyedRandom random(92, i);
    specimen.effects = {{&effect, {}}};
    for (const auto& p : effect.parameters) specimen.effects[0].parameters.push_back(random.uniform(p.low, p.high));
  }
  return samples;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool same_bits(const Response& a, const Response& b) {
  return same(a.peak_slip_right_m, b.peak_slip_right_m) && same(a.peak_slip_left_m, b.peak_slip_left_m) &&
         a.wall_hits == b.wall_hits && a.wall_speed_mps == b.wall_speed_mps && a.outcome == b.outcome &&
         a.peak_slip_m == b.peak_slip_m && a.residual_slip_m == b.residual_slip_m && a.slid_path_m == b.slid_path_m &&
         a.peak_rotation_rad == b.peak_rotation_rad && a.residual_rotation_rad == b.residual_rotation_rad &&
         a.peak_acceleration_mps2 == b.peak_acceleration_mps2 && a.connection_failed == b.connection_failed &&
         a.impacts == b.impacts && a.events == b.events && a.end_time_s == b.end_time_s;
}

TEST(CatalogueInBlocks, EachSampleIsAnsweredAsAlone) {
  constexpr std::size_t count = 60;
  for (const auto& effect : effects::all())
    for (const Model model : {Model::slide_rock, Model::slide}) {
      const auto& excludes = effect.excludes;
      if (model == Model::slide && std::find(excludes.begin(), excludes.end(), "slide") != excludes.end()) continue;
      const Samples samples = samples_with(effect, model, count);
      std::vector<Response> block(count);
      respond_batch(samples.specimens, samples.shakings, {}, block);
      int bits = 0, sensitive = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Response alone = respond(samples.specimens[i], samples.shakings[i]);
        const bool with = !samples.specimens[i].effects.empty();
        if (same_bits(block[i], alone)) {
          bits += with;
          continue;
        }
        EXPECT_TRUE(!with || in_packs.count(effect.name)) << effect.name << ' ' << i << " is answered otherwise";
        const double apart = distance(block[i], alone);
        if (apart <= 1e-7) continue;
        ++sensitive;
        EXPECT_LE(apart, moved_by(1e-8, samples.specimens[i], samples.shakings[i], {}, alone))
            << effect.name << ' ' << i << ' ' << samples.cases[i].text();
      }
      EXPECT_LE(sensitive, 1) << effect.name;
      std::printf("%s: %d of 40 with the effect have the bits of single samples, %d of all are sensitive\n",
                  effect.name.c_str(), bits, sensitive);
      std::vector<Specimen> with;
      std::vector<Shaking> shakings;
      for (std::size_t i = 0; i < count; ++i)
        if (!samples.specimens[i].effects.empty()) {
          with.push_back(samples.specimens[i]);
          shakings.push_back(samples.shakings[i]);
        }
      if (dynamics::batch_kernels()) {
        EXPECT_EQ(dynamics::respond_and_count(with, shakings, {}, block), 0U) << effect.name;
      }
    }
}

// Each history in its own steps, finer and coarser than those of the floor, with forces and without.
TEST(CatalogueInBlocks, HistoriesHaveTheBitsOfSingleOnes) {
  constexpr std::size_t count = 24;
  for (const auto& effect : effects::all())
    for (const Model model : {Model::slide_rock, Model::slide}) {
      const auto& excludes = effect.excludes;
      if (model == Model::slide && std::find(excludes.begin(), excludes.end(), "slide") != excludes.end()) continue;
      const Samples samples = samples_with(effect, model, count);
      const std::size_t one_by_one = no_laws.count(effect.name) ? count : count / 3;  // that are without an effect
      const Settings settings{.tolerance = 1e-8, .free_vibration_s = 0};
      std::vector<Response> block(count);
      std::vector<History> histories(count);
      for (std::size_t i = 0; i < count; ++i) {
        const double steps_s[] = {0.005, 0.002, 0.01, 1.0 / 256};
        histories[i].step_s = steps_s[i % 4];
        histories[i].forces = i % 2;
        histories[i].points.resize(3);  // of another sample
      }
      std::vector<History> alone = histories;
      respond_batch(samples.specimens, samples.shakings, settings, block, histories);
      std::vector<History> again = histories;
      if (dynamics::batch_kernels()) {
        EXPECT_LE(dynamics::respond_and_count(samples.specimens, samples.shakings, settings, block, again), one_by_one)
            << effect.name;
      }
      for (std::size_t i = 0; i < count; ++i) {
        const Response single = respond(samples.specimens[i], samples.shakings[i], settings, &alone[i]);
        EXPECT_TRUE(same_bits(block[i], single)) << effect.name << ' ' << i;
        EXPECT_GT(alone[i].points.size(), 300U);
        EXPECT_TRUE(same_histories(histories[i], alone[i]))
            << effect.name << ' ' << i << ' ' << samples.cases[i].text();
      }
    }
}

// A pack that is not full, whose lanes empty one after the other: blows of blocks that rock, some of which slip from
// then on.
TEST(LawsInBlocks, OfAnySizeHaveTheBitsOfSingleSamples) {
  for (const char* name : {"slack_tether", "pressure_friction", "moving_contents", "wall_impact"}) {
    Samples samples = samples_with(*effects::find(name), Model::slide_rock, 48);
    std::vector<std::size_t> with;
    for (std::size_t i = 0; i < samples.specimens.size(); ++i) {
      Specimen& specimen = samples.specimens[i];
      KeyedRandom random(95, i);
      specimen.friction.mu_k = random.uniform(0.9, 1.2) * specimen.block.right_m / specimen.block.height_m;
      specimen.friction.mu_s = random.uniform(1.0, 1.2) * specimen.friction.mu_k;
      specimen.impact.law = ImpactLaw::housner;
    }
    for (std::size_t i = 0; i < samples.specimens.size(); ++i)
      if (!samples.specimens[i].effects.empty()) with.push_back(i);
    if (std::string(name) == "slack_tether")  // one that is never reached is no law
      for (const std::size_t i : with) samples.specimens[i].effects[0].parameters[0] = 0;
    for (std::size_t size = 1; size <= 11; ++size)
      for (std::size_t first = 0; first + size <= with.size(); first += size) {
        std::vector<Specimen> specimens;
        std::vector<Shaking> shakings;
        for (std::size_t i = first; i < first + size; ++i) {
          specimens.push_back(samples.specimens[with[i]]);
          shakings.push_back(samples.shakings[with[i]]);
        }
        std::vector<Response> block(size);
        respond_batch(specimens, shakings, {}, block);
        for (std::size_t i = 0; i < size; ++i)
          EXPECT_TRUE(same_bits(block[i], respond(specimens[i], shakings[i])))
              << name << ", sample " << with[first + i] << " in a block of " << size;
      }
  }
}

// Of records, where the slip to each side is followed: only laws go in packs then.
bool one_by_one_by_side(const std::vector<EffectUse>& uses) {
  const auto is_no_law = [&](const EffectUse& use) { return no_laws.count(use.effect->name) > 0; };
  return std::all_of(uses.begin(), uses.end(), is_no_law);
}

// Laws together, one after the other in one pool: lanes of different tapes, sides of kinks and modes, with vertical shaking; and the
// slip to each side.
TEST(MixturesInBlocks, HaveTheBitsOfSingleSamplesWithAnyInstructionSet) {
  CaseFamily family;
  family.seed = 93;
  family.one_model = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 6;
  constexpr std::size_t count = 300;
  const Settings settings{.slip_by_side = true};
  Samples samples;
  std::vector<Response> alone;
  std::size_t expected = 0;  // to go one by one
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(94, i);
    samples.cases.push_back(random_case(family, i));
    samples.specimens.push_back(samples.cases.back().specimen);
    samples.shakings.push_back(samples.cases.back().shaking);
    Specimen& specimen = samples.specimens.back();
    specimen.model = i % 3 == 0 ? Model::slide : Model::slide_rock;
    specimen.effects = mixture(random, specimen.model);
    expected += one_by_one_by_side(specimen.effects);
    alone.push_back(respond(specimen, samples.shakings.back(), settings));
  }
  int compared = 0;
  for (const char* name : instruction_sets) {
    const Isa isa(name);
    if (!isa.there()) {
      std::printf("%s is not here\n", name);
      continue;
    }
    std::vector<Response> block(count);
    const std::size_t one_by_one = dynamics::respond_and_count(samples.specimens, samples.shakings, settings, block);
    EXPECT_EQ(one_by_one, expected) << name;
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_TRUE(same_bits(block[i], alone[i])) << name << ' ' << i << ' ' << samples.cases[i].text();
    ++compared;
  }
  EXPECT_TRUE(compared > 0 || !dynamics::batch_kernels());
}

}  // namespace
}  // namespace freestand::test
