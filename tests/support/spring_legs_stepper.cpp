#include "support/spring_legs_stepper.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::test {
namespace {

constexpr double quarter_turn = 1.5707963267948966;

struct Vector {
  double x = 0, y = 0;
};

// From the centre of mass to a point of the base, `across` to the right of it; theta clockwise.
Vector to_base(double across, double height, double theta) {
  return {across * std::cos(theta) - height * std::sin(theta), -across * std::sin(theta) - height * std::cos(theta)};
}

class LegsInSteps {
 public:
  explicit LegsInSteps(const BlockOnLegs& block) : b_(block), y_(block.height_m) {
    const double circular = 4 * quarter_turn * b_.frequency_hz, base = b_.left_m + b_.right_m;
    spring_ = 0.5 * circular * circular;
    dashpot_ = b_.damping * circular;
    legs_[0] = {-b_.left_m, b_.g * b_.right_m / base, 0};
    legs_[1] = {b_.right_m, b_.g * b_.left_m / base, 0};
    y_rate_ = 0;
  }

  // False: it has fallen.
  bool step(const FloorPush& floor, double h) {
    const double x = x_ + 0.5 * h * vx_, y = y_ + 0.5 * h * vy_, theta = theta_ + 0.5 * h * turn_;
    push_legs(y, theta, vy_ + 0.5 * h * y_rate_, turn_ + 0.5 * h * turn_rate_);
    const double normal = legs_[0].push + legs_[1].push;
    double vx = vx_ - h * floor.along, vy = vy_ + h * (normal - b_.g - floor.up), turn = turn_;
    for (const Leg& leg : legs_) turn -= h * leg.push * to_base(leg.across, b_.height_m, theta).x / b_.gyration2_m2;
    const int foot = carrying();
    if (foot != foot_) {
      if (foot_ >= 0 && theta_ != 0 && stuck_ && foot >= 0) stuck_ = false;
      foot_ = foot;
      held_ = foot >= 0 ? foot_at(x_, theta_) : 0;
    }
    const double end = theta + 0.5 * h * turn_;
    if (foot_ >= 0)
      hold_foot(vx, turn, normal * h, to_base(legs_[foot_].across, b_.height_m, theta).y,
                to_base(legs_[foot_].across, b_.height_m, end).y);
    y_rate_ = (vy - vy_) / h;
    turn_rate_ = (turn - turn_) / h;
    x_ = x + 0.5 * h * vx;
    y_ = y + 0.5 * h * vy;
    theta_ = theta + 0.5 * h * turn;
    vx_ = vx, vy_ = vy, turn_ = turn;
    if (foot_ >= 0 && stuck_)
      x_ += held_ - foot_at(x_, theta_);
    else if (foot_ >= 0)
      held_ = foot_at(x_, theta_);
    return std::abs(theta_) < quarter_turn;
  }

  OnLegsAt now() const {
    const double middle = 0.5 * (b_.right_m - b_.left_m);
    return {x_ + to_base(middle, b_.height_m, theta_).x - middle, theta_, legs_[0].push, legs_[1].push};
  }

 private:
  struct Leg {
    double across, at_rest, push;
  };

  void push_legs(double y, double theta, double vy, double turn) {
    for (Leg& leg : legs_) {
      const Vector to = to_base(leg.across, b_.height_m, theta);
      const double rise = y + to.y, rate = vy - turn * to.x;
      const bool reaches = spring_ * rise < leg.at_rest;
      leg.push = reaches ? std::max(0.0, leg.at_rest - spring_ * rise - dashpot_ * rate) : 0.0;
    }
  }
  // The one under the lower edge where both push.
  int carrying() const {
    const bool left = legs_[0].push > 0, right = legs_[1].push > 0;
    if (left && right) return theta_ > 0 ? 1 : theta_ < 0 ? 0 : foot_ >= 0 ? foot_ : 1;
    return right ? 1 : left ? 0 : -1;
  }
  double foot_at(double x, double theta) const {
    return x + to_base(legs_[foot_].across, b_.height_m, theta).x - legs_[foot_].across;
  }
  // By an impulse at the foot, `push_arm` over the centre of mass (below it), which changes the foot's speed at `stop_arm`.
  void hold_foot(double& vx, double& turn, double normal, double push_arm, double stop_arm) {
    const double speed = vx + turn * stop_arm, yields = 1 + push_arm * stop_arm / b_.gyration2_m2;
    const double stops = -speed / yields;
    const double before = stuck_ ? 0 : slip_;
    double impulse = stops;
    if (stuck_ && std::abs(stops) > b_.mu_s * normal) stuck_ = false;
    if (!stuck_) {
      const double most = b_.mu_k * normal;
      impulse = std::clamp(stops, -most, most);
      const double after = speed + impulse * yields;
      // It stops where friction would turn it round, and stays where static friction can hold it.
      if (std::abs(stops) <= b_.mu_s * normal && (after == 0 || after * before < 0)) {
        stuck_ = true;
        impulse = stops;
      }
    }
    vx += impulse;
    turn += push_arm * impulse / b_.gyration2_m2;
    slip_ = vx + turn * stop_arm;
  }

  BlockOnLegs b_;
  double spring_ = 0, dashpot_ = 0;
  Leg legs_[2];
  double x_ = 0, y_, theta_ = 0, vx_ = 0, vy_ = 0, turn_ = 0, y_rate_ = 0, turn_rate_ = 0;
  int foot_ = 1;
  bool stuck_ = true;
  double held_ = 0, slip_ = 0;
};

}  // namespace

std::vector<OnLegsAt> step_on_legs(const BlockOnLegs& block, const std::function<FloorPush(double t)>& floor,
                                   double step_s, int steps, int points) {
  LegsInSteps legs(block);
  std::vector<OnLegsAt> all{legs.now()};
  for (int point = 1; point < points; ++point) {
    for (int i = 0; i < steps; ++i) {
      const double t = (static_cast<double>(point - 1) * steps + i + 0.5) * step_s;
      if (!legs.step(floor(t), step_s)) return all;
    }
    all.push_back(legs.now());
  }
  return all;
}

}  // namespace freestand::test
