// Bad study files: what is said about them, and where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "study_text.hpp"

namespace freestand::study::mistakes_test {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string rest = friction + motions + fragility + samples;  // all but the block
const std::string sound = block + rest;

struct Mistake {
  std::string text;  // of the whole file
  const char* line;  // "some.yaml:LINE:"
  const char* says;
};

std::string with_block(const std::string& text) { return "block: " + text + "\n" + rest; }
std::string with_friction(const std::string& text) {
  return block + "friction: " + text + "\n" + motions + fragility + samples;
}
std::string with_motion(const std::string& text) {
  return block + friction + "motions: [" + text + "]\n" + fragility + samples;
}
std::string with_fragility(const std::string& text) {
  return block + friction + motions + samples + "fragility: " + text + "\n";
}

void expect_each(const std::vector<Mistake>& mistakes) {
  for (const auto& [text, line, says] : mistakes) {
    const std::string found = problems(text);
    EXPECT_THAT(found, HasSubstr(std::string("folder/some.yaml:") + line + ": ")) << text;
    EXPECT_THAT(found, HasSubstr(says)) << text;
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0) << "more than one problem in:\n" << text << found;
    EXPECT_THAT(found, testing::MatchesRegex(".+:[0-9]+: .+ \\(.+\\): .+")) << text;
  }
}

TEST(StudyMistakes, TheSoundStudyHasNone) { EXPECT_EQ(problems(sound), ""); }

TEST(StudyMistakes, InTheBlock) {
  expect_each({
      {rest, "1", "block is missing"},
      {with_block("0.6"), "1", "block is a single value"},
      {with_block("{width: 0.6, height_m: 1.8, width_m: 0.6}"), "1", "key width in block has no unit"},
      {with_block("{width_mm: 600, height_m: 1.8, width_m: 0.6}"), "1", "another unit (freestand reads SI, here m)"},
      {with_block("{widht_m: 0.6, height_m: 1.8, width_m: 0.6}"), "1", "did you mean width_m?"},
      {with_block("{colour: red, height_m: 1.8, width_m: 0.6}"), "1", "unknown key colour in block (nothing reads it)"},
      {with_block("{width_m: 0.6}"), "1", "block.height_m is missing"},
      {with_block("{slenderness_rad: 0.3}"), "1", "block.size_m is missing"},
      {with_block("{width_m: 0.6, height_m: 1.8, size_m: 1}"), "1", "either by its sides or by slenderness and size"},
      {with_block("{slenderness_rad: 1.6, size_m: 1}"), "1", "a slenderness lies between 0 and pi/2"},
      {with_block("{width_m: 0.6, depth_m: 0.7, height_m: 1.8}"), "1", "width_m is the side along the shaking"},
      {with_block("{width_m: 0.6, height_m: 1.8}") + "mass_kg: 20\n", "6", "put it under it, block: {mass_kg: ...}"},
      {with_block("{width_m: 0, height_m: 1.8}"), "1", "block.width_m is 0 (a size must be above zero)"},
      {with_block("{width_m: -1, height_m: 1.8}"), "1", "block.width_m is -1"},
      {with_block("{width_m: {normal: {mean: 1, standard_deviation: 0.1}}, height_m: 1.8}"), "1",
       "its distribution has no lower end"},
      {with_block("{width_m: {uniform: [-0.1, 0.5]}, height_m: 1.8}"), "1", "its distribution reaches -0.1"},
      {with_block("{width_m: {uniform: [2, 1]}, height_m: 1.8}"), "1", "lower end 2 is not below its upper end 1"},
      {with_block("{width_m: {uniform: [1, 2, 3]}, height_m: 1.8}"), "1", "has 3 numbers (2 are needed)"},
      {with_block("{width_m: {lognormal: {median: 1, dispersion: -1}}, height_m: 1.8}"), "1", "dispersion -1"},
      {with_block("{width_m: {lognormal: {median: 1}}, height_m: 1.8}"), "1", "lognormal.dispersion is missing"},
      {with_block("{width_m: {lognormal: {median: 1, dispersion: 1, sigma: 2}}, height_m: 1.8}"), "1",
       "unknown key sigma"},
      {with_block("{width_m: {choice: []}, height_m: 1.8}"), "1", "empty choice"},
      {with_block("{width_m: {choice: [1, x]}, height_m: 1.8}"), "1", "holds \"x\""},
      {with_block("{width_m: {calibrate: [1, 2]}, height_m: 1.8}"), "1", "found calibrate"},
      {with_block("{width_m: {calibrat: [1, 2]}, height_m: 1.8}"), "1", "did you mean calibrate?"},
      {with_block("{width_m: {uniform: [1, 2], choice: [1]}, height_m: 1.8}"), "1", "both uniform and choice"},
      {with_block("{width_m: [1, 2], height_m: 1.8}"), "1", "is a list"},
      {with_block("{width_m: wide, height_m: 1.8}"), "1", "\"wide\" (a number or a distribution is needed)"},
      {with_block("{width_m: .inf, height_m: 1.8}"), "1", "\".inf\""},
      {with_block("{width_m: , height_m: 1.8}"), "1", "block.width_m has no value"},
      {with_block("{width_m: 1, height_m: 1.8, height_m: 2}"), "1", "stands twice"},
  });
}

