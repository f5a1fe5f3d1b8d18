// fragility.damage: damage states as conditions on demands, and capacities that are distributions.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/shown_text.hpp"
#include "formula/condition.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

bool is_word(const std::string& text) {
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Words of logic and functions of conditions, which a parameter cannot be called.
const std::vector<std::string> taken = {"and", "or", "not", "min", "max", "abs", "exp", "log", "sqrt", "sum", "avg"};

class DamageReader {
 public:
  DamageReader(Section& section, const Known& known) : section_(section), known_(known) {
    for (const KnownEdp& edp : known.edps) {
      demands_.push_back(edp.name);
      names_.push_back({edp.name, edp.binary});
    }
  }

  void check_name(const DamagePart& part, const std::vector<DamagePart>& others) {
    if (!is_word(part.name))
      problem(part,
              fmt::format("damage state \"{}\" is no plain word (it becomes a name in files): use letters, digits "
                          "and _",
                          shown(part.name)));
    else if (holds(demands_, part.name))
      problem(part, fmt::format("damage state {} has the name of a demand (which of the two would be meant?): choose "
                                "another",
                                part.name));
    for (const DamagePart& other : others)
      if (other.name == part.name)
        problem(part, fmt::format("damage state {} stands twice (one name, one state): rename one", part.name));
  }

  // Parameters get the same check as the condition that reads them.
  void check_condition(DamagePart& part) {
    std::vector<formula::Condition::Name> names = names_;
    for (const Quantity& parameter : part.parameters) {
      const std::string name = name_of(parameter);
      if (!is_word(name) || holds(demands_, name) || holds(taken, name))
        return problem(part, fmt::format("parameter {} of damage state {} cannot be called that (it is taken, or no "
                                         "plain word): choose another name",
                                         shown(name), part.name));
      names.push_back({name, false});
    }
    try {
      const formula::Condition condition(part.when, names);
      for (const std::size_t used : condition.uses())
        if (used < demands_.size()) {
          part.demands.push_back(demands_[used]);
          if (const std::string& refusal = known_.edps[used].refusal; !refusal.empty())
            problem(part, fmt::format("damage state {}: {}", part.name, refusal));
        }
      if (depends_on_order(condition, names))
        problem(
            part,
            fmt::format(
                "damage state {} is not defined for a block that overturned (of demands that are beyond every capacity "
                "a difference or a ratio is none): add \"or overturned\" to its condition, or \"and not overturned\"",
                part.name));
      for (std::size_t i = demands_.size(); i < names.size(); ++i)
        if (!holds_place(condition.uses(), i))
          problem(part, fmt::format("parameter {} of damage state {} stands nowhere in its condition (it would change "
                                    "nothing): remove it",
                                    names[i].name, part.name));
    } catch (const formula::FormulaError& error) {
      const std::size_t place = std::min(error.position(), part.when.size());
      return problem(part, fmt::format("damage state {} does not hold together ({}, character {}): its condition may "
                                       "name demands ({}) and its parameters\n    {}\n    {:>{}}",
                                       part.name, error.what(), place + 1, near_or_all(part.when, place), part.when,
                                       '^', place + 1));
    }
    if (part.demands.empty())
      problem(part, fmt::format("damage state {} looks at no demand (it would hold always or never): name one of {}",
                                part.name, joined(demands_)));
  }

  static std::string name_of(const Quantity& parameter) { return parameter.name.substr(parameter.name.rfind('.') + 1); }

 private:
  // Demands beyond every capacity, one far beyond the others, each in turn: does it say now this and now that?
  bool depends_on_order(const formula::Condition& condition, const std::vector<formula::Condition::Name>& names) const {
    std::vector<double> values(names.size(), 1);
    std::vector<std::size_t> beyond;
    for (const std::size_t used : condition.uses()) {
      if (used >= demands_.size()) continue;
      if (known_.edps[used].censored) beyond.push_back(used);
      values[used] = known_.edps[used].name == "overturned" ? 1 : 0;
    }
    int held = 0;
    for (const std::size_t farthest : beyond) {
      for (const std::size_t one : beyond) values[one] = one == farthest ? 1e12 : 1e6;
      held += condition.holds(values);
    }
    return held > 0 && held < static_cast<int>(beyond.size());
  }

  static bool holds_place(const std::vector<std::size_t>& places, std::size_t place) {
    return std::find(places.begin(), places.end(), place) != places.end();
  }

  void problem(const DamagePart& part, const std::string& text) { section_.problems().add(part.line, text); }

  // What was meant by the word at the place, if something is near; else all there is.
  std::string near_or_all(const std::string& text, std::size_t place) const {
    std::size_t begin = std::min(place, text.size()), end = begin;
    const auto of_word = [&](std::size_t i) {
      return std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_';
    };
    while (begin > 0 && of_word(begin - 1)) --begin;
    while (end < text.size() && of_word(end)) ++end;
    const std::string near = nearest(text.substr(begin, end - begin), demands_);
    return near.empty() || end == begin ? joined(demands_) : "did you mean " + near + "?";
  }

  Section& section_;
  const Known& known_;
  std::vector<std::string> demands_;
  std::vector<formula::Condition::Name> names_;
};

// {when: "...", parameters: {...}} or the condition alone.
DamagePart read_state(Section& damage, const std::string& name) {
  const YAML::Node& node = *damage.find(name);
  DamagePart part{name, "", {}, {}, damage.line(name)};
  if (!node.IsMap()) {
    part.when = damage.text(name, "");
    return part;
  }
  const std::size_t before = damage.problems().count();
  Section state(node, damage.name(name), damage.line(name), damage.problems());
  part.when = state.text("when", "");
  if (!state.has("when"))
    state.problem("when", state.name("when") + " is missing (when is it damaged?): add when: \"peak_slip_m > 0.1\"");
  if (const YAML::Node* given = state.find("parameters")) {
    Section parameters(*given, state.name("parameters"), state.line("parameters"), state.problems());
    if (given->IsMap())
      for (const auto& entry : *given)
        if (const auto quantity = parameters.quantity("damage." + name, entry.first.Scalar(), range::any))
          part.parameters.push_back(*quantity);
    parameters.finish();
  }
  state.finish();
  if (damage.problems().count() != before) part.when.clear();  // what follows from them is not told as well
  return part;
}

}  // namespace

void read_damage(Section& section, const Known& known, FragilityPart& fragility) {
  DamageReader reader(section, known);
  std::vector<DamagePart> states = std::move(fragility.damage);  // of capacities that are distributions
  fragility.damage.clear();
  if (const YAML::Node* node = section.find("damage")) {
    Section damage(*node, section.name("damage"), section.line("damage"), section.problems());
    if (node->IsMap())
      for (const auto& entry : *node)
        if (entry.first.IsScalar() && damage.find(entry.first.Scalar()))
          states.push_back(read_state(damage, entry.first.Scalar()));
    damage.finish();
  }
  for (DamagePart& part : states) {
    if (part.when.empty()) continue;
    reader.check_name(part, fragility.damage);
    reader.check_condition(part);
    fragility.damage.push_back(std::move(part));
  }
}

}  // namespace freestand::study
