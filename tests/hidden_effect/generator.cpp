#include "hidden_effect/generator.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "support/bouc_wen_stepper.hpp"
#include "support/moreau_stepper.hpp"

namespace freestand::test {
namespace {

struct Rules {
  ContactBody body;
  ContactLaws laws;
  double left_of_base = 1;  // share of the base that is not lost at the corners
};
using Values = std::vector<double>;

struct Law {
  std::string name;
  std::vector<std::string> keys;
  std::vector<double> defaults;  // of the last keys
  std::function<void(Rules&, const Values&)> act;
};

double squared(double x) { return x * x; }
double circular(double frequency_hz) { return 2 * pi * frequency_hz; }

const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      {"static_friction", {"ratio"}, {}, [](Rules& r, const Values& p) { r.laws.mu_s = p[0] * r.laws.mu_k; }},
      {"rate_weakening",
       {"drop", "speed_mps"},
       {},
       [](Rules& r, const Values& p) {
         r.laws.rates.push_back({-p[0], p[1]});
       }},
      {"rate_strengthening",
       {"rise", "speed_mps"},
       {},
       [](Rules& r, const Values& p) {
         r.laws.rates.push_back({p[0], p[1]});
       }},
      {"friction_wear",
       {"ratio", "path_m"},
       {},
       [](Rules& r, const Values& p) { r.laws.wear_ratio = p[0], r.laws.wear_path_m = p[1]; }},
      {"directional_friction", {"asymmetry"}, {}, [](Rules& r, const Values& p) { r.laws.asymmetry = p[0]; }},
      {"pressure_friction", {"exponent"}, {}, [](Rules& r, const Values& p) { r.laws.pressure_exponent = p[0]; }},
      {"viscous_drag", {"rate_per_s"}, {}, [](Rules& r, const Values& p) { r.laws.drag_per_s = p[0]; }},
      {"floor_tilt",
       {"angle_rad"},
       {},
       [](Rules& r, const Values& p) {
         r.laws.push_mps2 = standard_gravity_mps2 * std::sin(p[0]);
         r.laws.gravity_mps2 = standard_gravity_mps2 * std::cos(p[0]);
       }},
      {"vertical_shaking", {"scale"}, {1}, [](Rules& r, const Values& p) { r.laws.vertical_scale = p[0]; }},
      {"flexible_legs",
       {"frequency_hz", "damping"},
       {0.02},
       [](Rules& r, const Values& p) { r.laws.legs_radps = circular(p[0]), r.laws.legs_damping = p[1]; }},
      {"slack_tether",
       {"slack_m", "frequency_hz", "rate_per_s"},
       {0},
       [](Rules& r, const Values& p) {
         r.laws.tethers.push_back({p[0], squared(circular(p[1])), p[2]});
       }},
      {"centering_spring",
       {"frequency_hz"},
       {},
       [](Rules& r, const Values& p) { r.laws.spring_per_s2 = squared(circular(p[0])); }},
      {"wall_impact",
       {"gap_m", "restitution", "side", "other_gap_m"},
       {0, 0, -1},
       [](Rules& r, const Values& p) {
         const auto stand = [&](bool right, double gap_m) {
           auto& wall = r.laws.walls[right ? 1 : 0];
           if (!wall || gap_m < wall->gap_m) wall = {gap_m, p[1]};
         };
         const bool right = p[2] == 0 ? p[0] >= 0 : p[2] > 0;
         stand(right, std::abs(p[0]));
         if (p[3] >= 0) stand(!right, p[3]);
       }},
      {"moving_contents",
       {"mass_ratio", "frequency_hz", "damping"},
       {0.02},
       [](Rules& r, const Values& p) {
         r.laws.contents_ratio = p[0], r.laws.contents_radps = circular(p[1]), r.laws.contents_damping = p[2];
       }},
      {"impact_loss", {"factor"}, {}, [](Rules& r, const Values& p) { r.body.impact_factor *= p[0]; }},
      {"reduced_base",
       {"ratio"},
       {},
       [](Rules& r, const Values& p) {
         r.body.left_m *= 1 - p[0], r.body.right_m *= 1 - p[0], r.left_of_base *= 1 - p[0];
       }},
      {"offset_mass",
       {"eccentricity"},
       {},
       [](Rules& r, const Values& p) { r.body.left_m *= 1 + p[0], r.body.right_m *= 1 - p[0]; }},
      // Of no catalogue.
      {"rough_floor",
       {"ratio", "length_m"},
       {},
       [](Rules& r, const Values& p) { r.laws.roughness = p[0], r.laws.roughness_length_m = p[1]; }},
      {"friction_heating",
       {"rise", "time_s"},
       {},
       [](Rules& r, const Values& p) { r.laws.heating = p[0], r.laws.heating_time_s = p[1]; }},
      {"quadratic_drag", {"per_m"}, {}, [](Rules& r, const Values& p) { r.laws.quadratic_drag_per_m = p[0]; }},
      {"stick_ageing",
       {"rise", "time_s"},
       {},
       [](Rules& r, const Values& p) { r.laws.ageing = p[0], r.laws.ageing_time_s = p[1]; }},
      {"chain",
       {"side", "height_m", "slack_m", "stiffness_per_s2", "strength_mps2", "elevation_rad"},
       {0},
       [](Rules& r, const Values& p) {
         const double left = r.body.left_m / r.left_of_base, right = r.body.right_m / r.left_of_base;
         r.laws.chain = {
             static_cast<int>(p[0]), p[0] > 0 ? -left : right, p[1] - r.body.height_m, p[2], p[3], p[4], p[5]};
       }},
  };
  return all;
}
constexpr std::size_t in_catalogue = 17, outside = 4;

