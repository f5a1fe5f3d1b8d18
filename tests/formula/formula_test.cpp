// Laws written in a study: what they compute, what is wrong in them and where, and that they are the catalogue's laws
// where they say the same.
#include "formula/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "dynamics/laws.hpp"
#include "effects/effects.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"

namespace freestand::formula {
namespace {

using dynamics::Input;

// The formula as a force, with u = 0.3, v = -0.7, theta = 0.1 and a parameter a = 2, l_m = 0.5.
double value(const std::string& text) {
  const dynamics::Effect law = effect("f", "", text, {"a", "l_m"});
  Specimen specimen{Block::rectangular(1, 1, 1), {0.25, 0.25}, {}};
  specimen.effects.push_back({&law, {2, 0.5}});
  const dynamics::Laws laws(specimen);
  dynamics::Series<double, 0> values[dynamics::max_nodes];
  for (int i = 0; i < dynamics::input_count; ++i) values[i][0] = 0;
  values[static_cast<int>(Input::u)][0] = 0.3;
  values[static_cast<int>(Input::v)][0] = -0.7;
  values[static_cast<int>(Input::theta)][0] = 0.1;
  std::uint32_t sides = 0;
  for (int j = 0, from = dynamics::input_count; j <= laws.tape.kink_count(); ++j) {
    const int to = j < laws.tape.kink_count() ? laws.tape.kink_node(j) : laws.tape.size();
    laws.tape.advance(from, to, 0, sides, values);
    from = to;
    if (j < laws.tape.kink_count() && values[laws.tape.kink_argument(j)][0] < 0) sides |= 1U << j;
  }
  return values[laws.force][0];
}

TEST(Formula, ComputesWhatItSays) {
  const double u = 0.3, v = -0.7, theta = 0.1, a = 2, l = 0.5;
  const std::vector<std::pair<std::string, double>> cases = {
      {"1.5e-1", 0.15},
      {"u + v - theta", u + v - theta},
      {"a - u - v", a - u - v},
      {"a*u/l", a * u / l},
      {"a/u/l", a / u / l},
      {"a/(u/l_m)", a / (u / l)},
      {"-u^2", -u * u},
      {"2^3^0.5", std::pow(2, std::pow(3, 0.5))},
      {"u^a", std::pow(u, a)},
      {"u^(-2)", 1 / (u * u)},
      {"3*-u", -3 * u},
      {"exp(u) + log(u) + sqrt(u)", std::exp(u) + std::log(u) + std::sqrt(u)},
      {"sin(2*pi*u/l)*cos(v)", std::sin(2 * pi * u / l) * std::cos(v)},
      {"tanh(3*v)", std::tanh(3 * v)},
      {"abs(v) - abs(u)", 0.7 - 0.3},
      {"min(u, v) + 10*max(u, v)", v + 10 * u},
      {"step(u) + 2*step(v)", 1},
      {"(u > v) + 2*(u < v)", 1},
      {"if(v > 0, 5, 7)", 7},
      {"if(u > 0, if(v > 0, 1, 2), 3)", 2},
      {"if(u > 1, sqrt(u - 1), 7)", 7},
      {"sqrt(u - u) + (v - v)^0.3", 0},
      {"g + mu", standard_gravity_mps2 + 0.25},
      {" ( ( u ) ) ", u},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NEAR(value(text), expected, 1e-14 * (1 + std::abs(expected))) << text;
}

TEST(Formula, TellsWhatIsWrongAndWhere) {
  const std::vector<std::tuple<std::string, std::size_t, std::string>> cases = {
      {"mu*(1 + *u)", 8, "stands where it cannot"},
      {"mu*(1 + w)", 8, "\"w\" is not known"},
      {"mu*(1 + u", 9, "parenthesis"},
      {"mu*1 + u)", 8, "parenthesis"},
      {"", 0, "empty"},
      {"mu*", 3, "ends too early"},
      {"sin(u, v)", 8, "arguments"},
      {"min(u)", 5, "arguments"},
      {"cosh(u)", 0, "not known"},
      {"u > 0 ? 1 : 2", 6, "if(condition, yes, no)"},
      {"u = 3", 2, "not known"},
      {"2 u", 2, "stands where it cannot"},
      {"u, v", 1, "more than one value"},
  };
  for (const auto& [text, position, says] : cases) {
    try {
      Formula(text, {});
      ADD_FAILURE() << text << " was read";
    } catch (const FormulaError& error) {
      EXPECT_EQ(error.position(), position) << text << ": " << error.what();
      EXPECT_THAT(error.what(), testing::HasSubstr(says)) << text;
    }
  }
}

// The catalogue's laws, written out.
TEST(Formula, IsTheCataloguesLawWhereItSaysTheSame) {
  struct Twin {
    const char* name;
    std::vector<double> parameters;
    std::string friction, force;
  };
  const std::vector<Twin> twins = {
      {"rate_weakening", {0.4, 0.1}, "mu*(1 - 0.4*(1 - exp(-speed/0.1)))", ""},
      {"friction_wear", {0.6, 0.2}, "mu*(0.6 + 0.4*exp(-path/0.2))", ""},
      {"directional_friction", {0.2}, "mu*(1 + 0.2*sigma)", ""},
      {"pressure_friction", {-0.3}, "mu*max(normal, 1e-6)^(-0.3)", ""},
      {"viscous_drag", {2}, "", "-2*v"},
      {"centering_spring", {0.6}, "", "-(2*pi*0.6)^2*u"},
      {"slack_tether", {0.02, 2, 1}, "", "-if(u > 0.02, max((2*pi*2)^2*(u - 0.02) + v, 0), 0)"},
  };
  test::CaseFamily family;
  family.seed = 9;
  family.alpha_high = 0.6;
  family.duration_high_s = 6;
  for (const Twin& twin : twins) {
    const dynamics::Effect law = effect("twin", twin.friction, twin.force, {});
    int moved = 0;
    for (std::uint64_t number = 0; number < 10; ++number) {
      test::RandomCase c = test::random_case(family, number);
      c.specimen.effects = {{effects::find(twin.name), twin.parameters}};
      const Response a = respond(c.specimen, c.shaking);
      c.specimen.effects = {{&law, {}}};
      const Response b = respond(c.specimen, c.shaking);
      EXPECT_EQ(a.outcome, b.outcome) << twin.name << " " << c.text();
      if (a.outcome == Outcome::overturned) continue;  // near it round-off grows
      EXPECT_NEAR(a.peak_slip_m, b.peak_slip_m, 1e-7) << twin.name << " " << c.text();
      EXPECT_NEAR(a.peak_rotation_rad, b.peak_rotation_rad, 1e-7) << twin.name << " " << c.text();
      moved += a.outcome == Outcome::moved;
    }
    EXPECT_GE(moved, 3) << twin.name;
  }
}

// A formula of friction is the friction, whatever mu the study gives: of 0 too, where a factor on mu would say nothing.
TEST(Formula, OfFrictionActsWhereMuIsZero) {
  test::CaseFamily family;
  family.seed = 11;
  const dynamics::Effect law = effect("constant", "0.2", "", {});
  int moved = 0;
  for (std::uint64_t number = 0; number < 6; ++number) {
    test::RandomCase c = test::random_case(family, number);
    c.specimen.friction = {0.2, 0.2};
    const Response plain = respond(c.specimen, c.shaking);
    moved += plain.slid_path_m > 0.01;
    for (const double mu : {0.0, 0.2, 0.7}) {
      c.specimen.friction = {mu, mu};
      c.specimen.effects = {{&law, {}}};
      const Response by_formula = respond(c.specimen, c.shaking);
      c.specimen.effects.clear();
      EXPECT_EQ(by_formula.outcome, plain.outcome) << mu << c.text();
      if (plain.outcome != Outcome::overturned) {
        EXPECT_NEAR(by_formula.slid_path_m, plain.slid_path_m, 1e-7) << mu << c.text();
      }
    }
  }
  EXPECT_GT(moved, 2);
}

// Static friction is mu_s/mu_k times the formula: of a mu_k of 0 there is no such ratio. (It was infinite, and the block at rest for ever.)
TEST(Formula, OfFrictionBesideStaticFrictionAloneIsNoAnswer) {
  const dynamics::Effect law = effect("constant", "0.2", "", {});
  test::CaseFamily family;
  test::RandomCase c = test::random_case(family, 3);
  c.specimen.friction = {0, 0.2};
  c.specimen.effects = {{&law, {}}};
  EXPECT_EQ(respond(c.specimen, c.shaking).outcome, Outcome::not_finite);
}

// Friction that lets go for a while, at 0.5 s for a slip to the left and at 1.5 s for one to the right, while a steady floor pulls: the
// block slides for 0.1 s, then on until friction has stopped it. Of a pull a over g and friction 0.1, then 0.5, the slip is
//   (a - 0.1) g 0.1^2/2 (1 + (a - 0.1)/(0.5 - a))
TEST(Formula, ConditionsOfBothDirectionsAreSeenWhileTheBlockIsStuck) {
  const dynamics::Effect law = effect("window", "if(abs(t - 1 - 0.5*sigma) < 0.05, 0.1, 0.5)", "", {});
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 0.6, 100);
  specimen.friction = {0.5, 0.5};
  specimen.model = Model::slide;
  const double pull = 0.3, slip = (pull - 0.1) * standard_gravity_mps2 * 0.005 * (1 + (pull - 0.1) / (0.5 - pull));
  for (const double sign : {1.0, -1.0}) {
    const FloorMotion steady = test::rectangular_pulse(sign * pull * standard_gravity_mps2, 3);
    specimen.effects = {{&law, {}}};
    EXPECT_NEAR(respond(specimen, {&steady}).peak_slip_m, slip, 1e-6) << sign;
    EXPECT_NEAR(respond_reference(specimen, {&steady}).peak_slip_m, slip, 1e-6) << sign;
  }
}

// What cannot be computed ends the sample, soon, and its numbers are no demands.
TEST(Formula, NotANumberIsAnOutcome) {
  test::CaseFamily family;
  family.alpha_low = 0.6;
  family.one_model = 0;
  test::RandomCase c = test::random_case(family, 1);
  ASSERT_EQ(respond(c.specimen, c.shaking).outcome, Outcome::moved);
  for (const char* force : {"1/u", "sqrt(-1 - abs(u))", "log(0*t)", "0/(v - v)", "exp(1000 + t)", "(u - 1)^0.5"}) {
    const dynamics::Effect law = effect("broken", "", force, {});
    c.specimen.effects = {{&law, {}}};
    for (const auto solve : {respond, respond_reference}) {
      const Response r = solve(c.specimen, c.shaking, {}, nullptr);
      EXPECT_EQ(r.outcome, Outcome::not_finite) << force;
      EXPECT_LT(r.events, 1000) << force;
    }
  }
}

// The number of a formula, taken straight from its operations, is the one that the tape gives.
TEST(Formula, ValueWithoutATape) {
  for (const char* text : {"u + v*theta - a/l", "if(u > 0.2, exp(-u/l_m), 5)", "if(v > 0, 1, step(u)*a^3)",
                           "min(u, v) + max(u, v)*abs(v) + sqrt(a) - log(l)", "sin(u)*cos(v) + tanh(theta) + (u < v)",
                           "-u^2 + 2^3^2 + g*pi"}) {
    const Formula law(text, {"a", "l_m"});
    EXPECT_NEAR(law.value({0.3, -0.7, 0.1, 0, 0, 0, 0, 0, 0, 0}, 0.25, {2, 0.5}), value(text), 1e-12) << text;
  }
  const Formula law("mu*(1 + a*u)", {"a", "l_m"});
  EXPECT_TRUE(law.uses(0));
  EXPECT_FALSE(law.uses(1));
  EXPECT_TRUE(Formula("l", {"a", "l_m"}).uses(1));
}

TEST(Formula, TooLongForATapeIsFoundOut) {
  std::string text = "u";
  for (int i = 0; i < 300; ++i) text += "*v";
  const dynamics::Effect law = effect("long", "", text, {});
  Specimen specimen{Block::rectangular(1, 1, 1), {0.25, 0.25}, {}};
  specimen.effects.push_back({&law, {}});
  EXPECT_FALSE(dynamics::Laws(specimen).sound());
}

}  // namespace
}  // namespace freestand::formula
