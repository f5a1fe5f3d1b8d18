#include "database/query.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <map>
#include <set>

#include "base/key_names.hpp"
#include "base/shown_text.hpp"
#include "database/grid.hpp"

namespace freestand::database {
namespace {

std::string names_of(const std::vector<Word>& words) {
  std::vector<std::string> names;
  for (const Word& word : words) names.push_back(word.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// "mu 0.2 (did you mean ...)": an unknown word, with the choices.
Error not_there(const std::string& what, const std::string& word, const std::vector<std::string>& choices) {
  if (choices.empty()) return Error(fmt::format("no entry of the database has a {}: leave it out", what));
  const std::string near = nearest(word, choices);
  constexpr std::size_t most = 24;
  const std::vector<std::string> some(choices.begin(),
                                      choices.begin() + static_cast<std::ptrdiff_t>(std::min(most, choices.size())));
  return Error(fmt::format("{} \"{}\" is not in the database ({}): choose one of {}{}", what, shown(word),
                           near.empty() ? "nothing like it is there" : "did you mean " + near + "?",
                           fmt::join(some, ", "), choices.size() > most ? " ..." : ""));
}

const Word& find_word(const std::vector<Word>& words, const std::string& what, const std::string& name) {
  for (const Word& word : words)
    if (word.name == name) return word;
  std::vector<std::string> names;
  for (const Word& word : words) names.push_back(word.name);
  if (name.empty()) throw Error(fmt::format("no {} is given (which one?): choose one of {}", what, names_of(words)));
  throw not_there(what, name, names);
}

using TextOf = std::string Entry::*;

void keep(std::vector<std::size_t>& positions, const Database& db, const std::string& what,
          const std::optional<std::string>& wanted, TextOf text) {
  if (!wanted) return;
  std::vector<std::string> choices;
  std::vector<std::size_t> kept;
  for (const std::size_t i : positions) {
    const std::string& word = db.entries[i].*text;
    if (std::find(choices.begin(), choices.end(), word) == choices.end()) choices.push_back(word);
    if (word == *wanted) kept.push_back(i);
  }
  if (kept.empty()) throw not_there(what, *wanted, choices);
  positions = std::move(kept);
}

// Capacities that an entry has of a demand at an intensity measure: position in Database::curves by capacity.
std::map<double, std::size_t> curves_of(const Database& db, std::size_t entry, const Question& question) {
  std::map<double, std::size_t> found;
  for (std::size_t i = 0; i < db.curves.size(); ++i) {
    const Curve& curve = db.curves[i];
    if (curve.entry == entry && curve.im == question.im && curve.demand == question.demand) found[curve.capacity] = i;
  }
  if (found.empty())
    throw Error(
        fmt::format("entry {} has no {} over {} (it was built without it): choose another, or add it to the "
                    "catalogue and build again",
                    db.entries[entry].id, question.demand, question.im));
  return found;
}

// One entry at the capacity asked for: the curve itself, or its two neighbours in capacity.
struct Between {
  std::vector<const Curve*> curves;
  std::vector<double> weights;
};

Between capacity_of(const Database& db, std::size_t entry, const Question& question, bool binary) {
  const auto found = curves_of(db, entry, question);
  const auto curve = [&](auto position) { return &db.curves[position->second]; };
  if (binary) return {{curve(found.begin())}, {1}};
  const double wanted = question.capacity;
  const auto same = std::find_if(found.begin(), found.end(),
                                 [&](const auto& c) { return std::abs(c.first / wanted - 1) < same_number; });
  if (same != found.end()) return {{curve(same)}, {1}};
  const auto next = found.upper_bound(wanted);
  if (next == found.begin() || next == found.end())
    throw Error(
        fmt::format("capacity {} of {} is outside of what {} has ({} to {}): ask within, or add it to the "
                    "catalogue and build again",
                    wanted, question.demand, db.entries[entry].id, found.begin()->first, found.rbegin()->first));
  const auto before = std::prev(next);
  const double t = std::log(wanted / before->first) / std::log(next->first / before->first);
  return {{curve(before), curve(next)}, {1 - t, t}};
}

// Intensities of the answer: the one asked for, or those of all its curves that lie within what each of them was swept over.
std::vector<double> intensities(const Question& question, const std::vector<Between>& parts) {
  if (std::isfinite(question.im_value)) return {question.im_value};
  double least = 0, most = std::numeric_limits<double>::infinity();
  std::set<double> all;
  for (const Between& part : parts)
    for (const Curve* curve : part.curves) {
      least = std::max(least, curve->im_least);
      most = std::min(most, curve->im_most);
      for (const Point& point : curve->points)
        if (std::isfinite(point.probability) && point.im > 0) all.insert(point.im);
    }
  std::vector<double> inside;
  for (const double im : all)
    if (im >= least && im <= most) inside.push_back(im);
  return inside;
}

// Refuses an intensity that is far outside, and says so of one that is outside.
void check_intensity(const Database& db, const Question& question, const std::vector<Between>& parts,
                     std::vector<std::string>& notes) {
  const double im = question.im_value;
  if (!std::isfinite(im)) return;
  const std::string unit = find_word(db.intensities, "intensity", question.im).unit;
  for (const Between& part : parts)
    for (const Curve* curve : part.curves) {
      if (!outside(*curve, im)) continue;
      const std::string swept =
          fmt::format("{} was swept over {} from {:.3g} to {:.3g}{}", db.entries[curve->entry].id, question.im,
                      curve->im_least, curve->im_most, unit == "1" ? "" : " " + unit);
      if (im * intensity_reach < curve->im_least || im > intensity_reach * curve->im_most)
        throw Error(
            fmt::format("{} = {} is too far outside ({}): ask up to a factor of {} beyond that, or sweep further",
                        question.im, im, swept, intensity_reach));
      const std::string note = fmt::format("extrapolated: {} = {} is outside ({})", question.im, im, swept);
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
}

// Of curves that are read by lines, the points on both sides of the intensity that lie farthest apart, where P changes from one to the other
// by more than the band there is wide: the samples' errors are in it, and not what P does between two points. Empty: nowhere.
std::string between_points(const std::vector<Between>& parts, double im) {
  std::string text;
  double most = 0;
  for (const Between& part : parts)
    for (const Curve* curve : part.curves) {
      const auto next = std::ranges::find_if(curve->points, [&](const Point& point) { return point.im >= im; });
      if (by_lognormal(*curve) || next == curve->points.begin() || next == curve->points.end()) continue;
      const Point &a = *std::prev(next), &b = *next;
      const Probability here = at(*curve, im);
      const double change = std::abs(b.probability - a.probability);
      if (!(change > here.upper - here.lower && change > most)) continue;
      most = change;
      text = fmt::format(
          "from {:.3g} to {:.3g} {} from {:.2g} to {:.2g}, and what it does between them no band holds", a.im, b.im,
          parts.size() > 1 || part.curves.size() > 1 ? "one of the curves that this is drawn from goes" : "it goes",
          a.probability, b.probability);
    }
  return text;
}

// Where none of the curves tells at which intensity such a probability comes (Probability::none_tells).
std::string untold(const Database& db, const std::vector<Between>& parts) {
  std::set<std::string> still;
  for (const Between& part : parts)
    for (const Curve* curve : part.curves)
      if (std::ranges::all_of(curve->points, [](const Point& point) { return !(point.probability > 0); }))
        still.insert(db.entries[curve->entry].id);
  if (still.empty())
    return "not every curve that this is drawn from comes to such a probability in its sweep: between them none tells "
           "where it comes, and the band holds both";
  return fmt::format(
      "{} never exceeds that in its sweep: where this begins between it and the others none of them tells, and the "
      "band holds both; add an entry between them, and build again",
      fmt::join(still, ", "));
}

constexpr std::int64_t few_motions = 10;  // as `run` warns

std::string rule(const std::vector<Between>& parts) {
  std::size_t all = 0, lognormal = 0;
  for (const Between& part : parts)
    for (const Curve* curve : part.curves) {
      ++all;
      if (by_lognormal(*curve)) ++lognormal;
    }
  std::string text = lognormal == all ? "read by the lognormal, which is adequate"
                     : lognormal == 0
                         ? "read by straight lines between the points over the intensity, as exports by levels are"
                         : "read by the lognormal where it is adequate, else by straight lines between the points";
  if (all > 1)
    text +=
        "; between entries and capacities by logarithms of the intensities at which P is the same, whose error no band "
        "holds";
  return text;
}

Answer answer(const Database& db, const Question& question, bool binary, GridPoint point) {
  Answer answer{.parts = {}, .im = {}, .probability = {}, .notes = std::move(point.notes), .rule = {}, .between = {}};
  std::vector<Between> parts;
  Between all;
  for (const Part& part : point.parts) {
    parts.push_back(capacity_of(db, part.entry, question, binary));
    for (std::size_t i = 0; i < parts.back().curves.size(); ++i) {
      all.curves.push_back(parts.back().curves[i]);
      all.weights.push_back(part.weight * parts.back().weights[i]);
    }
  }
  const std::size_t notes = answer.notes.size();
  check_intensity(db, question, parts, answer.notes);
  answer.extrapolated = point.extrapolated || answer.notes.size() > notes;
  answer.im = intensities(question, parts);
  for (const double im : answer.im) {
    answer.probability.push_back(between(all.curves, all.weights, im));
    Probability& p = answer.probability.back();
    p.lower = std::min(p.lower, p.value);
    p.upper = std::max(p.upper, p.value);
  }
  if (std::ranges::any_of(answer.probability, &Probability::none_tells)) answer.notes.push_back(untold(db, parts));
  std::int64_t motions = std::numeric_limits<std::int64_t>::max();
  for (const Part& part : point.parts) motions = std::min(motions, db.entries[part.entry].motions);
  if (motions > 0 && motions < few_motions)
    answer.notes.push_back(fmt::format(
        "the band rests on {} motion{}: {}", motions, motions == 1 ? "" : "s",
        motions == 1 ? "it says nothing of how much others would differ" : "what resampling so few tells is rough"));
  answer.rule = rule(parts);
  answer.between = between_points(parts, question.im_value);
  answer.parts = std::move(point.parts);
  if (parts.size() == 1 && parts[0].curves.size() == 1 && by_lognormal(*parts[0].curves[0])) {
    answer.median = parts[0].curves[0]->median;
    answer.dispersion = parts[0].curves[0]->dispersion;
  }
  return answer;
}

}  // namespace

std::vector<std::size_t> picked(const Database& db, const Question& question) {
  std::vector<std::size_t> positions(db.entries.size());
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = i;
  keep(positions, db, "class", question.equipment, &Entry::equipment);
  keep(positions, db, "id", question.id, &Entry::id);
  keep(positions, db, "floor", question.floor, &Entry::floor);
  keep(positions, db, "friction", question.friction, &Entry::friction);
  return positions;
}

Database part_of(const Database& db, const std::vector<std::size_t>& entries) {
  Database part{.name = db.name,
                .revision = db.revision,
                .confidence = db.confidence,
                .intensities = db.intensities,
                .demands = db.demands,
                .classes = db.classes};
  for (const std::size_t i : entries) {
    for (const Curve& curve : db.curves) {
      if (curve.entry != i) continue;
      part.curves.push_back(curve);
      part.curves.back().entry = part.entries.size();
    }
    part.entries.push_back(db.entries[i]);
  }
  const auto absent = [&](std::string Curve::*member) {
    return [&part, member](const Word& word) {
      return std::ranges::none_of(part.curves, [&](const Curve& curve) { return curve.*member == word.name; });
    };
  };
  std::erase_if(part.intensities, absent(&Curve::im));
  std::erase_if(part.demands, absent(&Curve::demand));
  return part;
}

std::vector<Answer> ask(const Database& db, const Question& question) {
  find_word(db.intensities, "intensity", question.im);
  const Word& demand = find_word(db.demands, "demand", question.demand);
  if (!std::isnan(question.im_value) && !(question.im_value > 0 && std::isfinite(question.im_value)))
    throw Error(
        fmt::format("{} = {} is no intensity (it must be above zero): correct it", question.im, question.im_value));
  if (demand.binary && !std::isnan(question.capacity))
    throw Error(fmt::format("{} takes no capacity (it happens or not): leave --capacity out", demand.name));
  if (!demand.binary && !(question.capacity > 0))
    throw Error(
        fmt::format("no capacity of {} is given (its probability is that of going beyond one): add --capacity, "
                    "above zero",
                    demand.name));
  std::vector<Answer> answers;
  for (GridPoint& point : grid_points(db, picked(db, question), question.wanted))
    answers.push_back(answer(db, question, demand.binary, std::move(point)));
  return answers;
}

}  // namespace freestand::database
