// The floor under one sample of odeint_sample.hpp, in pieces, and how long the steps on it are. `offset`: time since the start of
// the piece [s]. A floor has
//     a(t)                                         acceleration at a time since the start of the piece [m/s2]
//     left()                                       to the end of the piece [s]
//     ended()                                      the sample is over
//     step(method, rates, x, dx, next, dnext)      one step from `offset`; how long it was [s]
//     go_on(h, end)                                goes along that step; true: the rates have jumped
//     next_piece()
//     wait(quiet, peak)                            goes to where |a| reaches `quiet`; `peak` sees the |a| until then. False: it never does
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "peer_block.hpp"
#include "pulse_formula.hpp"

namespace freestand::bench {
namespace {

constexpr double watched_after_s = 60;  // after the motion

// A record, from knot to knot in equal steps.
class RecordSteps {
 public:
  RecordSteps(const Shaking& shaking, int steps_per_knot)
      : record_(shaking),
        longest_(record_.dt / steps_per_knot),
        last_(record_.count + static_cast<int>(watched_after_s / record_.dt)) {}
  double offset = 0;

  double a(double t) const { return record_.at(knot_) + record_.slope(knot_) * t; }
  double left() const { return record_.dt - offset; }
  bool ended() const { return knot_ >= last_; }

  template <class Method, class Rates, class X>
  double step(Method& method, Rates& rates, const X& x, const X& dx, X& next, X& dnext) {
    to_knot_ = left() < 1.001 * longest_;
    const double h = to_knot_ ? left() : longest_;
    method.step(rates, x, dx, offset, next, dnext, h);
    return h;
  }
  bool go_on(double, double end) {
    if (!to_knot_) return offset = end, false;
    next_piece();
    return knot_ == record_.count;
  }
  void next_piece() {
    ++knot_;
    offset = 0;
  }

  // Quiet knots are passed over.
  template <class Peak>
  bool wait(double quiet, Peak&& peak) {
    double at = std::abs(a(offset));
    for (; knot_ < record_.count; next_piece(), at = std::abs(record_.at(knot_))) {
      const double here = a(offset), end = a(record_.dt);
      peak(std::min(quiet, std::max(at, std::abs(end))));
      if (std::abs(end) <= quiet && at <= quiet) continue;
      if (at <= quiet) offset += ((end > 0 ? quiet : -quiet) - here) / record_.slope(knot_);
      return true;
    }
    return false;
  }

 private:
  PeerRecord record_;
  double longest_;
  int last_, knot_ = 0;
  bool to_knot_ = false;
};

// A pulse by its formula, and a floor that is still after it: two pieces. Steps are as long as odeint's own control of their error
// lets them be.
class PulseSteps {
 public:
  explicit PulseSteps(const Shaking& shaking) : pulse_(shaking), length_(pulse_.duration_s()), next_(0.01 * length_) {}
  double offset = 0;

  double a(double t) const { return piece_ == 0 ? pulse_.at(t) : 0.0; }
  double left() const { return length_ - offset; }
  bool ended() const { return piece_ == 2; }

  template <class Method, class Rates, class X>
  double step(Method& method, Rates& rates, const X& x, const X& dx, X& next, X& dnext) {
    double end = offset;
    for (bool done = false; !done;) {
      double h = std::min(next_, left());
      const bool cut = h < next_;
      done = method.try_step(rates, x, dx, end, next, dnext, h);
      if (!done || !cut) next_ = h;  // one that the end of the piece has cut says nothing of the next one
    }
    return end - offset;
  }
  bool go_on(double h, double end) {
    if (h < left()) return offset = end, false;
    next_piece();
    return true;
  }
  void next_piece() {
    ++piece_;
    offset = 0;
    length_ = watched_after_s;
  }

  template <class Peak>
  bool wait(double quiet, Peak&& peak) {
    if (piece_ > 0) return false;
    const double when = pulse_.reaches(quiet, offset);
    const bool ever = when < length_;
    peak(ever ? quiet : pulse_.largest_from(offset));
    offset = ever ? when : length_;
    return ever;
  }

 private:
  PulseFormula pulse_;
  int piece_ = 0;
  double length_, next_;
};

}  // namespace
}  // namespace freestand::bench
