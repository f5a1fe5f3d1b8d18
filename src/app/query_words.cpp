#include "app/query_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/digits.hpp"
#include "io/text_files.hpp"

namespace freestand::app {
namespace {

using database::Answer;
using database::Coordinate;
using database::Database;
using database::Entry;
using database::Question;
using database::Word;
using Entries = std::vector<Entry>;

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.6g}{}{}", value, unit == "1" ? "" : " ", unit == "1" ? "" : unit);
}

const Word& word_of(const std::vector<Word>& words, const std::string& name) {
  return *std::find_if(words.begin(), words.end(), [&](const Word& word) { return word.name == name; });
}

// "0.2 to 0.4", or "0.25" where all are the same.
std::string span(const Entries& entries, double Entry::*member) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Entry& entry : entries) {
    least = std::min(least, entry.*member);
    most = std::max(most, entry.*member);
  }
  return least == most ? fmt::format("{:.4g}", least) : fmt::format("{:.4g} to {:.4g}", least, most);
}

std::vector<std::string> names_in(const Entries& entries, std::string Entry::*member) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) {
    const std::string& name = entry.*member;
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

Entries of_class(const Entries& entries, const std::string& name) {
  Entries found;
  std::ranges::copy_if(entries, std::back_inserter(found), [&](const Entry& e) { return e.equipment == name; });
  return found;
}

std::vector<double> capacities(const Database& db, const std::string& demand) {
  std::set<double> all;
  for (const database::Curve& curve : db.curves)
    if (curve.demand == demand) all.insert(curve.capacity);
  return {all.begin(), all.end()};
}

// "pga_g  0.1 to 2 g": what was swept.
std::string swept(const Database& db, const Word& word) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const database::Curve& curve : db.curves)
    if (curve.im == word.name) {
      least = std::min(least, curve.im_least);
      most = std::max(most, curve.im_most);
    }
  return fmt::format("{} ({:.3g} to {})", word.name, least, with_unit(std::round(most * 1000) / 1000, word.unit));
}

std::string row(const std::string& name, const std::string& count, const std::string& mu, const std::string& width,
                const std::string& height) {
  return fmt::format("{:<34}{:<9}{:<16}{:<16}{}\n", name, count, mu, width, height);
}

std::string list_of_classes(const Entries& entries) {
  std::string text = row("class", "entries", "mu", "width_m", "height_m");
  for (const std::string& name : names_in(entries, &Entry::equipment)) {
    const Entries mine = of_class(entries, name);
    text += row(name, fmt::format("{}", mine.size()), span(mine, &Entry::mu_k), span(mine, &Entry::width_m),
                span(mine, &Entry::height_m));
  }
  return text;
}

std::string list_of_entries(const Entries& entries) {
  std::string text = row("id", "version", "mu", "width_m", "height_m");
  for (const Entry& entry : entries)
    text += row(entry.id, fmt::format("{}", entry.version), fmt::format("{:.4g}", entry.mu_k),
                fmt::format("{:.4g}", entry.width_m), fmt::format("{:.4g}", entry.height_m));
  return text;
}

// Names of the entries of an answer: "fridge_vinyl", or "between fridge_a (0.61), fridge_b (0.39)" with their weights.
std::string origin(const Database& db, const Answer& answer) {
  if (answer.parts.size() == 1) return db.entries[answer.parts[0].entry].id;
  std::vector<std::string> texts;
  for (const auto& [entry, weight] : answer.parts)
    texts.push_back(fmt::format("{} ({:.2f})", db.entries[entry].id, weight));
  return fmt::format("between {}", fmt::join(texts, ", "));
}

std::string probability(const database::Probability& p) {
  return fmt::format("{:.4f}  [{:.4f}, {:.4f}]", p.value, p.lower, p.upper);
}

std::string event(const Database& db, const Question& question) {
  const Word& demand = word_of(db.demands, question.demand);
  return demand.binary ? demand.name : fmt::format("{} > {}", demand.name, with_unit(question.capacity, demand.unit));
}

nlohmann::ordered_json number(double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr; }

}  // namespace

std::string example(const Database& db, const std::string& folder) {
  const Word& demand = db.demands.front();
  const Word& im = db.intensities.front();
  const auto curve = std::find_if(db.curves.begin(), db.curves.end(),
                                  [&](const database::Curve& c) { return c.demand == demand.name && c.im == im.name; });
  const std::string capacity = demand.binary ? "" : fmt::format(" --capacity {}", curve->capacity);
  return fmt::format("freestand query {} --class '{}' --im {}={:.2g} --demand {}{}", folder,
                     db.entries.front().equipment, im.name, std::sqrt(curve->im_least * curve->im_most), demand.name,
                     capacity);
}

