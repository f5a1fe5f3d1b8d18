#include "study/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/shown_text.hpp"

namespace freestand::study {
namespace {

using sampling::number_text;

std::optional<std::uint64_t> integer_of(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  // 2e5 and the like.
  const auto real = number_of(text);
  if (!real || *real < 0 || *real != std::floor(*real) || *real > 9007199254740992.0) return {};
  return static_cast<std::uint64_t>(*real);
}

const char* kind_of(const YAML::Node& node) {
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return "a list";
  if (node.IsNull()) return "empty";
  return "a single value";
}

}  // namespace

int line_of(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

bool lacks_braces(const YAML::Node& list, const std::string& where, int line, Problems& problems) {
  std::vector<std::string> keys, pairs;
  for (const auto& entry : list) {
    if (!entry.IsMap() || entry.size() != 1 || !entry.begin()->first.IsScalar()) return false;
    keys.push_back(entry.begin()->first.Scalar());
    pairs.push_back(keys.back() + ": ...");
  }
  std::sort(keys.begin(), keys.end());
  if (keys.size() < 2 || std::adjacent_find(keys.begin(), keys.end()) != keys.end()) return false;
  problems.add(line_of(list[0]) ? line_of(list[0]) : line,
               fmt::format("{} has {} items of one key each (the keys of one item stand in braces): write [{{{}}}]",
                           where, keys.size(), shown(fmt::format("{}", fmt::join(pairs, ", ")), 200)));
  return true;
}

std::optional<double> number_of(const std::string& text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || first == last || !std::isfinite(value)) return {};
  return value;
}

Section::Section(const YAML::Node& node, std::string path, int line, Problems& problems)
    : path_(std::move(path)), line_(line), problems_(problems) {
  if (!node.IsMap()) {
    problems_.add(line_, fmt::format("{} is {} (keys with values are needed here): write \"key: value\" lines",
                                     path_.empty() ? "the file" : path_, kind_of(node)));
    return;
  }
  for (const auto& pair : node) {
    const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
    const int key_line = std::max(line_of(pair.first), 1);
    if (key.empty())
      problems_.add(key_line, "a key is not a word (keys are plain names): correct it");
    else if (item(key))
      problems_.add(key_line, fmt::format("key {} stands twice (first on line {}): remove one", shown(name(key)),
                                          item(key)->line));
    else
      items_.push_back({key, key_line, pair.second});
  }
}

const Section::Item* Section::item(const std::string& key) const {
  const auto found = std::find_if(items_.begin(), items_.end(), [&](const Item& i) { return i.key == key; });
  return found == items_.end() ? nullptr : &*found;
}

const YAML::Node* Section::find(const std::string& key) {
  const bool first_time = std::find(known_.begin(), known_.end(), key) == known_.end();
  if (first_time) known_.push_back(key);
  const Item* found = item(key);
  if (!found) return nullptr;
  if (!found->value.IsNull()) return &found->value;
  if (first_time)
    problem(key, name(key) + " has no value (nothing stands behind the colon): give one or remove the key");
  return nullptr;
}

bool Section::has(const std::string& key) const { return item(key) != nullptr; }

int Section::line(const std::string& key) const {
  const Item* found = item(key);
  return found ? found->line : line_;
}

namespace {
// A scalar in quotes, anything else by its kind.
std::string as_written(const YAML::Node& node) {
  return node.IsScalar() ? fmt::format("\"{}\"", shown(node.Scalar())) : kind_of(node);
}
}  // namespace

std::optional<double> Section::optional_number(const std::string& key, const Range& range) {
  const YAML::Node* node = find(key);
  if (!node) return {};
  const auto value = node->IsScalar() ? number_of(node->Scalar()) : std::nullopt;
  if (!value) {
    problem(key, fmt::format("{} is {} (one number is needed): give a number", name(key), as_written(*node)));
    return {};
  }
  check_range(sampling::Fixed{*value}, range, name(key), line(key), problems_);
  return value;
}

double Section::number(const std::string& key, double fallback, const Range& range) {
  return optional_number(key, range).value_or(fallback);
}

std::uint64_t Section::integer(const std::string& key, std::uint64_t fallback, std::uint64_t least,
                               std::uint64_t greatest) {
  const YAML::Node* node = find(key);
  if (!node) return fallback;
  const auto value = integer_of(node->IsScalar() ? node->Scalar() : "");
  if (value && *value >= least && *value <= greatest) return *value;
  const std::string given = node->IsScalar() ? shown(node->Scalar()) : kind_of(*node);
  const bool too_many = value.value_or(0) > greatest;
  const std::string wanted = !too_many && greatest > 1000000
                                 ? fmt::format("a whole number of at least {}", least)
                                 : fmt::format("a whole number from {} to {}", least, greatest);
  problem(key, fmt::format("{} is {} ({} is needed): correct it", name(key), given, wanted));
  return fallback;
}

bool Section::flag(const std::string& key, bool fallback) {
  return choice(key, {"false", "true"}, fallback ? 1 : 0) == 1;
}

std::string Section::text(const std::string& key, const std::string& fallback) {
  const YAML::Node* node = find(key);
  if (!node) return fallback;
  if (node->IsScalar() && !node->Scalar().empty()) {
    // Names go to the terminal, into pictures and into files that are UTF-8.
    if (printable(node->Scalar(), Lines::keep) == node->Scalar()) return node->Scalar();
    problem(key, fmt::format("{} is \"{}\" (it holds characters that no terminal shows): write it in plain text",
                             name(key), shown(node->Scalar())));
    return fallback;
  }
  problem(key, fmt::format("{} is {} (one word or text is needed): correct it", name(key),
                           node->IsScalar() ? "an empty text" : kind_of(*node)));
  return fallback;
}

std::vector<double> Section::numbers(const std::string& key) {
  const YAML::Node* node = find(key);
  if (!node) return {};
  std::vector<double> values;
  if (!node->IsSequence()) {
    problem(key, fmt::format("{} is {} (a list of numbers is needed): write [1, 2, 3]", name(key), kind_of(*node)));
    return {};
  }
  for (const auto& entry : *node) {
    const auto value = entry.IsScalar() ? number_of(entry.Scalar()) : std::nullopt;
    if (value)
      values.push_back(*value);
    else
      problem(key, fmt::format("{} holds {} (numbers only): correct it", name(key), as_written(entry)));
  }
  return values;
}

std::size_t Section::choice(const std::string& key, const std::vector<std::string>& choices, std::size_t fallback) {
  const YAML::Node* node = find(key);
  if (!node) return fallback;
  const std::string word = node->IsScalar() ? node->Scalar() : kind_of(*node);
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  problem(key,
          fmt::format("{} is {} ({}): choose one of {}", name(key), shown(word),
                      nearest(word, choices).empty() ? "not known" : "did you mean " + nearest(word, choices) + "?",
                      joined(choices)));
  return fallback;
}

std::optional<Quantity> Section::quantity(const std::string& prefix, const std::string& key, const Range& range) {
  const YAML::Node* node = find(key);
  if (!node) return {};
  const auto value = read_distribution(*node, name(key), line(key), problems_);
  if (!value) return {};
  check_range(*value, range, name(key), line(key), problems_);
  return Quantity{prefix + "." + key, unit_of(key), *value, line(key)};
}

Quantity Section::quantity(const std::string& prefix, const std::string& key, const Range& range, double fallback) {
  return quantity(prefix, key, range).value_or(Quantity{prefix + "." + key, unit_of(key), sampling::Fixed{fallback}});
}

void Section::finish() {
  for (const auto& [key, line, value] : items_)
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) problems_.add(line, unknown_key(key));
}

