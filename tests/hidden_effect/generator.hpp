// Generator of measurements with a hidden effect: what a specimen that obeys a known truth does on a shaken floor.
//
// It steps contact impulses (support/moreau_stepper.hpp), model bouc_wen's contact by Runge-Kutta, and shares nothing with src/dynamics and src/effects: the
// program does not mark its own homework. The laws are those of PHYSICS section 5, their names and the keys of their
// parameters as well, and four that stand in no catalogue:
//   rough_floor      mu (1 + r sin(2 pi u/L)): ratio, length_m
//   friction_heating mu (1 + d (1 - exp(-t/T))): rise, time_s
//   quadratic_drag   force per mass -c v |v|: per_m
//   stick_ageing     mu_s (1 + d ln(1 + tau/T)), tau = time since the contact stuck, or the block was struck, from 0 at the start: rise, time_s
// And the chain of PHYSICS section 4, which pulls at a point of the side face away from `side` (+1, -1), height_m over
// the base, when that has moved by more than slack_m along it; elevation_rad of its other end over that point; stiffness and strength over
// the mass.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace freestand::test {

enum class TruthModel { slide, rock, slide_rock, bouc_wen };
enum class TruthImpact { housner, coulomb };

struct TruthEffect {
  std::string name;
  std::map<std::string, double> parameters;  // missing ones: the defaults of PHYSICS, or an error
};

// Of model bouc_wen: support/bouc_wen_stepper.hpp.
struct TruthContact {
  double yield_m = 0.00254, exponent = 2, gamma = 0.5, beta = 0.5;
};

struct Truth {
  double left_m = 0, right_m = 0, height_m = 0, gyration2_m2 = 0;  // as freestand::Block
  double mu_s = 0, mu_k = 0;
  TruthModel model = TruthModel::slide_rock;
  TruthImpact impact = TruthImpact::housner;
  double impact_factor = 1;
  std::vector<TruthEffect> effects;
  TruthContact contact;
};

// Uniform rectangle.
Truth rectangular_truth(double width_m, double height_m, double mu, std::vector<TruthEffect> effects = {});

// Acceleration of the floor at equal steps, linear between them [m/s2]. vertical may be empty.
struct FloorSamples {
  double dt_s = 0.005;
  std::vector<double> horizontal_mps2, vertical_mps2;
};

// What the contacts did at any time between two samples, as bits.
enum TruthDeed : unsigned {
  slid = 1,          // both corners closed, slipping
  rocked = 2,        // one corner closed, stuck
  slide_rocked = 4,  // one corner closed, slipping
  flew = 8,          // no corner closed
  struck_by_face = 16,
  struck_by_lower_edge = 32,
  struck_by_upper_edge = 64,
  struck_in_flight = 128,
  leaned = 256,  // on one corner, and against a wall
  broke_the_chain = 512,
  landed_nearly_flat = 1024  // both corners within a tenth of a micrometre: which one came first nobody can tell
};

// At the times of the floor's samples, from 0.
struct TruthHistory {
  double dt_s = 0;
  std::vector<unsigned> deeds;  // up to each of the times, since the one before: TruthDeed
  std::vector<double> slip_m, rotation_rad, block_acceleration_mps2;  // as in a measurement, without noise
  std::string outcome;  // at_rest | moved | overturned | painleve; the last two hold the values of their last instant
  double peak_acceleration_mps2 = 0;  // of the centre of mass, without gravity, blows left out
  double peak_slip_m = 0, residual_slip_m = 0, slid_path_m = 0, peak_rotation_rad = 0;
  // Of model bouc_wen, whose deeds are `slid` where more than three quarters of a further displacement would remain.
  std::vector<double> remaining_m, path_m;  // what would remain of the slip at each of the times, and its path so far
  std::vector<double> turns_s, turns_m;     // when and where it turned
};

// step_s: of the stepper, at most; it divides the floor's. Model bouc_wen has steps of their own and errors that fall with
// the square of step_s. Throws std::invalid_argument on effects and parameters that
// do not exist.
TruthHistory simulate(const Truth& truth, const FloorSamples& floor, double step_s = 2e-5);

// Effects of the catalogue, in the order of PHYSICS, and those outside of it.
const std::vector<std::string>& catalogue_effects();
const std::vector<std::string>& outside_effects();

}  // namespace freestand::test
