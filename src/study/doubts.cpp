#include "study/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.hpp"
#include "formula/formula.hpp"
#include "intensity/intensity.hpp"
#include "motion/offset.hpp"
#include "motion/peaks.hpp"
#include "motion/summary.hpp"
#include "parallel/progress.hpp"
#include "study/formula_places.hpp"
#include "study/problems.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

constexpr double longest_m = 10, steepest_rad = 1.2, roughest = 2, longest_period_s = 20, strongest_g = 10,
                 fastest_mps = 10;
// Of two thirds of the values, which no dimension or coefficient does: a lognormal's from a dispersion of 2.3 on.
constexpr double widest_factor = 100;
// The strongest floors that were recorded reach some g, and records are used from some hundredths of g on.
constexpr double strongest_scaling = 100;

double usual(const Quantity& quantity) { return sampling::quantile(quantity.value, 0.5); }

class Doubter {
 public:
  void ask(const std::optional<Quantity>& quantity, double largest, const char* question) {
    if (!quantity) return;
    const double value = usual(*quantity);
    if (std::abs(value) > largest) said.push_back(fmt::format("{} is {:.4g}: {}", quantity->name, value, question));
  }
  void ask_spread(const std::optional<Quantity>& quantity) {
    if (!quantity) return;
    const auto* lognormal = std::get_if<sampling::Lognormal>(&quantity->value);
    if (!lognormal && !std::holds_alternative<sampling::LogUniform>(quantity->value)) return;
    const double factor = quantile(quantity->value, 5.0 / 6) / quantile(quantity->value, 1.0 / 6);
    if (!(factor > widest_factor)) return;
    said.push_back(
        lognormal ? fmt::format("{} has the dispersion {:.4g}, with which two thirds of its values span a factor of "
                                "{:.2g}: is it the standard deviation of the natural logarithm?",
                                quantity->name, lognormal->dispersion, factor)
                  : fmt::format("two thirds of the values of {} span a factor of {:.2g}: are its ends right?",
                                quantity->name, factor));
  }
  std::vector<std::string> said;
};

// A formula with the usual numbers of its parameters.
class UsualLaw {
 public:
  UsualLaw(const std::string& text, const EffectPart& part, double mu) : mu_(mu), law_(text, names(part)) {
    for (const Quantity& q : part.parameters) numbers_.push_back(usual(q));
  }
  double operator()(const Place& at) const { return law_.value(at, mu_, numbers_); }

 private:
  static std::vector<std::string> names(const EffectPart& part) {
    std::vector<std::string> names;
    for (const Quantity& q : part.parameters) names.push_back(q.name.substr(q.name.rfind('.') + 1));
    return names;
  }

  double mu_;
  formula::Formula law_;
  std::vector<double> numbers_;
};

// A formula of friction that falls below zero, at the usual numbers: where, with no more coordinates than it takes.
void ask_of_friction(const EffectPart& part, double mu, Doubter& doubter) {
  if (part.friction.empty()) return;
  const UsualLaw law(part.friction, part, mu);
  const auto friction = [&](Place at) {
    at[path] = std::max(at[path], std::abs(at[u]));
    at[speed] = std::abs(at[v]);
    at[sigma] = at[v] < 0 ? -1 : 1;
    return law(at);
  };
  const std::vector<Place> all = places();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Place& at) { return friction(at) < 0; });
  if (found == all.end()) return;
  Place at = *found;
  std::string where;
  for (const auto& [which, text] :
       {std::pair{u, "u = {} m"}, std::pair{v, "v = {} m/s"}, std::pair{theta, "theta = {} rad"},
        std::pair{t, "t = {} s"}, std::pair{path, "path = {} m"}}) {
    const double value = std::exchange(at[which], 0);
    if (value == 0 || friction(at) < 0) continue;
    at[which] = value;
    where += (where.empty() ? " at " : ", ") + fmt::format(fmt::runtime(text), value);
  }
  doubter.said.push_back(
      fmt::format("friction of effect {} is {:.3g}{}, and pushes the block on there: is it ever "
                  "there? max(0, ...) keeps it from that",
                  part.name, friction(at), where));
}