// Keys that people write in another place than they belong, or that a plane model has none of.
std::string Section::elsewhere(const std::string& key) const {
  const auto is_one_of = [&](std::initializer_list<const char*> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  const auto knows = [&](const char* part) { return std::find(known_.begin(), known_.end(), part) != known_.end(); };
  if (is_one_of({"depth_m", "length_m", "thickness_m"}) && (knows("width_m") || knows("block")))
    return fmt::format(
        "key {} is not needed (the model is plane: width_m is the side along the shaking, and across it nothing "
        "happens): remove it; for shaking along that side write it as width_m",
        key);
  const auto put_under = [&](const char* part) {
    return fmt::format("key {} stands beside {}: (it is a part of it): put it under it, {}: {{{}: ...}}", key, part,
                       part, key);
  };
  if (knows("block") && is_one_of({"width_m", "height_m", "mass_kg", "slenderness_rad", "size_m"}))
    return put_under("block");
  if (knows("friction") && is_one_of({"mu", "mu_k", "mu_s", "static_ratio"})) return put_under("friction");
  return "";
}

std::string Section::unknown_key(const std::string& whole) const {
  const std::string key = shown(whole);
  const std::string where = path_.empty() ? "" : " in " + path_;
  for (const auto& known : known_) {
    if (without_unit(known) == known) continue;
    if (without_unit(known) == key)
      return fmt::format("key {}{} has no unit (every key with a dimension carries its own): write {}", key, where,
                         known);
    if (without_unit(known) == without_unit(key))
      return fmt::format("key {}{} has another unit (freestand reads SI, here {}): convert the value and write {}", key,
                         where, unit_of(known), known);
  }
  if (const std::string told = elsewhere(key); !told.empty()) return told;
  const std::string near = nearest(key, known_);
  if (!near.empty()) return fmt::format("unknown key {}{} (did you mean {}?): correct or remove it", key, where, near);
  return fmt::format("unknown key {}{} (nothing reads it): remove it, or use one of {}", key, where, joined(known_));
}

void both_given(Section& section, const std::string& one, const std::string& other, const char* why) {
  section.problem(
      other, fmt::format("{} and {} are both given ({}): remove one", section.name(one), section.name(other), why));
}

void missing_key(Section& section, const std::string& key, const std::string& to_add) {
  section.problem(key,
                  fmt::format("{} is missing (the study cannot do without it): add {}", section.name(key), to_add));
}

}  // namespace freestand::study
