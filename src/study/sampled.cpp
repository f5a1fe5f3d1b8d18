#include "study/sampled.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <set>

namespace freestand::study {
namespace {

using sampling::Stream;

constexpr int classes = 64;

// Class of a draw by its uniform.
struct Classes {
  Classes(const sampling::Plan& plan, const Quantity& quantity) : stream(plan, quantity.stream()) {
    if (const auto* choice = std::get_if<sampling::Choice>(&quantity.value)) {
      items = choice->values.size();
      weights = choice->weights;
    }
    if (const auto* joint = std::get_if<sampling::Posterior>(&quantity.value)) class_of_row = ranked(joint->values);
  }
  // Rows of a table of joint draws: of each, the class of its value among the others.
  static std::vector<int> ranked(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<int> of(values.size());
    for (std::size_t k = 0; k < order.size(); ++k) of[order[k]] = static_cast<int>(k * classes / order.size());
    return of;
  }
  bool ordered() const { return items == 0; }
  int count() const { return ordered() ? classes : static_cast<int>(items); }
  int operator()(std::uint64_t sample) const {
    const double u = stream(sample);
    if (!class_of_row.empty()) return class_of_row[sampling::pick(class_of_row.size(), {}, u)];
    return ordered() ? static_cast<int>(u * classes) : static_cast<int>(sampling::pick(items, weights, u));
  }