// moves: the block is on its way already.
void ask_of_source(const MotionSource& source, bool shaken, bool moves, Doubter& doubter) {
  doubter.ask(source.period, longest_period_s, "is it in seconds?");
  for (const auto& quantity : {source.amplitude, source.period}) doubter.ask_spread(quantity);
  if (!source.vertical_records.empty() && !shaken)
    doubter.said.push_back(fmt::format(
        "vertical_records of {} are read, but nothing lets them act: add the effect vertical_shaking", source.records));
  if (!source.left_out.empty())
    doubter.said.push_back(
        fmt::format("vertical components that {} matches are left out: {}", source.records, joined(source.left_out)));
  if (!source.no_records.empty())
    doubter.said.push_back(
        fmt::format("what is no record in {} is left out: {}", source.records, some(source.no_records, 20)));
  if (!source.ungrouped.empty())
    doubter.said.push_back(fmt::format(
        "{} has a column {} and none named group: its records are taken as independent of each other, which "
        "those of one earthquake are not: is group: {} meant?",
        source.records, joined(source.ungrouped), source.ungrouped.front()));
  if (!source.amplitude) return;
  const sampling::Support amplitudes = support(source.amplitude->value);
  if (amplitudes.lower == 0 && amplitudes.upper == 0 && !moves)
    doubter.said.push_back(fmt::format("{} is 0: nothing will shake", source.amplitude->name));
  const bool spectral = source.scale_to && source.scale_to->period_s;  // may be larger than any peak
  if (source.amplitude->unit == "g" && !spectral) doubter.ask(source.amplitude, strongest_g, "is it in g?");
  const bool sum = source.scale_to && source.scale_to->name == "cav_mps";  // of minutes of shaking
  if (source.amplitude->unit == "m/s" && !sum) doubter.ask(source.amplitude, fastest_mps, "is it in m/s?");
}

// Does wall_impact stand on the same side in all samples, with none on the other?
bool wall_on_one_side(const EffectPart& wall) {
  const NearestWalls walls = nearest_walls(wall);
  return walls.right.has_value() != walls.left.has_value();
}

// What stands on one side only; "" of nothing.
std::string one_sided(const Study& study) {
  if (study.model.chain) return "chain";
  if (study.model.neighbour) return "neighbour";
  for (const EffectPart& effect : study.model.effects)
    if (effect.name == "wall_impact" && wall_on_one_side(effect)) return "wall of wall_impact";
  for (const std::string& edp : study.fragility.edp)
    if (edp == "peak_slip_right_m" || edp == "peak_slip_left_m") return "demand " + edp;
  return "";
}

// A record that is turned round is as likely a motion of the floor, and does something else to what stands on one side.
void ask_of_polarity(const MotionSource& source, const std::string& what, bool one_sample, Doubter& doubter) {
  const bool one_sign = source.kind == MotionSource::Kind::records || (source.synthetic && source.synthetic->pulse);
  if (what.empty() || !one_sign || !source.amplitude) return;
  const sampling::Support amplitudes = support(source.amplitude->value);
  if (amplitudes.lower < 0 && amplitudes.upper > 0) return;
  const std::string key = source.scale_to ? "scale_to: {" + source.scale_to->name + ": " : "scale: ";
  const std::string value = one_sample        ? sampling::number_text(-usual(*source.amplitude))
                            : source.scale_to ? "{uniform: [-2, 2]}"
                                              : "{choice: [-1, 1]}";
  doubter.said.push_back(fmt::format(
      "the {} is on one side, and {} shakes with one sign only: turned round each record is as likely: is that "
      "meant? {} ({})",
      what, source.synthetic ? source.synthetic->name : source.records,
      one_sample ? "a negative number turns it round: simulate that too" : "a range of both signs turns them round too",
      key + value + (source.scale_to ? "}" : "")));
}

// Legs turn a block back by m W^2 b^2 theta, W = 2 pi f, and its weight tips it by m g h theta; of the usual block, and the softest legs
// but for one in a hundred.
void ask_of_legs(const ModelPart& model, Doubter& doubter) {
  if (!model.legs) return;
  const BlockPart& block = model.block;
  const double angle = block.slenderness ? usual(*block.slenderness) : 0, size = block.size ? usual(*block.size) : 0;
  const double b = block.width ? usual(*block.width) / 2 : size * std::sin(angle),
               h = block.centre_height ? usual(*block.centre_height)
                   : block.height      ? usual(*block.height) / 2
                                       : size * std::cos(angle);
  const double least_hz = std::sqrt(standard_gravity_mps2 * h) / (2 * M_PI * b),
               softest_hz = quantile(model.legs->frequency.value, 0.01);
  if (!(softest_hz < least_hz)) return;
  doubter.said.push_back(
      fmt::format("legs of less than {:.3g} Hz do not hold this block upright, and it falls without being shaken; "
                  "legs.vertical_frequency_hz goes down to {:.3g}: are they so soft?",
                  least_hz, softest_hz));
}

