// Roots inside a step of a peer.
#pragma once

namespace freestand::bench {
namespace {

// Root of f on [lo, hi] with f(lo) > 0 >= f(hi) (Dowell & Jarratt 1971).
template <class F>
double illinois(F&& f, double lo, double f_lo, double hi, double f_hi, double width) {
  int side = 0;
  for (int i = 0; i < 60 && hi - lo > width; ++i) {
    double x = hi - f_hi * (hi - lo) / (f_hi - f_lo);
    if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
    const double value = f(x);
    if (value == 0) return x;
    if (value > 0) {
      lo = x;
      f_lo = value;
      if (side == 1) f_hi *= 0.5;
      side = 1;
    } else {
      hi = x;
      f_hi = value;
      if (side == -1) f_lo *= 0.5;
      side = -1;
    }
  }
  return hi;
}

// First sign change of a witness that is positive at the start (or starts at zero) and negative at the end.
template <class F>
bool crossing(F&& f, double f_begin, double f_end, double begin, double end, double& when, double width) {
  if (f_end > 0) return false;
  double lo = begin, f_lo = f_begin;
  for (double part = 0.5; !(f_lo > 0) && part > 1e-9; part *= 0.5) {
    lo = begin + part * (end - begin);
    f_lo = f(lo);
  }
  when = f_lo > 0 ? illinois(f, lo, f_lo, end, f_end, width) : begin;
  return true;
}

}  // namespace
}  // namespace freestand::bench
