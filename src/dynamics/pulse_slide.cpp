#include "dynamics/pulse_slide.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/taylor_integrator.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = max_floor_degree + 2;  // of the displacement
using Polynomial = Series<double, N>;

// What a segment of length h adds, from its coefficients c_k in the motion's own time:
//     V = sum_k speed[k] c_k,   U = sum_k place[k] c_k,   and sum_k off_chord[k] |c_k| >= h^2/8 |a'|:
// by so much the speed may leave its chord between the ends.
class SegmentIntegrals {
 public:
  explicit SegmentIntegrals(const Shaking& shaking)
      : degree_(shaking.motion->degree), scale_(shaking.scale), stretch_(shaking.stretch) {}

  struct Gain {
    double V, U, off_chord;  // [m/s], [m], [m/s]
  };
  Gain over(const double* c, double h) {
    if (!(std::abs(h - h_) <= 1e-14 * h)) set_length(h);
    Gain gain{0, 0, 0};
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree_); ++k) {
      gain.V += speed_[k] * c[k];
      gain.U += place_[k] * c[k];
      gain.off_chord += off_chord_[k] * std::abs(c[k]);
    }
    return gain;
  }

 private:
  void set_length(double h) {
    h_ = h;
    double power = scale_ * stretch_ * h;
    for (int k = 0; k <= degree_; ++k, power *= h) {
      const auto i = static_cast<std::size_t>(k);
      speed_[i] = power / (k + 1);
      place_[i] = speed_[i] * (stretch_ * h) / (k + 2);
      off_chord_[i] = 0.125 * k * std::abs(power);
    }
  }

  int degree_;
  double scale_, stretch_, h_ = 0;
  std::array<double, max_floor_degree + 1> speed_{}, place_{}, off_chord_{};
};

class PulseSlide {
 public:
  PulseSlide(const Setup& setup, const Settings& settings)
      : shaking_(setup.shaking),
        settings_(settings),
        g_(standard_gravity_mps2 * setup.floor.gravity_factor),
        holds_(setup.specimen.friction.mu_s * g_),
        brakes_(setup.specimen.friction.mu_k * g_),
        force_zero_(1e-11 * g_),
        end_s_(shaking_.duration_s() + settings.free_vibration_s),
        cursor_(shaking_, g_),
        segments_(shaking_) {}

  Response run() {
    response_.outcome = Outcome::at_rest;
    choose();
    while (!finished()) sigma_ == 0 ? wait() : slide();
    response_.residual_slip_m = u_;
    response_.end_time_s = cursor_.time();
    if (settings_.slip_by_side) {
      response_.peak_slip_right_m = most_right_;
      response_.peak_slip_left_m = -most_left_;
    }
    response_.peak_slip_m = std::fmax(most_right_, -most_left_);
    return response_;
  }

 private:
  bool finished() {
    if (!(std::abs(u_) < beyond_all_bounds && std::abs(w_) < beyond_all_bounds))
      response_.outcome = Outcome::not_finite;
    else if (resolved_ >= settings_.event_limit)
      response_.outcome = Outcome::step_limit;
    return response_.outcome > Outcome::overturned ||
           (cursor_.motion_over() && (sigma_ == 0 || cursor_.time() >= end_s_));
  }

  // What is left of static friction against a slip to the left, which a floor that accelerates to the right asks for, and to the right.
  Polynomial margin(const Polynomial& a, int sigma) const {
    Polynomial left = scaled(static_cast<double>(sigma), a);
    left[0] += holds_;
    return left;
  }

  // Which way it goes from here, at no speed.
  void choose() {
    const Polynomial a = cursor_.local<N>().a;
    const int before = sigma_;
    sigma_ = 0;
    for (const int sigma : {1, -1})
      if (sign_after(margin(a, sigma), ZeroTolerance{0, force_zero_}) < 0) sigma_ = sigma;
    ++resolved_;
    response_.events += sigma_ != before;
    if (sigma_ == 0) return;
    response_.outcome = Outcome::moved;
    response_.peak_acceleration_mps2 = std::fmax(response_.peak_acceleration_mps2, brakes_);
  }