// A block whose corner has turned by a right angle has fallen.
void ask_of_capacities(const FragilityPart& fragility, Doubter& doubter) {
  const struct {
    const char* unit;
    double largest;
    const char* question;
  } kinds[] = {{"_m", longest_m, "is it in metres?"},
               {"_rad", M_PI / 2, "is it in radians?"},
               {"_g", strongest_g, "is it in g?"}};
  for (const CapacitiesPart& of : fragility.capacities)
    for (const auto& kind : kinds)
      if (of.edp.ends_with(kind.unit) && !of.values.empty() && of.values.back() > kind.largest)
        doubter.said.push_back(
            fmt::format("fragility.capacities.{} goes up to {:.4g}: {}", of.edp, of.values.back(), kind.question));
}

std::vector<std::string> doubts_of_numbers(const Study& study, bool one_sample) {
  Doubter doubter;
  const BlockPart& block = study.model.block;
  for (const auto& length : {block.width, block.height, block.size}) doubter.ask(length, longest_m, "is it in metres?");
  doubter.ask(block.slenderness, steepest_rad, "is it in radians, and the angle whose tangent is width over height?");
  const FrictionPart& friction = study.model.friction;
  for (const auto& mu : {friction.mu, friction.mu_k, friction.mu_s})
    doubter.ask(mu, roughest, "is it a friction coefficient?");
  for (const EffectPart& effect : study.model.effects)
    ask_of_friction(effect, usual(friction.mu ? *friction.mu : *friction.mu_k), doubter);
  const bool shaken = shakes_vertically(study.model);
  for (const Quantity& quantity : quantities(study.model)) doubter.ask_spread(quantity);
  for (const MotionSource& source : study.motions) ask_of_source(source, shaken, study.model.start.any(), doubter);
  for (const DamagePart& state : study.fragility.damage)
    for (const Quantity& quantity : state.parameters) doubter.ask_spread(quantity);
  ask_of_capacities(study.fragility, doubter);
  for (const MotionSource& source : study.motions) ask_of_polarity(source, one_sided(study), one_sample, doubter);
  ask_of_legs(study.model, doubter);
  const auto& chain = study.model.chain;
  const bool tips = study.model.model != Model::slide;
  if (tips && chain && chain->wall_gap && chain->wall_gap->line == 0)
    doubter.said.push_back(
        "chain.wall_gap_m is not given: the wall behind is taken to touch the block (0), and whenever the block falls "
        "back to it the wall stops its upper edge and throws it up a little: peak accelerations are 1 g, those in the "
        "air: say how far away it is");
  return std::move(doubter.said);
}

// A channel of a motion by itself, as a horizontal one; its name says which.
FloorMotion channel_of(const FloorMotion& motion, MotionValues FloorMotion::*channel, const char* name) {
  FloorMotion alone;
  alone.name = name[0] == '\0' ? motion.name : fmt::format("the {} of {}", name, motion.name);
  alone.knot_s = motion.knot_s;
  alone.degree = motion.degree;
  alone.horizontal_mps2 = motion.*channel;
  return alone;
}

// Those that shake the block of this study.
std::vector<FloorMotion> channels_of(const FloorMotion& motion, const Study& study) {
  std::vector<FloorMotion> channels{channel_of(motion, &FloorMotion::horizontal_mps2, "")};
  if (!motion.cross_mps2.empty())
    channels.push_back(channel_of(motion, &FloorMotion::cross_mps2, "second component of the pair"));
  if (!motion.vertical_mps2.empty() && shakes_vertically(study.model))
    channels.push_back(channel_of(motion, &FloorMotion::vertical_mps2, "vertical channel"));
  return channels;
}

// By how much a motion is scaled in the median; 0: not by an intensity of its own.
double scaling(const MotionSource& source, const FloorMotion& ground) {
  if (!source.scale_to) return 0;
  const intensity::Measure& measure = intensity::find(source.scale_to->name);
  const double parameter = intensity::parameter_of(measure, source.scale_to->period_s);
  motion::SummaryRequest request;
  if (measure.spectral) request.sa_period_s = {measure.parameter ? parameter : 1.0};
  const double here = measure.value({.motion = motion::summarize(ground, request), .parameter = parameter});
  return std::isfinite(here) && here != 0 ? std::abs(usual(*source.amplitude) / here) : 0;
}

