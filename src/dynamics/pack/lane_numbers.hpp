// The numbers of the tapes of samples in a pack, and the functions that their laws may use.
#pragma once

#include "base/pack.hpp"
#include "dynamics/law_rows.hpp"
#include "dynamics/pack/outside.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class LaneNumbers {
 public:
  explicit LaneNumbers(const LawRows& rows) : rows_(rows) {}
  Pack value(int node) const { return load(rows_.value[node]); }
  Pack shift(int node) const { return load(rows_.shift[node]); }
  Pack on_side(int kink, const Pack& positive, const Pack& negative) const {
    return freestand::choose(load(rows_.side[kink]) > Pack(0.0), positive, negative);
  }
  // Zero where the kink was met at this instant.
  Pack unless_met(int kink, const Pack& x) const {
    return freestand::choose(load(rows_.met[kink]) > Pack(0.0), Pack(0.0), x);
  }
  static Pack choose(const PackMask& mask, const Pack& yes, const Pack& no) { return freestand::choose(mask, yes, no); }
  static bool any(const PackMask& mask) { return bits(mask); }
  static Pack exp(const Pack& x) { return each(x, exp_outside); }
  static Pack log(const Pack& x) { return each(x, log_outside); }
  static Pack sqrt(const Pack& x) { return xsimd::sqrt(x); }
  static Pack sin(const Pack& x) { return each(x, sin_outside); }
  static Pack cos(const Pack& x) { return each(x, cos_outside); }
  static Pack pow(const Pack& x, const Pack& exponent) {
    alignas(64) double at[pack_lanes], to[pack_lanes];
    store(at, x);
    store(to, exponent);
    for (int l = 0; l < pack_lanes; ++l) at[l] = pow_outside(at[l], to[l]);
    return load(at);
  }

 private:
  static Pack each(const Pack& x, double (*function)(double)) {
    alignas(64) double at[pack_lanes];
    store(at, x);
    for (double& one : at) one = function(one);
    return load(at);
  }

  const LawRows& rows_;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