Values values_of(const Law& law, const TruthEffect& effect) {
  for (const auto& [key, value] : effect.parameters)
    if (std::find(law.keys.begin(), law.keys.end(), key) == law.keys.end())
      throw std::invalid_argument(law.name + " has no parameter " + key);
  Values values;
  const std::size_t needed = law.keys.size() - law.defaults.size();
  for (std::size_t i = 0; i < law.keys.size(); ++i) {
    const auto given = effect.parameters.find(law.keys[i]);
    if (given == effect.parameters.end() && i < needed)
      throw std::invalid_argument(law.name + " needs its parameter " + law.keys[i]);
    values.push_back(given == effect.parameters.end() ? law.defaults[i - needed] : given->second);
  }
  return values;
}

Rules rules_of(const Truth& truth) {
  Rules rules;
  rules.body = {truth.left_m, truth.right_m, truth.height_m, truth.gyration2_m2};
  rules.body.can_slip = truth.model != TruthModel::rock;
  rules.body.can_tip = truth.model != TruthModel::slide;
  rules.body.housner = truth.impact == TruthImpact::housner;
  rules.body.impact_factor = truth.impact_factor;
  rules.laws.mu_s = truth.mu_s;
  rules.laws.mu_k = truth.mu_k;
  for (const TruthEffect& effect : truth.effects) {
    const auto law = std::find_if(laws().begin(), laws().end(), [&](const Law& l) { return l.name == effect.name; });
    if (law == laws().end()) throw std::invalid_argument("no effect is called " + effect.name);
    if (law->name != "chain") law->act(rules, values_of(*law, effect));
  }
  // A chain hangs on the block as the other effects leave it.
  for (const TruthEffect& effect : truth.effects)
    if (effect.name == "chain") laws().back().act(rules, values_of(laws().back(), effect));
  return rules;
}

std::vector<std::string> names(std::size_t from, std::size_t to) {
  std::vector<std::string> result;
  for (std::size_t i = from; i < to; ++i) result.push_back(laws()[i].name);
  return result;
}

FloorLine line_of(const FloorSamples& floor, std::size_t i) {
  const auto& a = floor.horizontal_mps2;
  const auto& v = floor.vertical_mps2;
  FloorLine line{static_cast<double>(i) * floor.dt_s, a[i], 0, (a[i + 1] - a[i]) / floor.dt_s, 0};
  if (!v.empty()) line.v = v[i], line.v_rate = (v[i + 1] - v[i]) / floor.dt_s;
  return line;
}

TruthHistory on_bouc_wen(const Rules& rules, const TruthContact& contact, const FloorSamples& floor, double step_s) {
  constexpr double usual_step_s = 1e-4, usual_tolerance = 1e-10, least_tolerance = 3e-14;
  const double tolerance = std::max(least_tolerance, usual_tolerance * squared(step_s / usual_step_s));
  BoucWenStepper stepper({contact.yield_m, contact.exponent, contact.gamma, contact.beta}, rules.laws, step_s,
                         tolerance);
  TruthHistory history;
  history.dt_s = floor.dt_s;
  history.outcome = "at_rest";
  const auto note = [&] {
    const bool slides = stepper.share_plastic() > 0.75;
    if (slides) history.outcome = "moved";
    history.deeds.push_back((slides ? slid : 0U) | (stepper.chain_broken() ? broke_the_chain : 0U));
    history.slip_m.push_back(stepper.slip());
    history.rotation_rad.push_back(0);
    history.block_acceleration_mps2.push_back(stepper.acceleration());
    history.remaining_m.push_back(stepper.remaining());
    history.path_m.push_back(stepper.path());
    history.peak_slip_m = std::max(history.peak_slip_m, stepper.furthest());
    history.peak_acceleration_mps2 = std::max(history.peak_acceleration_mps2, stepper.felt());
  };
  note();
  for (std::size_t i = 0; i + 1 < floor.horizontal_mps2.size(); ++i) {
    if (!stepper.go_to(static_cast<double>(i + 1) * floor.dt_s, line_of(floor, i))) {
      history.outcome = "not_finite";
      return history;
    }
    note();
  }
  history.residual_slip_m = stepper.slip();
  history.slid_path_m = stepper.path();
  for (const BoucWenStepper::Turn& turn : stepper.turns()) {
    history.turns_s.push_back(turn.time_s);
    history.turns_m.push_back(turn.slip_m);
  }
  return history;
}