  // To where rest ends, or the motion.
  void wait() {
    if (cursor_.at_knot()) {
      const std::size_t from = cursor_.segment();
      if (cursor_.pass_over([&](const FloorCursor::Bound& floor) { return floor.a < holds_; }))
        cursor_.look_back(
            from, [&](const auto& floor) { return floor.shaken <= response_.peak_acceleration_mps2; },
            [&](const FloorCursor& at) { feel(at.local<N>().a, at.left()); });
      if (cursor_.motion_over()) return;
    }
    const Polynomial a = cursor_.local<N>().a;
    double tau = cursor_.left(), found = 0;
    bool ends = false;
    for (const int sigma : {1, -1})
      if (first_root(margin(a, sigma), tau, ZeroTolerance{0, force_zero_}, found)) ends = true, tau = found;
    feel(a, tau);
    if (!ends) return cursor_.next_segment();
    cursor_.advance(tau);
    choose();
  }
  void feel(const Polynomial& a, double tau) {
    response_.peak_acceleration_mps2 = max_abs(a, tau, response_.peak_acceleration_mps2);
  }

  // To the end of the slip, or of a segment in which it might end.
  void slide() {
    const double from = u_, braked = sigma_ * brakes_;
    if (cursor_.at_knot() && !cursor_.motion_over()) slide_over_segments(braked);
    Polynomial w, u;
    const Polynomial a = cursor_.local<N>().a;
    w[0] = w_;
    u[0] = u_;
    for (int k = 0; k < N; ++k) {
      const double over = 1.0 / (k + 1);
      w[k + 1] = -(a[k] + (k == 0 ? braked : 0.0)) * over;
      u[k + 1] = w[k] * over;
    }
    const double left = cursor_.motion_over() ? std::fmax(end_s_ - cursor_.time(), 0.0) : cursor_.left();
    double found = 0;
    const bool stops = first_root(scaled(static_cast<double>(sigma_), w), left, ZeroTolerance{1, force_zero_}, found);
    const double tau = stops ? found : left;
    u_ = u.at(tau);
    w_ = stops ? 0.0 : w.at(tau);
    response_.slid_path_m += std::abs(u_ - from);
    most_right_ = std::fmax(most_right_, u_);
    most_left_ = std::fmin(most_left_, u_);
    if (!stops && !cursor_.motion_over()) return cursor_.next_segment();
    cursor_.advance(tau);
    if (stops) choose();
  }

  void slide_over_segments(double braked) {
    const FloorCursor::Place at = cursor_.place();
    const std::size_t stride = static_cast<std::size_t>(shaking_.motion->degree) + 1;
    std::size_t passed = 0;
    for (; passed < at.left; ++passed) {
      const double h = at.knot_at_end[passed] - at.knot_at_end[passed - 1], t = h * shaking_.stretch;
      const SegmentIntegrals::Gain gain = segments_.over(at.horizontal + passed * stride, h);
      const double w = w_ - gain.V - braked * t, u = u_ + w_ * t - gain.U - 0.5 * braked * t * t;
      if (!(sigma_ * w_ > gain.off_chord && sigma_ * w > gain.off_chord)) break;
      w_ = w;
      u_ = u;
    }
    if (passed > 0) cursor_.go_to(cursor_.segment() + passed);
  }

  const Shaking shaking_;
  const Settings settings_;
  const double g_, holds_, brakes_;  // what static and kinetic friction can do [m/s2]
  const double force_zero_;          // as in Rig
  const double end_s_;
  FloorCursor cursor_;
  SegmentIntegrals segments_;
  int sigma_ = 0;  // direction of slip; 0: at rest
  double u_ = 0, w_ = 0, most_right_ = 0, most_left_ = 0;
  int resolved_ = -1;  // events, those that changed nothing included; the first choice is none
  Response response_;
};

}  // namespace

bool slides_on_pulse(const Setup& setup, const Settings& settings) {
  const Specimen& specimen = setup.specimen;
  if (specimen.model != Model::slide || has_laws(specimen) || setup.floor.push_mps2 != 0 || specimen.neighbour)
    return false;
  const Shaking& shaking = setup.shaking;
  return admissible(setup, settings) && !follows_record(shaking) && shaking.motion->degree > 0 &&
         (shaking.vertical_scale == 0 || shaking.motion->vertical_mps2.empty()) && specimen.start.upright_at_rest() &&
         std::isnan(settings.acceleration_height_m) && !settings.contact_forces;
}

Response slide_on_pulse(const Setup& setup, const Settings& settings) { return PulseSlide(setup, settings).run(); }

}  // namespace freestand::dynamics
