// Calls from the kernels to code that is compiled for any machine, the C library's among it. Such code waits long where
// the upper parts of the registers of packs are in use, and the compiler forgets to clear them before some calls.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "dynamics/slip_law.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

inline double exp_outside(double x) {
  clear_upper_parts();
  return std::exp(x);
}
inline double log_outside(double x) {
  clear_upper_parts();
  return std::log(x);
}
inline double pow_outside(double x, double y) {
  clear_upper_parts();
  return std::pow(x, y);
}
inline double sin_outside(double x) {
  clear_upper_parts();
  return std::sin(x);
}
inline double cos_outside(double x) {
  clear_upper_parts();
  return std::cos(x);
}
inline double friction_factor_outside(const SlipLaw& law, const Slip& slip) {
  clear_upper_parts();
  return friction_factor(law, slip);
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