TEST(StudyMistakes, InFrictionModelImpactAndEffects) {
  expect_each({
      {block + motions + fragility + samples, "1", "friction is missing"},
      {with_friction("{}"), "2", "friction.mu_k is missing"},
      {with_friction("{mu_s: 0.3}"), "2", "friction.mu_k is missing"},
      {with_friction("{mu: 0.3, mu_k: 0.2}"), "2", "both given (mu stands for both coefficients)"},
      {with_friction("{mu_k: 0.2, mu_s: 0.3, static_ratio: 1.5}"), "2", "one determines the other"},
      {with_friction("{mu_k: 0.3, mu_s: 0.2}"), "2", "friction.mu_s 0.2 is below friction.mu_k 0.3"},
      {with_friction("{mu_k: {uniform: [0.2, 0.3]}, mu_s: {uniform: [0.25, 0.4]}}"), "2", "use mu_k with static_ratio"},
      {with_friction("{mu_k: 0.2, static_ratio: 0.9}"), "2", "static friction is never below kinetic"},
      {with_friction("{mu: -0.1}"), "2", "it must not be negative"},
      {sound + "model: bouc_wen\n", "6", "bouc_wen is missing"},
      {sound + "bouc_wen: {yield_displacement_m: 0.001, exponent: 2}\n", "6", "model is another"},
      {sound + "model: bouc_wen\nbouc_wen: {exponent: 2}\n", "7", "bouc_wen.yield_displacement_m is missing"},
      {sound + "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0, exponent: 2}\n", "7", "a size must be above zero"},
      {sound + "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: {uniform: [0.5, 2]}}\n", "7",
       "must lie between 1 and 100"},
      {sound + "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 2, beta: {uniform: [0.2, 0.6]}}\n",
       "7", "would make energy"},
      {sound + "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 2, beta: -0.5}\n", "7",
       "never yield"},
      {sound + "model: sliding\n", "6", "choose one of slide, rock, slide_rock"},
      {sound + "impact: {law: newton}\n", "6", "choose one of housner, coulomb"},
      {sound + "impact: {factor: 1.1}\n", "6", "it must lie between 0 and 1"},
      {sound + "impact: {law: coulomb, factor: 0.9}\n", "6", "does not go with law coulomb"},
      {sound + "effects: [{name: impact_loss, factor: 0.9}]\nimpact: {law: coulomb}\n", "7",
       "follows from friction alone"},
      {sound + "effects:\n  - {name: seam, friction: \"mu*(1 + a)\", parameters: {a: 0.1, l_m: 1}}\n", "7",
       "parameter l_m of effect seam stands in none of its formulas"},
      {sound + "effects:\n  - {name: seam, friction: \"mu*(1 + a/u)\", parameters: {a: 0.1}}\n", "7",
       "friction of effect seam is infinite at u = 0 m, v = 0 m/s"},
      {sound + "effects:\n  - {name: seam, force: \"log(-1 - speed)\"}\n", "7", "force of effect seam is no number"},
      {sound + "effects:\n  - {name: seam, friction: \"-mu\"}\n", "7", "below zero it would push the block on"},
      {sound + "effects:\n  - {name: seam, friction: \"mu*sqrt(0.5 - t)\"}\n", "7",
       "is no number at u = 0.01 m, v = 0.2 m/s, t = 1 s"},
      {sound + "model: rock\neffects:\n  - {name: wall_impact, gap_m: 0.1}\n", "8",
       "the only wall there is the one behind a chain"},
      {sound + "effects:\n  - {name: wall_impact, gap_m: 0.1}\n  - {name: wall_impact, gap_m: -0.1}\n", "8",
       "other_gap_m is how far a second wall is, on the other side"},
      {sound + "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 2}\n"
               "chain: {stiffness_npm: 1e4, strength_n: 2736, wall_gap_m: 0.1}\n",
       "8", "chain.wall_gap_m does not go with model bouc_wen"},
      {sound + "effects: vertical_shaking\n", "6", "effects is no list"},
      {sound + "effects:\n  - {name: rate_weakning, drop: 0.4}\n", "7", "did you mean rate_weakening?"},
      {sound + "effects:\n  - {name: rate_weakening, drop: 0.4}\n", "7", "effects[0].speed_mps is missing"},
      {sound + "effects:\n  - {name: rate_weakening, drop: 1.4, speed_mps: 0.1}\n", "7", "must lie between 0 and 1"},
      {sound + "effects:\n  - {name: rate_weakening, drop: 0.4, speed_mps: 0}\n", "7", "must be above 0"},
      {sound + "model: slide\neffects:\n  - {name: offset_mass, eccentricity: 0.1}\n", "8",
       "does not go with model slide"},
      {sound + "effects:\n  - {name: wall_impact, gap_m: 0.1}\n  - {name: flexible_legs, frequency_hz: 4}\n", "8",
       "exclude each other"},
      {sound + "effects:\n  - {name: static_friction, friction: \"2*mu\"}\n", "7", "another name"},
      {with_friction("{mu_k: 0, mu_s: 1}") + "effects: [{name: law, friction: 1}]\n", "2", "can be 0 beside mu_s"},
      {sound + "effects:\n  - {scale: 0.4}\n", "7", "effects[0].name is missing"},
      {sound + "effects:\n  - {name: vertical_shaking, scal: 1}\n", "7", "did you mean scale?"},
      {sound + "effects: [{name: vertical_shaking}, {name: vertical_shaking}]\n", "6", "stands twice"},
  });
}