class Run {
 public:
  Run(const Rules& rules, const FloorSamples& floor, double step_s)
      : stepper_(rules.body, rules.laws), floor_(floor), splits_(std::ceil(floor.dt_s / step_s - 1e-9)) {}

  TruthHistory operator()() {
    history_.dt_s = floor_.dt_s;
    history_.outcome = "at_rest";
    std::size_t i = 0;
    note();
    while (i + 1 < floor_.horizontal_mps2.size() && interval(i)) ++i, note();
    while (history_.slip_m.size() < floor_.horizontal_mps2.size()) note();
    history_.residual_slip_m = stepper_.slip();
    history_.slid_path_m = stepper_.path();
    return history_;
  }

 private:
  // False: the run is over.
  bool interval(std::size_t i) {
    const double dt = floor_.dt_s, t = static_cast<double>(i) * dt;
    const FloorLine line = line_of(floor_, i);
    deeds_ = 0;
    if (stepper_.rest(line, t, dt)) return feel();
    for (double k = 0; k < splits_; ++k) {
      if (!stepper_.step(line, t + k * dt / splits_, dt / splits_)) return over("painleve");
      deeds_ |= deed();
      feel();
      history_.peak_slip_m = std::max(history_.peak_slip_m, std::abs(stepper_.slip()));
      history_.peak_rotation_rad = std::max(history_.peak_rotation_rad, std::abs(stepper_.rotation()));
      if (std::abs(stepper_.rotation()) > pi / 2) return over("overturned");
    }
    if (stepper_.slips() || stepper_.path() > 0 || stepper_.rotation() != 0 || stepper_.flies())
      history_.outcome = "moved";
    return true;
  }
  bool feel() {
    history_.peak_acceleration_mps2 = std::max(history_.peak_acceleration_mps2, stepper_.felt());
    return true;
  }
  bool over(const char* outcome) {
    history_.outcome = outcome;
    return false;
  }
  unsigned deed() const {
    const MoreauStepper::Strikes strikes = stepper_.strikes();
    const unsigned blows = (stepper_.landed_nearly_flat() ? landed_nearly_flat : 0U) |
                           (strikes.face ? struck_by_face : 0U) | (strikes.lower ? struck_by_lower_edge : 0U) |
                           (strikes.upper ? struck_by_upper_edge : 0U) | (strikes.in_flight ? struck_in_flight : 0U) |
                           (stepper_.chain_broken() ? broke_the_chain : 0U);
    if (stepper_.flies()) return blows | flew;
    if (stepper_.closed(left) && stepper_.closed(right)) return blows | (stepper_.slips() ? slid : 0U);
    return blows | (stepper_.slips() ? slide_rocked : rocked) | (stepper_.at_wall() ? leaned : 0U);
  }
  void note() {
    history_.deeds.push_back(deeds_);
    history_.slip_m.push_back(stepper_.slip());
    history_.rotation_rad.push_back(stepper_.rotation());
    history_.block_acceleration_mps2.push_back(stepper_.acceleration());
  }

  MoreauStepper stepper_;
  const FloorSamples& floor_;
  double splits_;
  unsigned deeds_ = 0;
  TruthHistory history_;
};

}  // namespace

Truth rectangular_truth(double width_m, double height_m, double mu, std::vector<TruthEffect> effects) {
  Truth truth;
  truth.left_m = truth.right_m = 0.5 * width_m;
  truth.height_m = 0.5 * height_m;
  truth.gyration2_m2 = (squared(width_m) + squared(height_m)) / 12;
  truth.mu_s = truth.mu_k = mu;
  truth.effects = std::move(effects);
  return truth;
}

TruthHistory simulate(const Truth& truth, const FloorSamples& floor, double step_s) {
  if (truth.model == TruthModel::bouc_wen) return on_bouc_wen(rules_of(truth), truth.contact, floor, step_s);
  return Run(rules_of(truth), floor, step_s)();
}

const std::vector<std::string>& catalogue_effects() {
  static const std::vector<std::string> result = names(0, in_catalogue);
  return result;
}

const std::vector<std::string>& outside_effects() {
  static const std::vector<std::string> result = names(in_catalogue, in_catalogue + outside);
  return result;
}

}  // namespace freestand::test
