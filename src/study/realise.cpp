#include "study/realise.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/chain.hpp"
#include "dynamics/laws.hpp"
#include "intensity/intensity.hpp"
#include "motion/pulse.hpp"
#include "motion/summary.hpp"
#include "study/problems.hpp"

namespace freestand::study {
namespace {

using sampling::Plan;
using sampling::Stream;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

// A number of the study with its stream of uniforms; drawn only when it is no fixed number.
class DrawnNumber {
 public:
  DrawnNumber(const Plan& plan, const Quantity& quantity) : value_(quantity.value), stream_(plan, quantity.stream()) {
    if (const auto* fixed = std::get_if<sampling::Fixed>(&value_)) number_ = fixed->value;
  }
  double operator()(std::uint64_t sample) const { return number_ ? *number_ : quantile(value_, stream_(sample)); }

 private:
  sampling::Distribution value_;
  Stream stream_;
  std::optional<double> number_;
};

std::optional<DrawnNumber> drawn(const Plan& plan, const std::optional<Quantity>& quantity) {
  return quantity ? std::optional<DrawnNumber>(std::in_place, plan, *quantity) : std::nullopt;
}

enum class Amplitude { acceleration_g, velocity_mps, pta_g, intensity, factor };

Amplitude amplitude_of(const MotionSource& source) {
  const std::string& name = source.amplitude->name;
  if (name == "motion.peak_acceleration_g") return Amplitude::acceleration_g;
  if (name == "motion.peak_velocity_mps") return Amplitude::velocity_mps;
  if (name == "motion.pta_g") return Amplitude::pta_g;
  return source.scale_to ? Amplitude::intensity : Amplitude::factor;
}

// The intensity that a motion is scaled to: of a floor, that of the ground under its building.
struct ScaleTarget {
  const intensity::Measure* measure = nullptr;
  double parameter = 0;
  std::vector<motion::MotionSummary> summaries;  // of the items of the source

  ScaleTarget(const MotionSource& source, const MotionSet& motions, const std::vector<std::size_t>& items) {
    if (amplitude_of(source) != Amplitude::intensity) return;
    measure = &intensity::find(source.scale_to->name);
    parameter = intensity::parameter_of(*measure, source.scale_to->period_s);
    motion::SummaryRequest request;
    if (measure->spectral) request.sa_period_s = {measure->parameter ? parameter : 1.0};
    for (const std::size_t item : items)
      summaries.push_back(motions.is_pulse(item) ? motion::summarize(motion::find_pulse(motions.motion(item).name))
                                                 : motion::summarize(motions.motion(motions.ground(item)), request));
  }

  // Of a motion at scale 1.
  double unscaled(std::size_t item, double stretch, const Specimen& specimen) const {
    return measure->value({.motion = summaries[item],
                           .scale = 1,
                           .stretch = stretch,
                           .alpha_rad = specimen.block.alpha_rad(),
                           .p_radps = specimen.block.p_radps(),
                           .mu_k = specimen.friction.mu_k,
                           .parameter = parameter});
  }
};

struct Source {
  Source(const Plan& plan, const MotionSource& from, const MotionSet& motions, const std::vector<std::size_t>& items)
      : part(from),
        amplitude_kind(amplitude_of(from)),
        amplitude(plan, *from.amplitude),
        target(from, motions, items),
        period(drawn(plan, from.period)),
        storey(drawn(plan, from.storey)),
        storeys(from.storeys()),
        item(plan, from.kind == MotionSource::Kind::pulses ? "motion.pulse" : "motion.record"),
        weights(from.pulses.weights) {
    for (const motion::RecordRow& row : from.files) weights.push_back(row.weight);
    if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 1; })) weights.clear();
  }

  MotionSource part;
  Amplitude amplitude_kind;
  DrawnNumber amplitude;
  ScaleTarget target;
  std::optional<DrawnNumber> period, storey;
  std::vector<int> storeys;
  Stream item;
  std::vector<double> weights;  // of the pulses or records; empty: all alike

  // The item of a sample: a pulse or a record, and with a building one of the record's floors.
  std::size_t pick(std::uint64_t sample, std::size_t items) const {
    const std::size_t floors = std::max<std::size_t>(1, storeys.size()), motions = items / floors;
    const std::size_t one = motions == 1 ? 0 : sampling::pick(motions, weights, item(sample));
    if (floors == 1) return one;
    const auto floor = std::find(storeys.begin(), storeys.end(), static_cast<int>((*storey)(sample)));
    return one * floors + static_cast<std::size_t>(floor - storeys.begin());
  }
};

