// The model that is held against measurements: a specimen some of whose numbers are free.
#pragma once

#include <freestand/specimen.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamics/effect.hpp"
#include "measurement/data/dataset.hpp"
#include "measurement/search.hpp"

namespace freestand::measurement {

// A number of the model: fixed, or the free one at that place.
struct Number {
  double value = 0;
  int free = -1;
  double of(std::span<const double> x) const { return free < 0 ? value : x[static_cast<std::size_t>(free)]; }
};

struct EffectTerm {
  const dynamics::Effect* effect = nullptr;  // not owned
  std::vector<Number> parameters;
};

// Chains to the wall behind (dynamics/chain.hpp).
struct ChainTerm {
  Number slack, stiffness, strength;
  std::optional<Number> height;  // absent: the block's
  Number number{.value = 1}, plan_angle = {}, elevation = {}, damping = {};
  std::optional<Number> wall_gap = {};
  int side = 1;
};

struct ModelSpec {
  // Sides, or slenderness atan(W/H) with half the diagonal; absent: the specimen's of the test.
  std::optional<Number> width, height, slenderness, size, mass;
  std::optional<Number> centre_height, gyration_radius, inertia;  // absent, and not measured: of a uniform rectangle
  // What the laboratory may have read wrongly, over what it states: width, height of the centre of mass, friction of one test, the
  // floor's acceleration; and by how much the responses are stamped late against the floor's [s].
  Number width_factor{.value = 1}, centre_height_factor{.value = 1}, friction_factor{.value = 1},
      floor_gain{.value = 1}, clock_behind;
  std::map<std::string, Number> friction_of_test;  // a factor on the friction of one test, by its id; absent: 1
  Number mu_k;
  std::optional<Number> mu_s, static_ratio;  // neither: mu_s = mu_k
  Model model = Model::slide_rock;
  BoucWen bouc_wen;
  ImpactLaw impact_law = ImpactLaw::housner;
  Number impact_factor{.value = 1};
  std::vector<EffectTerm> effects;
  std::optional<ChainTerm> chain;
  // Outcomes only: standard deviation of ln(width) from test to test, since no two placements are alike (placements.hpp).
  std::optional<Number> placement_scatter;
  std::vector<Free> free;

  bool has(const std::string& effect) const;
};

// The specimen of a test with the free numbers at x. Dimensions must be known (check with missing_dimension).
Specimen specimen(const ModelSpec&, const Dimensions&, std::span<const double> x);
Specimen specimen(const ModelSpec&, const Test&, std::span<const double> x);

// Name of a dimension that neither the model nor the test's specimen gives; empty: all are known.
std::string missing_dimension(const ModelSpec&, const Test&);

// The catalogue's range of a parameter as a free number. reach: least and greatest slip that was measured [m]; lengths
// with a sign (gaps, slacks) start within it, and at its ends: there something may have stopped the block.
struct Reach {
  double least_m = 0, greatest_m = 0;
};
Free free_parameter(const dynamics::Effect&, const dynamics::Parameter&, const Reach&);

// The model with one more effect, whose parameters are free but for those that are known.
ModelSpec with_effect(const ModelSpec&, const dynamics::Effect&, const Reach&);
// All that a parameter of an effect may be in a fit: ten times beyond the range that is met in practice to both sides, as far as the
// effect allows. Draws of a number that the tests leave open end there.
struct Bounds {
  double lower, upper;
};
Bounds fitted_within(const dynamics::Parameter&, double low, double high);
// How many free numbers that adds.
std::size_t fitted_numbers(const dynamics::Effect&);

// Can the effect join this model? Not when it is there already, or excludes the model or an effect that is there, or is
// excluded by one.
bool goes_with(const ModelSpec&, const dynamics::Effect&);

}  // namespace freestand::measurement
