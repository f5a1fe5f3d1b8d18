// Laws that leap against the speed. A force that falls by a leap where the block becomes faster, or friction that rises, holds the
// block at that speed: neither side of the leap lets it go on. So friction holds a block that stands, and of no other such law do the
// equations know. Nor do they of a force that leaps where a block tips, or of friction that falls there: the block that stands may have to
// tip, and once it has may have to stand. Both are asked for before the first sample, with the parameters of a formula within their ranges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dynamics/laws.hpp"
#include "study/formula_places.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using dynamics::Input;

constexpr double next_to_zero = 1e-300;  // any power of it that a law may have is next to nothing

// A law on both sides of a place: it leaps by more than round-off, for which half of the figures are left, and than what a speed next to
// zero leaves of it, some 1e-295.
struct Leap {
  double at = 0, below = 0, above = 0;
  bool rises() const { return above - below > slight(); }
  bool falls() const { return below - above > slight(); }
  double slight() const { return 1e-8 * (std::abs(above) + std::abs(below)) + 1e-100; }
};

Specimen under(const EffectPart& part, double quantile) {
  Specimen specimen{Block::rectangular(1, 1, 1), {0.3, 0.3}, {}};
  specimen.effects.push_back({part.effect.get(), {}});
  for (const Quantity& q : part.parameters)
    specimen.effects.back().parameters.push_back(sampling::quantile(q.value, quantile));
  return specimen;
}

class LawAlong {
 public:
  LawAlong(const EffectPart& part, double quantile) : laws_(under(part, quantile)) {}

  // `which`: v, omega, or theta, in which a block tips.
  void stand(const Place& at, Coordinate which) { place_ = at, which_ = which; }
  double force(double x) { return laws_.force < 0 ? 0 : evaluated(x)[laws_.force][0]; }
  double friction(double x) { return laws_.friction < 0 ? 0 : evaluated(x)[laws_.friction][0]; }
  double friction_at_rest(int slip_to_come) {
    place_[sigma] = slip_to_come;
    return friction(0);
  }
  int kinks() const { return laws_.tape.kink_count(); }
  double argument(int kink, double x) { return evaluated(x)[laws_.tape.kink_argument(kink)][0]; }
  bool follows_speed(int kink) const {
    const auto looks = [&](Input input) { return laws_.tape.depends(laws_.tape.kink_argument(kink), input); };
    return which_ == omega ? looks(Input::omega) : looks(Input::v) || looks(Input::speed);
  }

 private:
  const dynamics::Series<double, 0>* evaluated(double x) {
    Place at = place_;
    at[which_] = x;
    at[path] = std::max(at[path], std::abs(at[u]));
    at[speed] = std::abs(at[v]);
    if (at[v] != 0) at[sigma] = at[v] < 0 ? -1 : 1, at[rest] = 0;
    if (which_ == theta && x != 0) at[omega] = x, at[side] = x < 0 ? -1 : 1;
    for (auto& value : values_) value[0] = 0;
    for (std::size_t i = 0; i < at.size(); ++i) values_[i][0] = at[i];
    laws_.sides_at(values_, 0);
    return values_;
  }

  dynamics::Laws laws_;
  Place place_{};
  Coordinate which_ = v;
  dynamics::Series<double, 0> values_[dynamics::max_nodes];
};

// Speeds between which a kink's argument may change its sign [m/s, rad/s].
const std::vector<double>& speeds() {
  static const std::vector<double> all = [] {
    std::vector<double> rising{next_to_zero};
    for (double x = 1e-6; x < 20; x *= 1.3) rising.push_back(x);
    std::vector<double> both;
    for (auto it = rising.rbegin(); it != rising.rend(); ++it) both.push_back(-*it);
    both.insert(both.end(), rising.begin(), rising.end());
    return both;
  }();
  return all;
}

// The law on either side of the sign's change between low and high.
template <class Argument, class Law>
Leap leap_between(double low, double high, Argument&& argument, Law&& law) {
  const bool positive = argument(low) > 0;  // a step is 1 there alone
  for (int halvings = 0; halvings < 80; ++halvings) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) break;
    ((argument(middle) > 0) == positive ? low : high) = middle;
  }
  return {high, law(low), law(high)};
}