  Stream stream;
  std::size_t items = 0;  // of a choice
  std::vector<double> weights;
  std::vector<int> class_of_row;  // of joint draws
};

constexpr int idle_of_a_design = 16;
constexpr int first_of_tables = 3;  // Parameter::design

// Which design the draws of these streams are even in.
int design_of(const Study& study, const std::vector<std::string>& streams) {
  if (study.design != sampling::Design::sobol) return 0;
  return sampling::sobol_dimension(streams.front()) >= 0 ? 1 : 2;
}

// Numbers that are columns of one table of joint draws, by its stream, where there are several: they are dependent.
using Tables = std::map<std::string, std::vector<Quantity>>;

Tables tables_of(const Study& study) {
  Tables tables;
  const auto add = [&tables](const Quantity& quantity) {
    if (!std::holds_alternative<sampling::Posterior>(quantity.value)) return;
    std::vector<Quantity>& columns = tables[quantity.stream()];
    const auto values = [](const Quantity& of) -> const std::vector<double>& {
      return std::get<sampling::Posterior>(of.value).values;
    };
    if (std::none_of(columns.begin(), columns.end(), [&](const Quantity& other) {
          return other.name == quantity.name && values(other) == values(quantity);
        }))
      columns.push_back(quantity);
  };
  for (const Quantity& quantity : quantities(study.model)) add(quantity);
  for (const MotionSource& source : study.motions)
    for (const auto number : {&MotionSource::amplitude, &MotionSource::period, &MotionSource::storey})
      if (source.*number) add(*(source.*number));
  std::erase_if(tables, [](const auto& table) { return table.second.size() < 2; });
  return tables;
}

// The table is one input, whose classes are the rows that differ.
Sampled of_table(const Study& study, const std::string& stream, const std::vector<Quantity>& columns) {
  Sampled one;
  std::set<std::string> names;
  std::vector<std::vector<double>> rows;
  for (const Quantity& column : columns) {
    if (names.insert(column.name).second) one.parameter.name += (rows.empty() ? "" : " with ") + column.name;
    const std::vector<double>& values = std::get<sampling::Posterior>(column.value).values;
    rows.resize(values.size());
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(values[row]);
  }
  one.parameter.name += " (drawn together)";
  std::map<std::vector<double>, int> class_of;
  std::vector<int> of_row;
  for (const std::vector<double>& row : rows)
    of_row.push_back(class_of.try_emplace(row, static_cast<int>(class_of.size())).first->second);
  one.parameter.classes = static_cast<int>(class_of.size());
  one.parameter.ordered = false;
  one.streams = {stream};
  one.class_of = [of_row, drawn = Stream(study.plan(), stream)](std::uint64_t sample, std::size_t) {
    return of_row[sampling::pick(of_row.size(), {}, drawn(sample))];
  };
  return one;
}

bool is_drawn(const std::optional<Quantity>& quantity) { return quantity && !is_fixed(quantity->value); }

Sampled of_model(const Study& study, const Quantity& quantity) {
  const Classes of(study.plan(), quantity);
  Sampled one;
  one.parameter.name = quantity.name;
  one.parameter.unit = quantity.unit;
  one.parameter.classes = of.count();
  one.parameter.ordered = of.ordered();
  one.streams = {quantity.stream()};
  one.class_of = [of](std::uint64_t sample, std::size_t) { return of(sample); };
  return one;
}

Sampled of_motion(std::size_t motions, const std::vector<std::size_t>& ground) {
  Sampled one;
  one.parameter.name = "motion";
  one.parameter.classes = static_cast<int>(motions);
  one.parameter.ordered = false;
  one.streams = {"motion.source", "motion.pulse", "motion.record"};
  one.class_of = [ground](std::uint64_t, std::size_t motion) {
    return static_cast<int>(ground.empty() ? motion : ground[motion]);
  };
  return one;
}

// Which entry of `motions` a sample takes, as the sweep picks it.
std::function<std::size_t(std::uint64_t)> entry_of(const Study& study) {
  std::vector<double> weights;
  for (const MotionSource& source : study.motions) weights.push_back(source.weight);
  if (weights.size() == 1) return [](std::uint64_t) { return std::size_t{0}; };
  return [weights, stream = Stream(study.plan(), "motion.source")](std::uint64_t sample) {
    return sampling::pick(weights.size(), weights, stream(sample));
  };
}

// A number that each entry of `motions` may give in its own way: amplitude, period. Of one entry's choice the values are the
// classes; of several entries, equal shares of what each draws.
void add_of_motions(const Study& study, std::optional<Quantity> MotionSource::*number, const std::string& name,
                    const Tables& tables, std::vector<Sampled>& all) {
  Sampled found;
  found.parameter.classes = classes;
  std::vector<std::string> names;
  std::string unit;
  const auto add = [](std::vector<std::string>& list, const std::string& one) {
    if (std::find(list.begin(), list.end(), one) == list.end()) list.push_back(one);
  };
  auto of = std::make_shared<std::vector<std::optional<Classes>>>();
  for (const MotionSource& source : study.motions) {
    const std::optional<Quantity>& quantity = source.*number;
    of->emplace_back();
    if (!is_drawn(quantity) || tables.contains(quantity->stream())) continue;
    of->back().emplace(study.plan(), *quantity);
    add(found.streams, quantity->stream());
    add(names, quantity->name);
    unit = quantity->unit;
  }
  if (found.streams.empty()) return;
  const bool several = names.size() > 1;
  found.parameter.name = several ? name : names.front();
  if (!several) found.parameter.unit = unit;
  if (of->size() == 1) {
    found.parameter.classes = of->front()->count();
    found.parameter.ordered = of->front()->ordered();
  } else {
    for (auto& one : *of)
      if (one) one->items = 0;
  }
  found.class_of = [of, entry = entry_of(study), none = found.parameter.classes](std::uint64_t sample, std::size_t) {
    const std::optional<Classes>& mine = (*of)[entry(sample)];
    return mine ? (*mine)(sample) : none;
  };
  all.push_back(std::move(found));
}

}  // namespace

std::vector<Sampled> sampled(const Study& study, std::size_t motions, const std::vector<std::size_t>& ground) {
  std::vector<Sampled> all;
  const Tables tables = tables_of(study);
  for (const auto& [stream, columns] : tables) all.push_back(of_table(study, stream, columns));
  for (const Quantity& quantity : quantities(study.model))
    if (!is_fixed(quantity.value) && !tables.contains(quantity.stream())) all.push_back(of_model(study, quantity));
  add_of_motions(study, &MotionSource::amplitude, "motion.amplitude", tables, all);
  add_of_motions(study, &MotionSource::period, "motion.period_s", tables, all);
  add_of_motions(study, &MotionSource::storey, "motion.storey", tables, all);
  const std::size_t different = ground.empty() ? motions : std::set<std::size_t>(ground.begin(), ground.end()).size();
  if (different > 1) all.push_back(of_motion(motions, ground));
  for (Sampled& one : all) one.parameter.design = design_of(study, one.streams);
  // How evenly classes are drawn hangs on how many there are.
  for (std::size_t t = 0; t < tables.size() && study.design == sampling::Design::sobol; ++t)
    all[t].parameter.design = first_of_tables + static_cast<int>(t);
  return all;
}

std::vector<Sampled> idle_parameters(const Study& study, const std::vector<Sampled>& all) {
  // Names of dimensions; those that the study draws are none of them.
  static constexpr const char* dimensions[] = {"impact.factor",
                                               "motion.source",
                                               "effects.vertical_shaking.scale",
                                               "effects.static_friction.ratio",
                                               "effects.rate_weakening.drop",
                                               "effects.rate_weakening.speed_mps",
                                               "effects.rate_strengthening.rise",
                                               "effects.rate_strengthening.speed_mps",
                                               "effects.friction_wear.ratio",
                                               "effects.friction_wear.path_m",
                                               "effects.directional_friction.asymmetry",
                                               "effects.pressure_friction.exponent",
                                               "effects.viscous_drag.rate_per_s",
                                               "effects.floor_tilt.angle_rad",
                                               "effects.flexible_legs.frequency_hz",
                                               "effects.flexible_legs.damping",
                                               "effects.slack_tether.slack_m",
                                               "effects.slack_tether.frequency_hz",
                                               "effects.slack_tether.rate_per_s",
                                               "effects.centering_spring.frequency_hz"};
  std::set<int> designs,
      drawn = {sampling::sobol_dimension("motion.source"), sampling::sobol_dimension("motion.pulse")};
  for (const Sampled& one : all) {
    designs.insert(one.parameter.design);
    for (const std::string& stream : one.streams) drawn.insert(sampling::sobol_dimension(stream));
  }
  std::vector<Sampled> idle;
  const auto add = [&](const std::string& name, int design, int of_classes) {
    Sampled one;
    one.parameter.name = name;
    one.parameter.classes = of_classes;
    one.parameter.design = design;
    one.parameter.idle = true;
    one.class_of = [of_classes, stream = Stream(study.plan(), name)](std::uint64_t sample, std::size_t) {
      return static_cast<int>(stream(sample) * of_classes);
    };
    idle.push_back(std::move(one));
  };
  std::vector<std::string> names;
  for (const char* name : dimensions)
    if (designs.contains(1) && names.size() < idle_of_a_design && !drawn.contains(sampling::sobol_dimension(name)))
      names.emplace_back(name);
  for (int i = 0; designs.contains(2) && i < idle_of_a_design; ++i) names.push_back("idle." + std::to_string(i));
  for (const std::string& name : names) add(name, design_of(study, {name}), classes);
  for (const Sampled& one : all)
    for (int i = 0; one.parameter.design >= first_of_tables && i < idle_of_a_design; ++i)
      if (i < 2 || (i + 1) * one.parameter.classes <= idle_of_a_design * classes)  // as much to count
        add("idle." + std::to_string(i), one.parameter.design, one.parameter.classes);
  return idle;
}

}  // namespace freestand::study