// What holds a block at a speed, as friction holds it at rest, is told before the first sample; what bends, or lets it pass, is a law
// like any other.
TEST(StudyMistakes, LawsThatLeapAgainstTheSpeed) {
  const auto with = [](const std::string& law) { return sound + "effects:\n  - {name: seam, " + law + "}\n"; };
  expect_each({
      {with("force: \"if(v>0,-3,3)\""), "7",
       "force of effect seam leaps from 3 to -3 m/s2 where the block stops and turns round (there only friction may, "
       "which can "
       "hold it): write it as friction: \"mu + 3/(g*normal)\""},
      {with("force: \"if(path>0.5,0.1*sigma,0)\""), "7", "leaps from -0.1 to 0.1 m/s2 where the block stops"},
      {with("force: \"-f*sigma\", parameters: {f: {uniform: [-1, 1]}}"), "7", "force of effect seam leaps"},
      {with("force: \"if(v>c,-3,1)\", parameters: {c_mps: {uniform: [0.1, 0.2]}}"), "7",
       "leaps from 1 to -3 m/s2 where v = 0.15 m/s (it would hold the block at that speed): let it pass"},
      {with("force: \"if(omega+0.1>0,-1,1)\""), "7", "where omega = -0.1 rad/s"},
      {with("friction: \"if(speed>0.1,0.4,0.1)\""), "7",
       "friction of effect seam leaps from 0.3333 to 1.333 times mu where the slip becomes faster than 0.1 m/s (it "
       "would hold"},
      {with("friction: \"if(v<-0.02*t,0.4,0.1)\""), "7", "faster than 0 m/s"},
      {with("friction: \"if(speed>0,0.3,0.1)\""), "7", "faster than 0 m/s"},
      {with("friction: \"mu/(1+rest)\""), "7", "where the slip becomes faster than 0 m/s"},
      {with("friction: \"mu*if(theta<0,0.5,1)\""), "7",
       "friction of effect seam leaps from 1 to 0.5 times mu where the block tips (it could then"},
      {with("force: \"-3*side\""), "7", "from 0 to -3 m/s2 where the block tips (it could then neither stand"},
  });
  for (const char* law :
       {"force: \"-0.5*v*abs(v)\"", "force: \"if(u>0.01,-3,3)\"", "force: \"-abs(v)*if(v>0,1,3)\"",
        "force: \"-2*normal\"", "force: \"-sigma*abs(v)^0.2\"", "force: \"-3*tanh(v/0.001)\"",
        "force: \"if(v>0.1,3,0)\"", "friction: \"if(speed>0,0.1,0.3)\"", "friction: \"if(sigma>0,0.1,0.3)\"",
        "friction: \"if(speed>0.1,0.1,0.4)\"", "friction: \"mu*(1+0.1*log(1+rest))\"",
        "friction: \"mu*(1+min(speed,0.1))\"", "friction: \"if(path>0,0.1,0.3)\"",
        "friction: \"if(abs(theta)>0,0.6,0.3)\"", "friction: \"if(abs(theta)>0.01,0.1,0.3)\"",
        "friction: \"mu*(1-0.5*min(abs(theta)/0.001,1))\"", "force: \"if(theta>0.01,-1,0)\"",
        "force: \"-3*min(abs(theta)/0.001,1)\"", "force: \"-2*theta\""})
    EXPECT_EQ(problems(with(law)), "") << law;
}