std::string column_name(std::string dotted) {
  std::replace(dotted.begin(), dotted.end(), '.', '_');
  return dotted;
}

Friction as_effects_make_it(const Specimen& specimen, const Shaking& shaking) {
  const bool changed = std::any_of(specimen.effects.begin(), specimen.effects.end(),
                                   [](const EffectUse& use) { return bool(use.effect->specimen); });
  return changed ? dynamics::set_up(specimen, shaking).specimen.friction : specimen.friction;
}

const std::vector<Column>& derived_columns() {
  static const std::vector<Column> columns = {
      {"block_width_m", "m", "width of the block"},
      {"block_height_m", "m", "height of the block"},
      {"block_alpha_rad", "rad", "slenderness angle of the block, atan(W/(2 h)), h: height of the centre of mass"},
      {"block_size_m", "m", "R, half the diagonal of the block"},
      {"block_p_radps", "rad/s", "frequency parameter of the block, sqrt(3g/(4R))"},
      {"friction_mu_k", "1", "kinetic friction coefficient"},
      {"friction_mu_s", "1", "static friction coefficient"},
  };
  return columns;
}

const std::vector<Column>& motion_columns() {
  static const std::vector<Column> columns = {
      {"motion", "1", "index of the floor motion", ColumnKind::integer},
      {"scale", "1", "factor on the motion as stored (pulses are stored with a peak of 1 m/s2); negative: mirrored"},
      {"pta_g", "g", "peak of the floor's horizontal acceleration"},
      {"pulse_period_s", "s", "period of the pulse; nan for records"},
  };
  return columns;
}

constexpr double usual_leg_damping = 0.02;  // where a study does not say

const Column storey_column = {"storey", "1", "how many floors above the ground the equipment stands",
                              ColumnKind::integer};

std::size_t position(const std::vector<Quantity>& quantities, const std::string& name) {
  const auto found = std::find_if(quantities.begin(), quantities.end(), [&](const auto& q) { return q.name == name; });
  return static_cast<std::size_t>(found - quantities.begin());
}

}  // namespace

struct Realiser::Parts {
  Parts(const Study& study, MotionSet set);

  // Value of a model quantity among those of this sample; nothing when the study does not have it.
  std::optional<double> value(const std::vector<double>& drawn_values, const char* name) const {
    const std::size_t i = position(quantities, name);
    return i < quantities.size() ? std::optional<double>(drawn_values[i]) : std::nullopt;
  }
  Block block(const std::vector<double>& values) const;
  Friction friction(const std::vector<double>& values) const;
  std::vector<EffectUse> effects(const std::vector<double>& values) const;
  EffectUse chain(const std::vector<double>& values, const Block& block) const;
  Neighbour neighbour(const std::vector<double>& values) const;
  void shake(std::uint64_t sample, Realisation& out) const;

  ModelPart model;
  MotionSet motions;
  std::vector<Quantity> quantities;
  std::vector<DrawnNumber> draws;  // one for each quantity
  std::vector<Source> sources;
  std::vector<double> weights;
  Stream source_stream;
  std::vector<Column> columns;
  std::vector<bool> derived_wanted;
};

Realiser::Parts::Parts(const Study& study, MotionSet set)
    : model(study.model),
      motions(std::move(set)),
      quantities(study::quantities(study.model)),
      source_stream(study.plan(), "motion.source") {
  for (const auto& quantity : quantities) {
    draws.emplace_back(study.plan(), quantity);
    columns.push_back({column_name(quantity.name), quantity.unit, quantity.name + " of the study"});
  }
  for (const auto& part : model.effects)
    for (std::size_t i = 0; i < part.parameters.size(); ++i) {
      const std::string& summary = part.effect->parameters[i].summary;
      const auto column = std::find_if(columns.begin(), columns.end(),
                                       [&](const Column& c) { return c.name == column_name(part.parameters[i].name); });
      if (!summary.empty()) column->description = part.name + ": " + summary;
    }
  for (std::size_t s = 0; s < study.motions.size(); ++s) {
    sources.emplace_back(study.plan(), study.motions[s], motions, motions.of_source[s]);
    weights.push_back(study.motions[s].weight);
  }
  for (const auto& column : derived_columns()) {
    const bool there =
        std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == column.name; });
    derived_wanted.push_back(!there);
    if (!there) columns.push_back(column);
  }
  columns.insert(columns.end(), motion_columns().begin(), motion_columns().end());
  if (in_a_building(study)) columns.push_back(storey_column);
}

