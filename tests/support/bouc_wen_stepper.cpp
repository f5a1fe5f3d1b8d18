#include "support/bouc_wen_stepper.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::test {
namespace {

// Dormand & Prince (1980), Table 2: where a stage looks, what it weighs, and the weights of the step less those of order 4.
constexpr int stages = 7;
constexpr double at[stages] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
constexpr double weights[stages][stages - 1] = {{},
                                                {1. / 5},
                                                {3. / 40, 9. / 40},
                                                {44. / 45, -56. / 15, 32. / 9},
                                                {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                                {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                                {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
constexpr double error_weights[stages] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                          -17253. / 339200, 22. / 525, -1. / 40};

}  // namespace

BoucWenStepper::BoucWenStepper(const BoucWenRule& rule, const ContactLaws& laws, double longest_step_s,
                               double tolerance)
    : rule_(rule), laws_(laws), longest_step_s_(longest_step_s), tolerance_(tolerance), step_(1e-6 * longest_step_s) {
  const double ringing = std::sqrt(std::max(laws.mu_k, 1e-3) * standard_gravity_mps2 / rule.yield_m);
  scale_.fill(rule.yield_m);
  scale_[z] = 1;
  scale_[v] = scale_[contents_v] = rule.yield_m * ringing;
}

double BoucWenStepper::plastic(const State& y) const {
  const bool loads = y[v] * y[z] > 0;
  const double share = (rule_.beta + (loads ? rule_.gamma : -rule_.gamma)) * std::pow(std::abs(y[z]), rule_.exponent);
  constexpr double round_off = 1e-13;
  return loads && std::abs(1 - share) < round_off ? 1 : share;
}

BoucWenStepper::State BoucWenStepper::rates(double t, const State& y, const FloorLine& floor) const {
  const double press = std::max(0.0, laws_.gravity_mps2 + laws_.vertical_scale * floor.vertical(t));
  ContactLaws::Place place;
  place.u_m = y[u];
  place.path_m = y[path_of_slip];
  place.normal_g = press / standard_gravity_mps2;
  place.time_s = t;
  const double friction = laws_.sliding(place, std::abs(y[v]), (y[z] > 0) - (y[z] < 0)) * press * y[z];
  double force = laws_.force(y[u], y[v]);
  if (laws_.chain && !chain_broken_) force -= laws_.chain->side * laws_.chain->pull(y[u], 0);
  const double W = laws_.contents_radps;
  const double hanging = W * W * y[contents] + 2 * laws_.contents_damping * W * y[contents_v];
  force += laws_.contents_ratio * hanging;
  const double all = (force - friction) / laws_.carried();  // u'' + a, the push of a slope in a
  State rate;
  rate[u] = y[v];
  rate[v] = all - floor.horizontal(t) - laws_.push_mps2;
  rate[z] = y[v] * (1 - plastic(y)) / rule_.yield_m;
  rate[path_of_slip] = std::abs(y[v] - rule_.yield_m * rate[z]);
  rate[contents] = y[contents_v];
  rate[contents_v] = laws_.contents_ratio == 0 ? 0 : -all - hanging;
  return rate;
}

void BoucWenStepper::note(double t, const FloorLine& floor) {
  acceleration_ = rates(t, y_, floor)[v] + floor.horizontal(t);
  const double press = std::max(0.0, laws_.gravity_mps2 + laws_.vertical_scale * floor.vertical(t));
  felt_ = std::max(felt_, std::hypot(acceleration_, press - laws_.gravity_mps2));
  furthest_ = std::max(furthest_, std::abs(y_[u]));
  if (y_[v] * y_[z] > 0) share_plastic_ = std::max(share_plastic_, plastic(y_));
}

bool BoucWenStepper::go_to(double end, const FloorLine& floor) {
  constexpr double shortest = 1e-15, instant = 1e-9;  // [s]
  felt_ = furthest_ = share_plastic_ = 0;
  note(time_, floor);
  while (time_ < end) {
    double dt = std::min({step_, longest_step_s_, end - time_});
    const bool last = dt == end - time_;
    State k[stages], after;
    for (int i = 0; i < stages; ++i) {
      after = y_;
      for (int j = 0; j < i; ++j)
        for (std::size_t n = 0; n < size; ++n) after[n] += dt * weights[i][j] * k[j][n];
      k[i] = rates(time_ + at[i] * dt, after, floor);
    }
    double error = 0;
    for (std::size_t n = 0; n < size; ++n) {
      double difference = 0;
      for (int i = 0; i < stages; ++i) difference += dt * error_weights[i] * k[i][n];
      error = std::max(error, std::abs(difference) / (tolerance_ * (scale_[n] + std::abs(after[n]))));
    }
    if (!std::isfinite(error)) return false;
    const double before = step_;
    step_ = dt * std::clamp(0.9 * std::pow(std::max(error, 1e-10), -0.2), 0.2, 5.0);
    if (error > 1 && dt > shortest) continue;
    if (last) step_ = std::max(step_, before);
    if (laws_.chain && !chain_broken_ && laws_.chain->pull(after[u], 0) > laws_.chain->strength_mps2) {
      if (dt > instant) {
        step_ = 0.3 * dt;
        continue;
      }
      chain_broken_ = true;
    }
    if (y_[v] * after[v] < 0) turns_.push_back({time_ + dt, after[u]});
    y_ = after;
    time_ = last ? end : time_ + dt;
    note(time_, floor);
  }
  return true;
}

}  // namespace freestand::test