// Each formula finds room for itself on the tape of a sample, both do not; nor with the chain, which bends twice.
TEST(StudyMistakes, FormulasThatDoNotFindRoomTogether) {
  const auto with_effects = [](const std::string& text) { return sound + "effects:\n" + text; };
  const auto formula = [](const std::string& name, const std::string& text) {
    return "  - {name: " + name + ", force: \"" + text + "\"}\n";
  };
  std::string factors, bends = "abs(u)";
  for (int i = 0; i < 90; ++i) factors += "*v";
  for (int i = 1; i < 15; ++i) bends += "+abs(u-0.0" + std::to_string(10 + i) + ")";
  const std::string chain = "chain: {stiffness_npm: 1e4, strength_n: 2736}\n";
  EXPECT_EQ(problems(with_effects(formula("one", "u" + factors))), "");
  EXPECT_EQ(problems(with_effects(formula("one", bends))), "");
  expect_each({
      {with_effects(formula("one", "u" + factors + factors)), "7", "the laws of one are too long for one sample"},
      {with_effects(formula("one", "u" + factors) + formula("two", "theta" + factors)), "8",
       "the laws of one, two are too long for one sample (they make more than 142 operations)"},
      {with_effects(formula("one", bends) + formula("two", "abs(v)+abs(v-0.1)")), "8", "one, two bend too often"},
      {with_effects(formula("one", bends)) + chain, "8", "the laws of one and the chain bend too often"},
  });
}

TEST(StudyMistakes, InMotions) {
  expect_each({
      {block + friction + fragility + samples, "1", "motions is missing"},
      {with_motion(""), "3", "an empty one"},
      {with_motion("{period_s: 1}"), "3", "neither pulse nor records"},
      {with_motion("{pulse: Q, period_s: 1, peak_acceleration_g: 1}"), "3", "Q"},
      {with_motion("{pulse: [], period_s: 1, peak_acceleration_g: 1}"), "3", "empty choice"},
      {with_motion("{pulse: A, peak_acceleration_g: 1}"), "3", "has no period"},
      {with_motion("{pulse: A, period_s: 1}"), "3", "has no amplitude"},
      {with_motion("{pulse: A, period_s: 0, peak_acceleration_g: 1}"), "3", "a period must be above zero"},
      {with_motion("{pulse: A, period_s: 1e-300, peak_acceleration_g: 1}"), "3", "a shorter one moves nothing"},
      {with_motion("{pulse: A, period: 1, period_s: 1, peak_acceleration_g: 1}"), "3", "write period_s"},
      {with_motion("{pulse: A, period_s: 1, peak_acceleration_g: 1, peak_velocity_mps: 1}"), "3",
       "one determines the other"},
      {with_motion("{pulse: A, period_s: 1, peak_acceleration_g: 1, unit: g}"), "3", "does not go with pulse"},
      {with_motion("{pulse: A, period_s: 1, peak_acceleration_g: 1, scale_to: {pta_g: 1}}"), "3",
       "one determines the other"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {pgv_mps: 1}, scale: 2}"), "3", "one determines the other"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {}}"), "3", "no intensity that a motion can be scaled to"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {pgv: 1}}"), "3", "did you mean pgv_mps?"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {pgv_mps: 1, pga_g: 1}}"), "3", "remove one"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {report: 1}}"), "3", "does not grow in proportion"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {pgv_mps: 1, period_s: 1}}"), "3", "unknown key period_s"},
      {with_motion("{pulse: A, period_s: 1, scale_to: {sa_g: 1, period_s: 0}}"), "3", "at least 0.001"},
      {with_motion("{pulse: A, period_s: 1, peak_acceleration_g: 1, weight: 0}"), "3", "a weight must be above zero"},
      {with_motion("{records: \"nowhere/*.AT2\"}"), "3", "nowhere/*.AT2"},
      {with_motion("{records: \"nowhere/*.AT2\", pulse: A}"), "3", "a motion is one or the other"},
  });
}

