#include "study/edited_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "study/known.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

// Dotted key ("motions[0].period_s.uniform[1]") and text of every scalar, in the order of the file.
using Scalars = std::vector<std::pair<std::string, std::string>>;

void collect(const YAML::Node& node, const std::string& key, Scalars& out) {
  if (node.IsMap()) {
    for (const auto& entry : node)
      collect(entry.second, key.empty() ? entry.first.Scalar() : key + "." + entry.first.Scalar(), out);
  } else if (node.IsSequence()) {
    if (node.size() == 0) out.emplace_back(key, "[]");
    for (std::size_t i = 0; i < node.size(); ++i) collect(node[i], fmt::format("{}[{}]", key, i), out);
  } else {
    out.emplace_back(key, node.IsNull() ? "nothing" : node.Scalar());
  }
}

Scalars scalars_of(const Study& study) {
  Scalars all;
  collect(YAML::Load(expanded(study)), "", all);
  return all;
}

// "fragility.bins.count" -> "fragility.bins"
std::string second_level(const std::string& key) {
  const std::size_t end = key.find_first_of(".[", key.find('.') + 1);
  return key.substr(0, end);
}

// Line of the first key of the file on the way to a dotted key: of "friction.mu_k.uniform[1]" that of friction.mu_k, or
// else of friction; 0 where the file says nothing of it.
int line_of_key(const YAML::Node& root, const std::string& dotted) {
  const std::string first = dotted.substr(0, dotted.find_first_of(".[")), second = second_level(dotted);
  const auto entry_line = [](const YAML::Node& map, const std::string& key) {
    if (map.IsMap())
      for (const auto& entry : map)
        if (entry.first.Scalar() == key) return line_of(entry.first);
    return 0;
  };
  const int outer = entry_line(root, first);
  const int inner = outer && second.size() > first.size() && dotted[first.size()] == '.'
                        ? entry_line(root[first], second.substr(first.size() + 1))
                        : 0;
  return inner ? inner : outer;
}

}  // namespace

std::vector<Difference> differences(const Study& now, const Study& before) {
  const Scalars mine = scalars_of(now), theirs = scalars_of(before);
  const std::map<std::string, std::string> old(theirs.begin(), theirs.end()), fresh(mine.begin(), mine.end());
  std::vector<Difference> found;
  for (const auto& [key, value] : mine) {
    const auto other = old.find(key);
    if (key != "name" && (other == old.end() || other->second != value))
      found.push_back({key, value, other == old.end() ? "nothing" : other->second});
  }
  for (const auto& [key, value] : theirs)
    if (!fresh.contains(key)) found.push_back({key, "nothing", value});
  return found;
}

EditedStudy edited_study(const std::string& swept, const std::string& text, const std::filesystem::path& file) {
  const Study before = parse_stored(swept, file);
  EditedStudy edited{parse_stored(text, file), {}};
  Problems problems(file.string());
  for (const auto& [key, now, then] : differences(edited.study, before)) {
    if (key.starts_with("fragility.")) {
      edited.changed.push_back(second_level(key));
      continue;
    }
    problems.add(
        line_of_key(YAML::Load(text), key),
        fmt::format("{} is {}, and the samples were made with {} (only the fragility block can change after the "
                    "sweep): take it back, or run the study into another folder",
                    key, now, then));
    problems.throw_if_any();
  }
  std::sort(edited.changed.begin(), edited.changed.end());
  edited.changed.erase(std::unique(edited.changed.begin(), edited.changed.end()), edited.changed.end());
  return edited;
}

}  // namespace freestand::study