std::string said_of_force(const std::string& name, const Leap& leap, Coordinate which) {
  const std::string where = which == omega   ? fmt::format("omega = {:.3g} rad/s", leap.at)
                            : leap.at == 0.0 ? "the block stops and turns round"
                                             : fmt::format("v = {:.3g} m/s", leap.at);
  if (leap.at == 0 && which == v && leap.falls())
    return fmt::format(
        "force of effect {} leaps from {:.4g} to {:.4g} m/s2 where {} (there only friction may, which can hold it): "
        "write "
        "it as friction: \"mu + {:.4g}/(g*normal)\"",
        name, leap.below, leap.above, where, (leap.below - leap.above) / 2);
  return fmt::format(
      "force of effect {} leaps from {:.4g} to {:.4g} m/s2 where {} ({}): let it pass there without a leap", name,
      leap.below, leap.above, where,
      leap.falls() ? "it would hold the block at that speed" : "no way to go is left to a block that stands");
}
std::string said_of_friction(const std::string& name, const Leap& leap) {
  return fmt::format(
      "friction of effect {} leaps from {:.4g} to {:.4g} times mu where the slip becomes faster than {:.3g} m/s (it "
      "would hold "
      "the slip at that speed): let it rise over a range of speeds",
      name, leap.below, leap.above, std::abs(leap.at));
}

std::string said_of(LawAlong& law, const std::string& name, Coordinate which) {
  const auto force = [&](double x) { return law.force(x); };
  const auto friction = [&](double x) { return law.friction(x); };
  const Leap at_zero{0, force(-next_to_zero), force(next_to_zero)};
  if (at_zero.falls() || at_zero.rises()) return said_of_force(name, at_zero, which);
  if (which == v)
    for (const int way : {-1, 1})
      if (const Leap start{0, law.friction_at_rest(way), friction(way * next_to_zero)}; start.rises())
        return said_of_friction(name, start);
  for (int kink = 0; kink < law.kinks(); ++kink) {
    if (!law.follows_speed(kink)) continue;
    const auto argument = [&](double x) { return law.argument(kink, x); };
    for (std::size_t i = 1; i < speeds().size(); ++i) {
      const double low = speeds()[i - 1], high = speeds()[i];
      if (low < 0 && high > 0) continue;  // zero itself
      if ((argument(low) > 0) == (argument(high) > 0)) continue;
      if (const Leap leap = leap_between(low, high, argument, force); leap.falls())
        return said_of_force(name, leap, which);
      if (which == omega) continue;
      const Leap leap = leap_between(low, high, argument, friction);
      if (low > 0 ? leap.rises() : leap.falls())
        return said_of_friction(name, low > 0 ? leap : Leap{leap.at, leap.above, leap.below});
    }
  }
  return "";
}

// Of a block that stands where the law is now.
std::string said_of_tipping(LawAlong& law, const std::string& name) {
  for (const int way : {1, -1}) {
    if (const Leap leap{0, law.force(0), law.force(way * next_to_zero)}; leap.falls() || leap.rises())
      return fmt::format(
          "force of effect {} leaps from {:.4g} to {:.4g} m/s2 where the block tips (it could then neither stand nor "
          "tip): "
          "let it grow with theta, as min(abs(theta)/0.001, 1) does",
          name, leap.below, leap.above);
    if (const Leap leap{0, law.friction(0), law.friction(way * next_to_zero)}; leap.falls())
      return fmt::format(
          "friction of effect {} leaps from {:.4g} to {:.4g} times mu where the block tips (it could then neither "
          "stand "
          "nor tip): let it fall over a range of theta, as min(abs(theta)/0.001, 1) grows over one",
          name, leap.below, leap.above);
  }
  return "";
}

}  // namespace

std::string leap_that_holds(const EffectPart& part) {
  for (const double quantile : {0.5, 0.05, 0.95, 0.3}) {
    LawAlong law(part, quantile);
    for (const Place& at : places())
      for (const Coordinate which : {v, omega}) {
        if (at[v] != 0 && which == v) continue;  // gone through anyway
        law.stand(at, which);
        if (std::string said = said_of(law, part.name, which); !said.empty()) return said;
      }
    for (const Place& at : places()) {
      if (at[theta] != 0) continue;
      law.stand(at, theta);
      if (std::string said = said_of_tipping(law, part.name); !said.empty()) return said;
    }
  }
  return "";
}

}  // namespace freestand::study
