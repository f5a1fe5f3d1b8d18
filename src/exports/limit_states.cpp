#include "exports/limit_states.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"

namespace freestand::exports {
namespace {

using fragility::EdpResult;
using fragility::Result;

const EdpResult& demand_named(const Result& result, const std::string& name) {
  std::vector<std::string> known;
  for (const EdpResult& edp : result.edps) {
    if (edp.name == name) return edp;
    known.push_back(edp.name);
  }
  throw Error(fmt::format("demand {} is not in these results (they hold {}): name one of these", shown(name),
                          fmt::join(known, ", ")));
}

std::size_t capacity_of(const EdpResult& edp, const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw Error(fmt::format("capacity {} of {} is no number: write for example {}:{}", shown(text), edp.name, edp.name,
                            edp.capacity.empty() ? 0.1 : edp.capacity.front()));
  for (std::size_t k = 0; k < edp.capacity.size(); ++k)
    if (std::fabs(edp.capacity[k] - value) <= 1e-9 * std::fabs(value)) return k;
  throw Error(fmt::format("{} has no capacity {} (it has {}): name one of these, or fit again with the one you want",
                          edp.name, value, fmt::join(edp.capacity, ", ")));
}

bool is_name(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto inside = [&](char c) { return letter(c) || (c >= '0' && c <= '9'); };
  return !text.empty() && letter(text.front()) && std::all_of(text.begin(), text.end(), inside);
}

void add(std::vector<Wanted>& found, const Result& result, const std::string& word) {
  const std::size_t equals = word.find('='), colon = word.substr(0, equals).find(':');
  const EdpResult& edp = demand_named(result, word.substr(0, std::min(equals, colon)));
  const std::string given = equals == std::string::npos ? "" : word.substr(equals + 1);
  if (equals != std::string::npos && !is_name(given))
    throw Error(
        fmt::format("limit state {} cannot have that name (letters, digits and _ only, no digit first): write "
                    "for example {}=falls",
                    shown(word), word.substr(0, equals)));
  if (colon != std::string::npos && edp.binary)
    throw Error(fmt::format("{} takes no capacity (it happens or not): write {}", edp.name, edp.name));
  std::size_t first = 0, end = edp.capacity.size();
  if (colon != std::string::npos) {
    first = capacity_of(edp, word.substr(colon + 1, equals == std::string::npos ? equals : equals - colon - 1));
    end = first + 1;
  }
  if (!given.empty() && end - first != 1)
    throw Error(fmt::format("{} gives one name to {} limit states: name the capacity too, as {}:{}={}", shown(word),
                            end - first, edp.name, edp.capacity.front(), given));
  for (std::size_t k = first; k < end; ++k) found.push_back({&edp, k, given.empty() ? state_name(edp, k) : given});
}

std::vector<std::string> every_demand(const Result& result) {
  std::vector<std::string> words;
  for (const EdpResult& edp : result.edps) words.push_back(edp.name);
  return words;
}

// States of one list, each within the one before it. A demand that happens or not and is named first (wall_hit) stands alone: a block
// that overturns need not have met it.
std::vector<std::string> usual_states(const Result& result) {
  std::vector<std::string> words;
  if (!result.edps.empty() && result.edps.front().binary && result.edps.front().name != "overturned")
    return {result.edps.front().name};
  const auto capacities = [](const EdpResult& edp) { return !edp.binary; };
  const auto first = std::find_if(result.edps.begin(), result.edps.end(), capacities);
  if (first != result.edps.end()) words.push_back(first->name);
  for (const EdpResult& edp : result.edps)
    if (edp.name == "overturned") words.push_back(edp.name);
  if (words.empty() && !result.edps.empty()) words.push_back(result.edps.front().name);
  return words;
}

}  // namespace

std::string state_name(const EdpResult& edp, std::size_t capacity) {
  std::string text = edp.binary ? edp.name : fmt::format("{}_over_{}", edp.name, edp.capacity[capacity]);
  for (char& c : text)
    if (c == '.')
      c = 'p';
    else if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return text;
}

std::vector<Wanted> wanted_states(const Result& result, const std::vector<std::string>& words, bool table) {
  std::vector<Wanted> found;
  for (const std::string& word : !words.empty() ? words : table ? every_demand(result) : usual_states(result))
    add(found, result, word);
  if (found.empty())
    throw Error("these results hold no demand (nothing was fitted): name some under fragility.edp and fit again",
                Exit::data);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (found[i].name == found[j].name)
        throw Error(
            fmt::format("limit state {} is there twice (names are what a target tells them apart by): leave one "
                        "out, or give it another name with =NAME",
                        found[i].name));
  return found;
}

}  // namespace freestand::exports
