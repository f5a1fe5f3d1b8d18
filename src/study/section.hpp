// One mapping of a study file, read key by key. What is wrong goes to Problems and reading goes on with the default, so
// that all problems are found in one pass.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "study/problems.hpp"
#include "study/study.hpp"

namespace freestand::study {

// Values that make sense for a number.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = true, upper_open = true;
  const char* why = "";  // "a size must be above zero"
};
namespace range {
inline constexpr Range any = {};
inline constexpr Range positive = {.lower = 0, .why = "it must be above zero"};
inline constexpr Range size = {.lower = 0, .why = "a size must be above zero"};
inline constexpr Range not_negative = {.lower = 0, .lower_open = false, .why = "it must not be negative"};
inline constexpr Range leaning = {.lower = -pi / 2, .upper = pi / 2, .why = "a block that leans further has fallen"};
inline constexpr Range fraction = {
    .lower = 0, .upper = 1, .lower_open = false, .upper_open = false, .why = "it must lie between 0 and 1"};
}  // namespace range

// Line of a node, 1 first; 0 where the parser does not know it.
int line_of(const YAML::Node&);

// Is a list of mappings written without their braces ("[pulse: B, period_s: 0.5]")? YAML reads an entry for each key: that
// is a problem at the entries' line.
bool lacks_braces(const YAML::Node& list, const std::string& where, int line, Problems&);

// Text of a scalar as a number; nothing unless all of it is one finite number.
std::optional<double> number_of(const std::string& text);

// A number or a distribution. `where`: dotted name for messages. Problems are added at `line`.
std::optional<sampling::Distribution> read_distribution(const YAML::Node&, const std::string& where, int line,
                                                        Problems&);

// A name, a list of names, or {choice: [...], weights: [...]}.
std::optional<sampling::Names> read_names(const YAML::Node&, const std::string& where, int line, Problems&);

// Adds a problem when the distribution can leave the range.
void check_range(const sampling::Distribution&, const Range&, const std::string& where, int line, Problems&);

class Section {
 public:
  // path: where the mapping stands, for messages ("block", "motions[1]"; "" for the file itself). A node that is no
  // mapping is a problem, and reads as an empty one.
  Section(const YAML::Node& node, std::string path, int line, Problems& problems);

  // Every key that is asked for counts as known. A key without a value counts as absent, and is a problem.
  const YAML::Node* find(const std::string& key);
  bool has(const std::string& key) const;
  int line(const std::string& key) const;  // of the key, or of the section where it is absent
  int line() const { return line_; }
  std::string name(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  Problems& problems() { return problems_; }
  void problem(const std::string& key, const std::string& text) { problems_.add(line(key), text); }

  // Readers: the value, or the default when the key is absent or wrong.
  double number(const std::string& key, double fallback, const Range& = range::any);
  std::optional<double> optional_number(const std::string& key, const Range& = range::any);
  std::uint64_t integer(const std::string& key, std::uint64_t fallback, std::uint64_t least,
                        std::uint64_t greatest = std::numeric_limits<std::int64_t>::max());
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::vector<double> numbers(const std::string& key);
  // Position of the word among the choices.
  std::size_t choice(const std::string& key, const std::vector<std::string>& choices, std::size_t fallback);
  // Quantity named prefix.key.
  std::optional<Quantity> quantity(const std::string& prefix, const std::string& key, const Range&);
  Quantity quantity(const std::string& prefix, const std::string& key, const Range&, double fallback);

  // Reports keys that nobody asked for, with what was probably meant. Call it last.
  void finish();

 private:
  struct Item {
    std::string key;
    int line;
    YAML::Node value;
  };
  const Item* item(const std::string& key) const;
  std::string unknown_key(const std::string& key) const;
  std::string elsewhere(const std::string& key) const;

  std::string path_;
  int line_;
  Problems& problems_;
  std::vector<Item> items_;
  std::vector<std::string> known_;
};

// Two keys of which one is enough; a key that a study cannot do without.
void both_given(Section&, const std::string& one, const std::string& other, const char* why);
void missing_key(Section&, const std::string& key, const std::string& to_add);

}  // namespace freestand::study