TEST(StudyMistakes, InFragility) {
  expect_each({
      {with_fragility("{edp: [delta], im: pta}"), "5", "pta is not known (did you mean pta_g?)"},
      {with_fragility("{edp: [delta], im: {name: sa_g, period_s: 1e-9}}"), "5",
       "a stiffer oscillator only follows the floor"},
      {with_fragility("{edp: [delta], im: {name: pta_g, period_s: 1}}"), "5", "unknown key period_s"},
      {with_fragility("{edp: [dleta]}"), "5",
       "dleta is not known (did you mean delta?): name some of delta, overturned"},
      {with_fragility("{edp: [delta, delta]}"), "5", "twice"},
      {with_fragility("{edp: [delta], bins: {count: 0}}"), "5", "a whole number from 1 to 1000"},
      {with_fragility("{edp: [delta], bins: {count: 3, width: 1}}"), "5", "more than one of edges, width and count"},
      {with_fragility("{edp: [delta], bins: {edges: [1, 1, 2]}}"), "5", "does not increase"},
      {with_fragility("{edp: [delta], bins: {width: 1, spacing: log}}"), "5", "goes with count only"},
      {with_fragility("{edp: [peak_slip_m]}"), "5", "peak_slip_m has no capacities"},
      {with_fragility("{edp: [delta], capacities: {delta: [2, 1]}}"), "5",
       "each capacity must be above the one before"},
      {with_fragility("{edp: [delta], capacities: {delta: [0, 1]}}"), "5", "not above zero"},
      {with_fragility("{edp: [overturned], capacities: {overturned: [1]}}"), "5", "it happens or not"},
      {with_fragility("{edp: [delta], capacities: {peak_slip_m: [1]}}"), "5", "not in fragility.edp"},
      {with_fragility("{edp: [delta], capacities: {detla: [1]}}"), "5", "did you mean delta?"},
      {with_fragility("{edp: [delta], axes: [friction.mu]}"), "5", "has one value only"},
      {with_fragility("{edp: [delta], axes: [motion.pta]}"), "5", "did you mean motion.pta_g?"},
      {block + friction + samples + "motions: [{pulse: A, period_s: 1, peak_acceleration_g: 1}]\n" +
           "fragility: {edp: [delta], axes: [motion.pta_g]}\n",
       "5", "axis motion.pta_g has one value only"},
      {with_fragility("{edp: [delta], confidence: 1}"), "5", "between 0 and 1"},
      {with_fragility("{edp: [delta], resamples: many}"), "5", "a whole number"},
      {with_fragility("{edp: [delta], resamples: 1}"), "5", "a whole number from 2 to 60000"},
      {with_fragility("{edp: [delta], resamples: 60001}"), "5", "a whole number from 2 to 60000"},
      {with_fragility("{edp: [delta], minimum_samples: 1}"), "5", "a whole number from 2"},
      {with_fragility("{edp: [delta], false_discovery: 0}"), "5", "between 0 and 1"},
  });
}

