#include "study/changed_keys.hpp"

#include <fmt/format.h>

#include <vector>

#include "base/shown_text.hpp"
#include "study/edited_study.hpp"

namespace freestand::study {

bool changes_samples(const std::string& key) {
  if (key == "name") return false;
  return !key.starts_with("fragility.");
}

std::string changes_told(const Study& now, const Study& before, Changes changes) {
  std::vector<Difference> changed = differences(now, before);
  if (changes == Changes::of_samples)
    std::erase_if(changed, [](const Difference& difference) { return !changes_samples(difference.key); });
  if (changed.empty()) return "";
  const auto& [key, is, was] = changed.front();
  const std::string more = changed.size() > 1 ? fmt::format("; and {} more", changed.size() - 1) : "";
  const auto value = [&name = key](const std::string& text) {
    return text == "nothing" && name == "keep" ? "all" : shown(text);  // which is not written out
  };
  return fmt::format("{} was {}, is {}{}", key, value(was), value(is), more);
}

}  // namespace freestand::study
