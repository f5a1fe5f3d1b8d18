// Effects together: random mixtures of several, on random specimens under random motions.
#include <cmath>

#include "effects/effect_fixture.hpp"
#include "effects/mixture.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

TEST(Mixtures, BothIntegratorsAgreeAndNothingFails) {
  CaseFamily family;
  family.seed = 2024;
  family.alpha_high = 0.9;
  family.mu_high = 0.7;
  family.one_model = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 6;
  int sensitive = 0, compared = 0, moved = 0;
  for (std::uint64_t number = 0; number < 240; ++number) {
    KeyedRandom random(5, number);
    RandomCase c = random_case(family, number);
    c.specimen.model = number % 3 == 0 ? Model::slide : Model::slide_rock;
    c.specimen.effects = mixture(random, c.specimen.model);
    std::string text = c.text();
    for (const auto& use : c.specimen.effects) {
      text.append(" ").append(use.effect->name);
      for (const double p : use.parameters) text.append(" ").append(testing::PrintToString(p));
    }
    const Response fast = respond(c.specimen, c.shaking);
    EXPECT_NE(fast.outcome, Outcome::step_limit) << text;
    EXPECT_NE(fast.outcome, Outcome::not_finite) << text;
    moved += fast.outcome == Outcome::moved;
    const Response reference = respond_reference(c.specimen, c.shaking);
    const double apart = distance(fast, reference);
    if (apart < 1e-6) {
      ++compared;
      continue;
    }
    // Steps err by the tolerance, 1e-9 each. Only where a change of the shaking by ten of it moves the answer as far as
    // the two are apart, impacts have amplified round-off.
    if (moved_by(1e-8, c.specimen, c.shaking, {}, fast) >= apart)
      ++sensitive;
    else
      ADD_FAILURE() << number << " " << text << "\n apart " << apart << "\n fast " << name(fast.outcome) << " "
                    << fast.peak_slip_m << " " << fast.residual_slip_m << " " << fast.slid_path_m << " "
                    << fast.peak_rotation_rad << " " << fast.events << "\n reference " << name(reference.outcome) << " "
                    << reference.peak_slip_m << " " << reference.residual_slip_m << " " << reference.slid_path_m << " "
                    << reference.peak_rotation_rad << " " << reference.events;
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(moved, 120);
  EXPECT_LT(sensitive, 12);
}

}  // namespace
}  // namespace freestand::test
