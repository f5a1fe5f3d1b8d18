#include "study/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace freestand::study {

void Problems::add(int line, std::string text) {
  if (told_.emplace(line, text).second) entries_.push_back({line, std::move(text)});
}

void Problems::add(const Problems& more, int line, int end) {
  for (const auto& [there, text] : more.entries_) add(line > 0 && there < end ? line : there, text);
}

std::string Problems::text() const {
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) { return a.line < b.line; });
  std::string text;
  for (const auto& [line, problem] : sorted) {
    if (!text.empty()) text += '\n';
    text += line > 0 ? fmt::format("{}:{}: {}", file_, line, problem) : fmt::format("{}: {}", file_, problem);
  }
  return text;
}

void Problems::throw_if_any(Exit exit) const {
  if (!empty()) throw Error(text(), exit);
}

std::vector<std::string> told_once(const std::vector<Refusal>& refusals) {
  struct Told {
    std::string alike, first;
    std::vector<std::string> subjects;
  };
  std::vector<Told> all;
  for (const Refusal& refusal : refusals) {
    std::string alike = refusal.text;
    for (std::size_t at = 0; !refusal.subject.empty() && (at = alike.find(refusal.subject, at)) != std::string::npos;)
      alike.erase(at, refusal.subject.size());
    auto known = std::find_if(all.begin(), all.end(), [&](const Told& one) { return one.alike == alike; });
    if (known == all.end())
      known = all.insert(all.end(), {alike, (refusal.place.empty() ? "" : refusal.place + ": ") + refusal.text, {}});
    known->subjects.push_back(refusal.subject);
  }
  std::vector<std::string> lines;
  for (const Told& one : all) {
    const std::size_t more = one.subjects.size() - 1;
    std::vector<std::string> others(one.subjects.begin() + 1, one.subjects.end());
    lines.push_back(more == 0 ? one.first : fmt::format("{}; and the same of {}", one.first, some(others, 3)));
  }
  return lines;
}

std::string hint(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string near = nearest(word, candidates);
  return near.empty() ? "known: " + joined(candidates) : "did you mean " + near + "?";
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

std::string some(const std::vector<std::string>& words, std::size_t few) {
  if (words.size() <= few + 1) return joined(words);
  const std::vector<std::string> first(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(few));
  return fmt::format("{} and {} more", joined(first), words.size() - few);
}

}  // namespace freestand::study