TEST(StudyMistakes, InDamageStates) {
  const auto state = [](const std::string& text) {
    return with_fragility("{edp: [delta], damage: {door: " + text + "}}");
  };
  EXPECT_EQ(problems(state("delta > 1 or overturned")), "");
  EXPECT_EQ(problems(state("{when: delta > gap, parameters: {gap: {uniform: [1, 2]}}}")), "");
  // Where a condition does not hold together, two lines more show the place.
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"delta > 1 and mu_k > 0.2", "\"mu_k\" is not known here, character 15"},
           {"dleta > 1", "did you mean delta?"},
           {"delta >", "it ends too early"},
           {"(delta > 1", "a parenthesis is not closed"},
           {"delta + 1", "it is a number and no condition"},
           {"delta", "it is a number and no condition"},
           {"\"delta = 1\"", "\"=\" is not known here, == is"}}) {
    const std::string found = problems(state(text));
    EXPECT_THAT(found, testing::AllOf(testing::StartsWith("folder/some.yaml:5: "), HasSubstr(says))) << text;
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 2) << found;
  }
  expect_each({
      {with_fragility("{edp: [delta], damage: [delta > 1]}"), "5", "fragility.damage is a list"},
      {state(""), "5", "fragility.damage.door has no value"},
      {state("2 > 1"), "5", "looks at no demand"},
      {state("{when: delta > 1, parameters: {gap: 0.1}}"), "5", "parameter gap of damage state door stands nowhere"},
      {state("{when: delta > overturned, parameters: {overturned: 0.1}}"), "5", "cannot be called that"},
      {state("{when: delta > gap, parameters: {gap: wide}}"), "5", "\"wide\""},
      {state("{parameters: {gap: 1}}"), "5", "fragility.damage.door.when is missing"},
      {state("{when: delta > 1, wen: 2}"), "5", "unknown key wen"},
      {with_fragility("{edp: [delta], damage: {overturned: delta > 1}}"), "5", "has the name of a demand"},
      {with_fragility("{edp: [delta], damage: {a-b: delta > 1}}"), "5", "is no plain word"},
      {with_fragility("{edp: [delta], capacities: {delta: [1, {lognormal: {median: 1}}]}}"), "5",
       "dispersion is missing"},
      {with_fragility("{edp: [delta], capacities: {delta: [{normal: {mean: 1, standard_deviation: 1}}]}}"), "5",
       "must be above zero"},
  });
}

TEST(StudyMistakes, InTheSweep) {
  const std::string without = block + friction + motions + fragility;
  expect_each({
      {without, "1", "samples is missing"},
      {without + "samples: 0\n", "5", "a whole number of at least 1"},
      {without + "samples: -5\n", "5", "-5"},
      {without + "samples: 1.5\n", "5", "1.5"},
      {sound + "until: {half_width: 0.02}\n", "6", "samples and until are both given"},
      {without + "until: {}\n", "5", "half_width is missing"},
      {without + "until: {half_width: 0.02}\ndesign: latin_hypercube\n", "6",
       "its strata depend on the number of samples"},
      {sound + "design: sobal\n", "6", "did you mean sobol?"},
      {sound + "seed: -1\n", "6", "seed is -1"},
      {sound + "tolerance: 0\n", "6", "tolerance is 0"},
      {sound + "tolerance: 1e-30\n", "6", "tolerance is 1e-30 (it must lie between 1e-12"},
      {without + "samples: 1000000000000000\n", "5", "are too many blocks (33554432 at most, 4194304 of samples that are kept"},
      {without + "until: {half_width: 0.02, at_most: 1000000000000}\nblock_size: 2\n", "5", "lower at_most"},
      {sound + "free_vibration: 3\n", "6", "write free_vibration_s"},
      {sound + "block_size: 0\n", "6", "block_size is 0"},
      {sound + "sampels: 3\n", "6", "did you mean samples?"},
  });
}

TEST(StudyMistakes, ACaseIsNoStudy) {
  EXPECT_EQ(problems(block + friction + "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n"),
            "folder/some.yaml:3: motion is what a case has (a study has motions): write motions, or give a case to "
            "`freestand simulate`");
  EXPECT_EQ(case_problems(sound),
            "one.yaml:3: motions is what a study has (a case has motion): write motion, or give a study to "
            "`freestand run`");
}

TEST(StudyMistakes, InYamlItself) {
  EXPECT_THAT(problems("block: {width_m: 1\nsamples: 3\n"),
              testing::ContainsRegex("some.yaml:[0-9]+: this is not YAML"));
  EXPECT_THAT(problems(""), HasSubstr("the file is empty"));
  EXPECT_THAT(problems("- 1\n- 2\n"), HasSubstr("the file is a list"));
  EXPECT_THROW(read_study("no/such/study.yaml", known()), Error);
}