// Motions on which vertical_shaking does not act, beside others on which it does.
std::string moved_sideways_alone(const Study& study, const MotionSet& motions) {
  std::vector<std::string> level;
  const auto& entries = *motions.entries;
  for (std::size_t i = 0; shakes_vertically(study.model) && i < entries.size(); ++i)
    if (entries[i].motion.vertical_mps2.empty()) level.push_back(entries[i].motion.name);
  if (level.empty()) return "";
  return fmt::format(
      "vertical_shaking acts on {} of {} motions: no vertical channel is there of {}, which are swept as if the floor "
      "moved sideways alone: "
      "give theirs, or leave these out",
      entries.size() - level.size(), entries.size(), some(level, 10));
}

}  // namespace

std::vector<std::string> doubts(const Study& study) {
  std::vector<std::string> said = doubts_of_numbers(study, false);
  said.insert(said.end(), study.doubtful_draws.begin(), study.doubtful_draws.end());
  return said;
}

std::vector<std::string> doubts_of_records(const Study& study, const MotionSet& motions) {
  std::vector<std::string> said;
  if (const std::string level = moved_sideways_alone(study, motions); !level.empty()) said.push_back(level);
  for (std::size_t s = 0; s < study.motions.size(); ++s) {
    const MotionSource& source = study.motions[s];
    if (source.kind != MotionSource::Kind::records) continue;
    const bool as_it_is = source.amplitude && !source.scale_to;
    for (const std::size_t item : motions.of_source[s]) {
      const std::size_t entry = motions.ground(item);
      const FloorMotion& motion = motions.motion(entry);
      const double step = motion.duration_s() / static_cast<double>(motion.segments());
      if (step > coarsest_step_s)
        said.push_back(fmt::format("the time step of {} is {:.4g} s: is its time in seconds?", motion.name, step));
      if (const double factor = scaling(source, motion); factor > strongest_scaling)
        said.push_back(fmt::format("{} is scaled by {:.3g} to reach {} {:.3g}: is its unit right?", motion.name, factor,
                                   source.scale_to->name, usual(*source.amplitude)));
      const double first_mps2 = (*motions.entries)[entry].peak_mps2;
      for (const FloorMotion& channel : channels_of(motion, study)) {
        if (const motion::Offset offset = motion::offset(channel); offset.doubtful())
          said.push_back(
              fmt::format("{} has an offset of {:.3g} m/s2: with it alone the floor would leave at {:.3g} m/s, and the "
                          "shaking reaches {:.3g} m/s without it; is its zero right?",
                          channel.name, offset.acceleration_mps2, offset.leaving_mps, offset.shaking_mps));
        const double peak_mps2 = motion::peaks(channel).pga_mps2;
        if (peak_mps2 == 0) said.push_back(fmt::format("{} is zero throughout: is it the right one?", channel.name));
        const double peak_g = peak_mps2 / standard_gravity_mps2;
        if (as_it_is && peak_g * std::abs(usual(*source.amplitude)) > strongest_g)
          said.push_back(fmt::format("the floor of {} reaches {:.3g} g: is its unit right?", channel.name,
                                     peak_g * std::abs(usual(*source.amplitude))));
        else if (peak_mps2 > strongest_g * first_mps2)
          said.push_back(fmt::format("{} is {:.3g} times as strong as the first one: is its unit right?", channel.name,
                                     peak_mps2 / first_mps2));
      }
    }
  }
  return said;
}

namespace {

std::vector<std::string> with_those_of_records(std::vector<std::string> said, const Study& study,
                                               const MotionSet& motions) {
  for (std::string& more : doubts_of_records(study, motions)) said.push_back(std::move(more));
  return said;
}

}  // namespace

std::vector<std::string> doubts(const Study& study, const MotionSet& motions) {
  return with_those_of_records(doubts(study), study, motions);
}

void tell_doubts(const Study& study, const MotionSet& motions, std::set<std::string>& told) {
  for (const std::string& doubt : doubts(study, motions))
    if (told.insert(doubt).second) parallel::tell("doubtful: " + doubt + "\n");
}

std::vector<std::string> doubts(const Case& c, const MotionSet& motions) {
  return with_those_of_records(doubts_of_numbers(c.study, true), c.study, motions);
}

}  // namespace freestand::study