std::string contents(const Database& db, const std::string& folder) {
  std::string text = fmt::format("{}, revision {}: {} entries\n", db.name, db.revision, db.entries.size());
  const std::vector<std::string> classes = names_in(db.entries, &Entry::equipment);
  text += classes.size() == 1 ? list_of_entries(db.entries) : list_of_classes(db.entries);
  for (const auto& [what, member] : {std::pair("floors", &Entry::floor), std::pair("frictions", &Entry::friction)})
    if (const auto names = names_in(db.entries, member); !names.empty())
      text += fmt::format("{:<12} {}\n", what, fmt::join(names, ", "));
  std::vector<std::string> texts;
  for (const Word& word : db.intensities) texts.push_back(swept(db, word));
  text += fmt::format("{:<12} {}\n", "intensities", fmt::join(texts, ", "));
  texts.clear();
  for (const Word& word : db.demands)
    texts.push_back(word.binary ? word.name
                                : fmt::format("{} > {}{}", word.name, fmt::join(capacities(db, word.name), ", "),
                                              word.unit == "1" ? "" : " " + word.unit));
  text += fmt::format("{:<12} {}\n", "demands", fmt::join(texts, "; "));
  return text + fmt::format("{:<12} {}\n", "ask", example(db, folder));
}

std::string contents_json(const Database& db) {
  nlohmann::ordered_json json{
      {"format", "freestand-query/1"}, {"name", db.name}, {"revision", db.revision}, {"confidence", db.confidence}};
  const auto words = [](const std::vector<Word>& all) {
    auto list = nlohmann::ordered_json::array();
    for (const Word& w : all)
      list.push_back({{"name", w.name}, {"unit", w.unit}, {"symbol", w.symbol}, {"summary", w.summary}});
    return list;
  };
  json["intensities"] = words(db.intensities);
  json["demands"] = words(db.demands);
  for (std::size_t i = 0; i < db.demands.size(); ++i)
    json["demands"][i]["capacities"] =
        db.demands[i].binary ? std::vector<double>{} : capacities(db, db.demands[i].name);
  json["entries"] = nlohmann::ordered_json::array();
  for (const Entry& e : db.entries)
    json["entries"].push_back({{"id", e.id},
                               {"class", e.equipment},
                               {"floor", e.floor},
                               {"friction", e.friction},
                               {"mu_k", number(e.mu_k)},
                               {"width_m", number(e.width_m)},
                               {"height_m", number(e.height_m)},
                               {"version", e.version},
                               {"samples", e.samples}});
  return io::json_text(json);
}

std::string answers_text(const Database& db, const Question& question, const std::vector<Answer>& answers) {
  const Word& im = word_of(db.intensities, question.im);
  const bool curve = !std::isfinite(question.im_value);
  std::string text = fmt::format("P({} | {}{}), with its {:g} % band\n", event(db, question), im.name,
                                 curve ? "" : " = " + with_unit(question.im_value, im.unit), 100 * db.confidence);
  const bool one_rule = !answers.empty() && std::all_of(answers.begin(), answers.end(), [&](const Answer& answer) {
    return answer.rule == answers.front().rule;
  });
  for (const Answer& answer : answers) {
    if (curve) {
      text += origin(db, answer) + "\n";
      for (std::size_t i = 0; i < answer.im.size(); ++i)
        text += fmt::format("  {:>10.4g}  {}\n", answer.im[i], probability(answer.probability[i]));
    } else {
      text += fmt::format("{}  {}\n", probability(answer.probability.front()), origin(db, answer));
    }
    if (std::isfinite(answer.median))
      text += fmt::format("  lognormal of median {} and dispersion {}\n",
                          with_unit(std::stod(three_digits(answer.median)), im.unit), three_digits(answer.dispersion));
    for (const std::string& note : answer.notes) text += "  " + note + "\n";
    if (!answer.between.empty()) text += "  " + answer.between + "\n";
    if (!one_rule) text += "  " + answer.rule + "\n";
  }
  return text + (one_rule ? answers.front().rule + "\n" : "");
}

std::string answers_json(const Database& db, const Question& question, const std::vector<Answer>& answers) {
  const Word& im = word_of(db.intensities, question.im);
  const Word& demand = word_of(db.demands, question.demand);
  nlohmann::ordered_json json{
      {"format", "freestand-query/1"}, {"intensity", im.name},
      {"intensity_unit", im.unit},     {"demand", demand.name},
      {"demand_unit", demand.unit},    {"capacity", demand.binary ? nullptr : number(question.capacity)},
      {"confidence", db.confidence}};
  json["answers"] = nlohmann::ordered_json::array();
  for (const Answer& answer : answers) {
    nlohmann::ordered_json one;
    for (const auto& [entry, weight] : answer.parts)
      one["entries"].push_back({{"id", db.entries[entry].id}, {"weight", weight}});
    for (std::size_t i = 0; i < answer.im.size(); ++i) {
      const database::Probability& p = answer.probability[i];
      one["im"].push_back(answer.im[i]);
      one["probability"].push_back(number(p.value));
      one["lower"].push_back(number(p.lower));
      one["upper"].push_back(number(p.upper));
    }
    one["extrapolated"] = answer.extrapolated;
    one["notes"] = answer.notes;
    one["rule"] = answer.rule;
    one["between_points"] = answer.between;
    one["median"] = number(answer.median);
    one["dispersion"] = number(answer.dispersion);
    json["answers"].push_back(std::move(one));
  }
  return io::json_text(json);
}

}  // namespace freestand::app