TEST(StudyMistakes, WhatIsOftenWrongWithAFileIsToldInWords) {
  expect_each({
      {"block:\n  width_m: 0.6\n\theight_m: 1.8\n" + rest, "3", "a tab indents this line"},
      {"block:\n\twidth_m: 0.6\n\theight_m: 1.8\n" + rest, "2", "a tab indents this line"},
      {"block: width_m: 0.6, height_m: 1.8\n" + rest, "1", "an item without braces"},
      {block + friction + samples + fragility + "motions:\n  - pulse: B, period_s: 1, peak_acceleration_g: 1\n", "6",
       "an item without braces"},
      {with_motion("pulse: B, period_s: 1, peak_acceleration_g: 1"), "3",
       "motions has 3 items of one key each (the keys of one item stand in braces): write [{pulse: ..., period_s: ..., "
       "peak_acceleration_g: ...}]"},
      {sound + "effects: [name: rate_weakening, drop: 0.4, speed_mps: 0.1]\n", "6", "effects has 3 items of one key"},
      {with_fragility("{edp: [delta], axes: [name: friction.mu, bins: {count: 3}]}"), "5",
       "axes has 2 items of one key"},
      {sound + std::string("\x89HDF\r\n\x1a\n\0\0", 10), "8", "no text but a binary file"},
      {std::string("\0\1", 2), "1", "no text but a binary file (its byte 1 is 0x00)"},
  });
  EXPECT_EQ(problems("# \t a tab that indents nothing\n" + sound), "");
  EXPECT_EQ(problems(sound + "effects: [name: static_friction]\n").find("items of one key"), std::string::npos);
}

TEST(StudyMistakes, AllAreReportedAtOnceWithTheirLines) {
  const std::string text =
      "samples: 0\n"
      "block:\n"
      "  width: 0.6\n"
      "  height_m: -1.8\n"
      "friction: {mu: {uniform: [0.3, 0.2]}}\n"
      "motions:\n"
      "  - {pulse: B, period_s: 0.5, peak_acceleration_g: 1}\n"
      "  - {records: \"nowhere/*.AT2\"}\n"
      "fragility: {im: nothing_known, edp: [delta]}\n"
      "modle: slide\n";
  const std::string found = problems(text);
  for (const char* says : {"some.yaml:1: samples is 0", "some.yaml:3: key width in block has no unit",
                           "some.yaml:2: block.width_m is missing", "some.yaml:4: block.height_m is -1.8",
                           "some.yaml:5: friction.mu: impossible distribution", "some.yaml:8: motions[1].records",
                           "some.yaml:9: intensity measure nothing_known", "some.yaml:10: unknown key modle"})
    EXPECT_THAT(found, HasSubstr(says));
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 7) << found;
}

TEST(CaseMistakes, ACaseIsOneSample) {
  const std::string motion = "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n";
  EXPECT_EQ(case_problems(block + friction + motion), "");
  EXPECT_THAT(case_problems(block + friction), HasSubstr("motion is missing"));
  EXPECT_THAT(case_problems(block + "friction: {mu: {uniform: [0.1, 0.2]}}\n" + motion),
              HasSubstr("one.yaml:2: friction.mu is a distribution (a case is one sample)"));
  EXPECT_THAT(
      case_problems(block + friction + motion + "chain: {stiffness_npm: {uniform: [1e4, 1e5]}, strength_n: 2736}\n"),
      HasSubstr("one.yaml:4: chain.stiffness_npm is a distribution (a case is one sample)"));
  EXPECT_THAT(case_problems(block + friction + "motion: {pulse: [A, B], period_s: 0.5, peak_acceleration_g: 0.6}\n"),
              HasSubstr("name one pulse"));
  EXPECT_THAT(case_problems(block + friction + motion + "samples: 3\n"), HasSubstr("unknown key samples"));
  EXPECT_THAT(case_problems(block + friction + "motion: {file: nowhere.csv}\n"), HasSubstr("nowhere.csv"));
  EXPECT_THAT(case_problems(block + friction + motion + "output_step_s: 0\n"), HasSubstr("output_step_s is 0"));
}

}  // namespace
}  // namespace freestand::study::mistakes_test