Block Realiser::Parts::block(const std::vector<double>& values) const {
  const double mass = *value(values, "block.mass_kg");
  const BlockPart& part = model.block;
  if (part.width) {
    std::optional<double> centre_height, gyration_radius;
    if (part.centre_height) centre_height = value(values, "block.centre_height_m");
    if (part.gyration_radius) gyration_radius = value(values, "block.gyration_radius_m");
    if (part.inertia) gyration_radius = std::sqrt(*value(values, "block.inertia_kgm2") / mass);
    return Block::of_outline(*value(values, "block.width_m"), *value(values, "block.height_m"), mass, centre_height,
                             gyration_radius);
  }
  const double alpha = *value(values, "block.slenderness_rad"), diagonal = 2 * *value(values, "block.size_m");
  return Block::rectangular(diagonal * std::sin(alpha), diagonal * std::cos(alpha), mass);
}

Friction Realiser::Parts::friction(const std::vector<double>& values) const {
  const double across = value(values, "friction.ratio_across").value_or(1),
               axis = value(values, "friction.axis_rad").value_or(0);
  if (const auto mu = value(values, "friction.mu")) return {*mu, *mu, across, axis};
  const double mu_k = *value(values, "friction.mu_k");
  if (const auto mu_s = value(values, "friction.mu_s")) return {*mu_s, mu_k, across, axis};
  return {mu_k * value(values, "friction.static_ratio").value_or(1), mu_k, across, axis};
}

std::vector<EffectUse> Realiser::Parts::effects(const std::vector<double>& values) const {
  std::vector<EffectUse> uses;
  for (const EffectPart& part : model.effects) {
    uses.push_back({part.effect.get(), {}});
    for (const auto& quantity : part.parameters)
      uses.back().parameters.push_back(*value(values, quantity.name.c_str()));
  }
  return uses;
}

EffectUse Realiser::Parts::chain(const std::vector<double>& values, const Block& block) const {
  return dynamics::use({.slack_m = *value(values, "chain.slack_m"),
                        .stiffness_npm = *value(values, "chain.stiffness_npm"),
                        .strength_n = *value(values, "chain.strength_n"),
                        .height_m = value(values, "chain.height_m").value_or(block.full_height_m()),
                        .side = model.chain->side,
                        .number = value(values, "chain.number").value_or(1),
                        .plan_angle_rad = value(values, "chain.plan_angle_rad").value_or(0),
                        .elevation_rad = value(values, "chain.elevation_rad").value_or(0),
                        .damping_nspm = value(values, "chain.damping_nspm").value_or(0),
                        .wall_gap_m = value(values, "chain.wall_gap_m")},
                       block);
}

Neighbour Realiser::Parts::neighbour(const std::vector<double>& values) const {
  const double mu_k = *value(values, "neighbour.mu_k");
  return {.gap_m = *value(values, "neighbour.gap_m"),
          .side = model.neighbour->side,
          .mass_kg = *value(values, "neighbour.mass_kg"),
          .friction = {mu_k * value(values, "neighbour.static_ratio").value_or(1), mu_k},
          .restitution = value(values, "neighbour.restitution").value_or(0)};
}

