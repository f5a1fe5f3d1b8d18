#include "study/target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/key_names.hpp"
#include "base/random.hpp"

namespace freestand::study {
namespace {

using sampling::Choice;
using sampling::Distribution;

// What a target can be given for: numbers of the model, and of the motions where they are one entry.
std::vector<Quantity> targetable(const Study& study) {
  std::vector<Quantity> all = quantities(study.model);
  if (study.motions.size() != 1) return all;
  for (const auto& quantity :
       {study.motions.front().amplitude, study.motions.front().period, study.motions.front().storey})
    if (quantity) all.push_back(*quantity);
  return all;
}

const Quantity* find(const std::vector<Quantity>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  return found == all.end() ? nullptr : &*found;
}

double weight_of(const Choice& choice, double value) {
  double here = 0, sum = 0;
  for (std::size_t i = 0; i < choice.values.size(); ++i) {
    const double weight = choice.weights.empty() ? 1 : choice.weights[i];
    sum += weight;
    here += choice.values[i] == value ? weight : 0;
  }
  return here / sum;
}

// Share of the target that no sample can have.
double outside(const Distribution& swept, const Distribution& target) {
  if (const auto* list = std::get_if<Choice>(&target)) {
    double share = 0;
    for (const double value : list->values)
      if (weight_of(std::get<Choice>(swept), value) == 0) share += weight_of(*list, value);
    return share;
  }
  const sampling::Support ends = support(swept);
  return cumulative(target, ends.lower) + (1 - cumulative(target, ends.upper));
}

// How much likelier the target is than the sweep: of each cell of the uniforms, or of each value of a list.
std::vector<double> ratios(const Distribution& swept, const Distribution& target) {
  std::vector<double> r;
  if (const auto* list = std::get_if<Choice>(&swept)) {
    for (const double value : list->values) {
      const double there = weight_of(*list, value);
      r.push_back(there > 0 ? weight_of(std::get<Choice>(target), value) / there : 0);
    }
    return r;
  }
  const sampling::Support ends = support(swept);
  double below = cumulative(target, ends.lower);
  for (std::size_t i = 1; i <= Target::cells; ++i) {
    const double u = static_cast<double>(i) / Target::cells;
    const double above = cumulative(target, i < Target::cells ? quantile(swept, u) : ends.upper);
    r.push_back((above - below) * Target::cells);
    below = above;
  }
  return r;
}

std::string wrong(const Quantity& target, const std::vector<Quantity>& all, double adequate) {
  const Quantity* swept = find(all, target.name);
  if (!swept) {
    std::vector<std::string> names;
    for (const Quantity& q : all)
      if (!is_fixed(q.value)) names.push_back(q.name);
    return fmt::format("{} is nothing that every sample of this study draws ({}): name one of {}", target.name,
                       nearest(target.name, names).empty() ? "not known" : hint(target.name, names), joined(names));
  }
  if (is_fixed(swept->value))
    return fmt::format("{} is {} in every sample (no other value can be made of them): sweep it, or remove the target",
                       target.name, to_string(swept->value));
  if (is_fixed(target.value))
    return fmt::format("the target of {} is one number (hardly any sample has just it): give a distribution",
                       target.name);
  if (std::holds_alternative<Choice>(swept->value) != std::holds_alternative<Choice>(target.value))
    return fmt::format(
        "{} was swept as {} and is wanted as {} (values of a list and of a range do not meet): give both "
        "alike",
        target.name, to_string(swept->value), to_string(target.value));
  const double share = outside(swept->value, target.value);
  if (share > adequate)
    return fmt::format(
        "{:.1f} % of the target of {} lie where nothing was swept ({}; probabilities would be wrong by as "
        "much, and adequate is {}): cut it with min and max, or sweep more",
        100 * share, target.name, to_string(swept->value), adequate);
  const std::vector<double> r = ratios(swept->value, target.value);
  const double most = *std::max_element(r.begin(), r.end());
  if (most > adequate * Target::cells && !std::holds_alternative<Choice>(swept->value))
    return fmt::format(
        "hardly any sample lies where the target of {} does (it was swept as {}; {:.2g} of a million would stay): "
        "sweep "
        "more there",
        target.name, to_string(swept->value), 1e6 / most);
  return "";
}

}  // namespace

Target::Target(const Study& study) : seed_(study.seed) {
  const std::vector<Quantity> all = targetable(study);
  for (const Quantity& target : study.fragility.target) {
    const Quantity& of = *find(all, target.name);
    const Distribution& swept = of.value;
    Part part{sampling::Stream(study.plan(), of.stream()), swept, ratios(swept, target.value),
              fmt::format("{} is {}", target.name, to_string(target.value))};
    part.outside = outside(swept, target.value);
    const double most = *std::max_element(part.stays.begin(), part.stays.end());
    for (double& r : part.stays) r /= most;
    part.share = (1 - part.outside) / most;
    parts_.push_back(std::move(part));
  }
}

bool Target::keeps(std::uint64_t sample) const {
  double stays = 1;
  for (const Part& part : parts_) {
    const double u = part.stream(sample);
    const auto* list = std::get_if<Choice>(&part.swept);
    stays *= part.stays[list ? sampling::pick(list->values.size(), list->weights, u)
                             : std::min(static_cast<std::size_t>(u * cells), cells - 1)];
  }
  return parts_.empty() || random::uniform(seed_, sample, random::stable_hash("fragility/target")) < stays;
}

double Target::kept_share() const {
  return std::accumulate(parts_.begin(), parts_.end(), 1.0,
                         [](double share, const Part& p) { return share * p.share; });
}

std::string Target::told() const {
  if (empty()) return "";
  std::string text = fmt::format("target: {:.3g} % of the samples stay, so that", 100 * kept_share());
  for (const Part& part : parts_) {
    text += fmt::format("{} {}", &part == &parts_.front() ? "" : " and", part.wanted);
    if (part.outside > 0) text += fmt::format(" ({:.2g} % of it lie where nothing was swept)", 100 * part.outside);
  }
  return text;
}

std::string target_told(const Study& study) {
  std::string text;
  for (const Quantity& target : study.fragility.target)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", target.name, to_string(target.value));
  return text.empty() ? "" : fmt::format("curves are those of the target ({}), not of the mix that was swept", text);
}

void check_target(const Study& study, Problems& problems) {
  const std::vector<Quantity> all = targetable(study);
  for (const Quantity& target : study.fragility.target)
    if (const std::string text = wrong(target, all, study.fragility.adequate); !text.empty())
      problems.add(target.line, text);
}

}  // namespace freestand::study
