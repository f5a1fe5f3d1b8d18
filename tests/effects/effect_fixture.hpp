// What every effect's test asks of it, beside the closed form of its law.
#pragma once

#include <gtest/gtest.h>

#include <freestand/simulate.hpp>
#include <string>
#include <vector>

#include "effects/effects.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {

inline constexpr double g = standard_gravity_mps2;
inline constexpr Solver both_solvers[] = {fast_solver, reference_solver};

// Parameters in the order of the declaration.
EffectUse effect(const std::string& name, const std::vector<double>& parameters);

// A squat block that only slides; mu for both coefficients.
Specimen sliding(double mu, const std::vector<EffectUse>& effects = {});
// A slender block, 0.4 m by 1.8 m, that rocks and slides.
Specimen slender(double mu, const std::vector<EffectUse>& effects = {}, Model model = Model::slide_rock);

// Response and history, a point each `step_s`, `free_s` beyond the motion, at tolerance 1e-12.
struct Path {
  Response response;
  std::vector<HistoryPoint> points;
};
Path run(const Solver& solver, const Specimen& specimen, const Shaking& shaking, double free_s = 1,
         double step_s = 0.001);

struct General {
  std::string name;
  std::vector<double> values;    // at which the effect matters
  std::vector<double> mirrored;  // the same effect seen in a mirror
  std::vector<double> neutral;   // at which it vanishes; empty: not tested here
  std::vector<Model> models = {Model::slide, Model::slide_rock};
  int cases = 12;   // random specimens and motions for each model
  int matters = 6;  // in at least so many of them the effect changes the answer
};

// Vanishes at its neutral parameters (to 1e-10, and to the bit where it is no part of the equations of motion), mirrors
// to the bit, agrees between the two integrators (to 1e-8), and matters: on random specimens under random motions, at
// tolerance 1e-12. What a hundred tolerances do to the answer is allowed on top.
void expect_general(const General& general);

// How far two answers are apart: the largest difference of a slip, a path or a rotation [m], [rad]; 1 where one overturned
// and the other did not.
double distance(const Response& a, const Response& b);

// The most that changes of the shaking by parts of the size given, up and down, move an answer.
double moved_by(double part, const Specimen& specimen, const Shaking& shaking, const Settings& settings,
                const Response& answer);

}  // namespace freestand::test