void Realiser::Parts::shake(std::uint64_t sample, Realisation& out) const {
  const std::size_t chosen = sources.size() == 1 ? 0 : sampling::pick(sources.size(), weights, source_stream(sample));
  const Source& source = sources[chosen];
  const auto& items = motions.of_source[chosen];
  const std::size_t item = source.pick(sample, items.size());
  out.motion = items[item];
  const MotionSet::Entry &entry = (*motions.entries)[out.motion],
                         &ground = (*motions.entries)[motions.ground(out.motion)];

  const double amplitude = source.amplitude(sample);
  out.pulse_period_s = source.period ? (*source.period)(sample) : not_known;
  Shaking& shaking = out.shaking;
  shaking.motion = &entry.motion;
  shaking.stretch = source.period ? out.pulse_period_s : 1;
  switch (source.amplitude_kind) {
    case Amplitude::acceleration_g:
      shaking.scale = amplitude * standard_gravity_mps2;
      break;
    case Amplitude::velocity_mps:
      shaking.scale = amplitude / (out.pulse_period_s * entry.peak_mps);
      break;
    case Amplitude::pta_g:
      shaking.scale = amplitude * standard_gravity_mps2 / ground.peak_mps2;
      break;
    case Amplitude::intensity:
      shaking.scale = amplitude / source.target.unscaled(item, shaking.stretch, out.specimen);
      break;
    case Amplitude::factor:
      shaking.scale = amplitude;
      break;
  }
  shaking.scale *= source.part.pulse_scale;
  out.pta_g = std::abs(shaking.scale) * entry.peak_mps2 / standard_gravity_mps2;
}

Realiser::Realiser(const Study& study, MotionSet motions)
    : parts_(std::make_shared<const Parts>(study, std::move(motions))) {}

Realisation Realiser::operator()(std::uint64_t sample) const {
  const Parts& parts = *parts_;
  Realisation out;
  out.draws.reserve(parts.columns.size());
  for (const auto& draw : parts.draws) out.draws.push_back(draw(sample));

  out.specimen.block = parts.block(out.draws);
  out.specimen.friction = parts.friction(out.draws);
  out.specimen.impact = {parts.model.impact.law, *parts.value(out.draws, "impact.factor")};
  out.specimen.model = parts.model.model;
  if (parts.model.bouc_wen)
    out.specimen.bouc_wen = {*parts.value(out.draws, "bouc_wen.yield_displacement_m"),
                             *parts.value(out.draws, "bouc_wen.exponent"), *parts.value(out.draws, "bouc_wen.gamma"),
                             *parts.value(out.draws, "bouc_wen.beta")};
  out.specimen.effects = parts.effects(out.draws);
  out.slip_factor = parts.value(out.draws, "discrepancy.slip").value_or(1);
  if (parts.model.chain) out.specimen.effects.push_back(parts.chain(out.draws, out.specimen.block));
  if (parts.model.neighbour) out.specimen.neighbour = parts.neighbour(out.draws);
  if (parts.model.legs)
    out.specimen.legs = {*parts.value(out.draws, "legs.vertical_frequency_hz"),
                         parts.value(out.draws, "legs.vertical_damping").value_or(usual_leg_damping)};
  const auto start = [&](const std::optional<Quantity>& part) {
    return part ? *parts.value(out.draws, part->name.c_str()) : 0.0;
  };
  const StartPart& begins = parts.model.start;
  out.specimen.start = {start(begins.rotation), start(begins.rotation_rate), start(begins.slip),
                        start(begins.slip_velocity)};
  parts.shake(sample, out);

  const Block& block = out.specimen.block;
  const Friction friction = as_effects_make_it(out.specimen, out.shaking);
  const double derived[] = {block.base_m(),  block.full_height_m(), block.alpha_rad(), block.size_m(),
                            block.p_radps(), friction.mu_k,         friction.mu_s};
  for (std::size_t i = 0; i < parts.derived_wanted.size(); ++i)
    if (parts.derived_wanted[i]) out.draws.push_back(derived[i]);
  for (const double x : {static_cast<double>(out.motion), out.shaking.scale, out.pta_g, out.pulse_period_s})
    out.draws.push_back(x);
  if (parts.columns.back().name == storey_column.name) out.draws.push_back((*parts.motions.entries)[out.motion].storey);
  return out;
}

const std::vector<Column>& Realiser::draw_columns() const { return parts_->columns; }

const MotionSet& Realiser::motions() const { return parts_->motions; }

std::string Realiser::column_of(const std::string& dotted) {
  if (dotted == "motion.period_s") return "pulse_period_s";
  if (dotted == "motion.pta_g") return "pta_g";
  if (dotted == "motion.storey") return "storey";
  return column_name(dotted);
}

Settings integration_settings(const Study& study) {
  Settings settings;
  settings.tolerance = study.tolerance;
  settings.free_vibration_s = study.free_vibration_s;
  settings.slip_by_side = study.slip_by_side;
  settings.contact_forces = study.contact_forces;
  settings.acceleration_height_m = study.acceleration_height_m.value_or(not_known);
  return settings;
}

}  // namespace freestand::study
