#include "database/grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <map>

namespace freestand::database {
namespace {

using Wanted = std::span<const std::optional<double>>;

bool same(double a, double b) { return a == b || std::abs(a - b) <= same_number * std::abs(b); }

std::string number(double value) { return fmt::format("{:.6g}", value); }

// All that parts entries, in words. Mass moves nothing in a free block; its chain, if there is one, stands in `model`.
std::string rest_of(const Entry& entry, Wanted wanted) {
  std::string key = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", entry.equipment, entry.floor, entry.shaking, entry.model,
                                entry.effects, entry.scatter);
  for (const Coordinate c : coordinates)
    if (!wanted[static_cast<std::size_t>(c)]) key += number(value(entry, c)) + "\n";
  if (!wanted[static_cast<std::size_t>(Coordinate::mu)]) key += entry.friction + "\n";
  return key + number(entry.mu_s / entry.mu_k);
}

// Values of one coordinate in a group, increasing.
std::vector<double> levels(const Database& db, const std::vector<std::size_t>& group, Coordinate c) {
  std::vector<double> all;
  for (const std::size_t i : group) all.push_back(value(db.entries[i], c));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

// One coordinate of a grid: the level itself, or the two around, or the two nearest.
struct Side {
  std::vector<double> level, weight;
  bool outside = false;
};

std::optional<Side> side_of(const std::vector<double>& levels, double wanted) {
  for (const double level : levels)
    if (same(level, wanted)) return Side{{level}, {1}};
  if (levels.size() < 2 || !(levels.front() > 0)) return {};
  const auto next = std::upper_bound(levels.begin(), levels.end(), wanted) - levels.begin();
  const auto right =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next, 1, static_cast<std::ptrdiff_t>(levels.size()) - 1));
  const double a = levels[right - 1], b = levels[right];
  const double t = std::log(wanted / a) / std::log(b / a);
  if (t < -coordinate_reach || t > 1 + coordinate_reach) return {};
  return Side{{a, b}, {1 - t, t}, t < 0 || t > 1};
}

// More than one differ in what nobody says of them: in their seeds, say.
std::vector<std::size_t> entries_at(const Database& db, const std::vector<std::size_t>& group,
                                    const std::vector<std::pair<Coordinate, double>>& place) {
  std::vector<std::size_t> there;
  for (const std::size_t i : group)
    if (std::all_of(place.begin(), place.end(),
                    [&](const auto& at) { return same(value(db.entries[i], at.first), at.second); }))
      there.push_back(i);
  return there;
}

// Sides of a group in the wanted coordinates, combined.
std::optional<GridPoint> point_in(const Database& db, const std::vector<std::size_t>& group, Wanted wanted) {
  using Place = std::vector<std::pair<Coordinate, double>>;
  std::vector<std::pair<Place, double>> corners{{{}, 1.0}};
  GridPoint point;
  for (const Coordinate c : coordinates) {
    const auto& at = wanted[static_cast<std::size_t>(c)];
    if (!at) continue;
    const std::vector<double> all = levels(db, group, c);
    const auto side = side_of(all, *at);
    if (!side) return {};
    if (side->outside) {
      point.extrapolated = true;
      point.notes.push_back(fmt::format("extrapolated: {} = {} is outside ({} from {} to {})", name(c), number(*at),
                                        db.entries[group.front()].equipment, number(all.front()), number(all.back())));
    }
    std::vector<std::pair<Place, double>> more;
    for (const auto& [place, weight] : corners)
      for (std::size_t k = 0; k < side->level.size(); ++k) {
        more.push_back({place, weight * side->weight[k]});
        more.back().first.push_back({c, side->level[k]});
      }
    corners = std::move(more);
  }
  for (const auto& [place, weight] : corners) {
    const std::vector<std::size_t> there = entries_at(db, group, place);
    if (there.empty()) return {};
    point.parts.push_back({there.front(), weight});
    for (std::size_t k = 1; k < there.size(); ++k)
      point.notes.push_back(fmt::format("{} is described as {} is, whose curves these are: name one by its id",
                                        db.entries[there[k]].id, db.entries[there[0]].id));
  }
  return point;
}

// What there is where no group reaches.
Error no_grid(const Database& db, const std::map<std::string, std::vector<std::size_t>>& groups, Wanted wanted) {
  std::string asked, there;
  for (const Coordinate c : coordinates)
    if (const auto& at = wanted[static_cast<std::size_t>(c)])
      asked += fmt::format("{}{} = {}", asked.empty() ? "" : ", ", name(c), number(*at));
  constexpr int most = 6;
  int count = 0;
  for (const auto& [key, group] : groups) {
    if (++count > most) break;
    std::vector<std::string> parts;
    for (const Coordinate c : coordinates) {
      if (!wanted[static_cast<std::size_t>(c)]) continue;
      std::vector<std::string> texts;
      for (const double level : levels(db, group, c)) texts.push_back(number(level));
      parts.push_back(fmt::format("{} {}", name(c), fmt::join(texts, " ")));
    }
    there += fmt::format("{}{}: {}", there.empty() ? "" : "; ", db.entries[group.front()].id, fmt::join(parts, ", "));
  }
  return Error(
      fmt::format("{} lies in no grid of entries (there is {}{}): ask at, between or a little beyond these, or add "
                  "entries to the catalogue",
                  asked, there, count > most ? " ..." : ""));
}

}  // namespace

const char* name(Coordinate c) {
  constexpr const char* names[] = {"mu", "height_m", "width_m"};
  return names[static_cast<int>(c)];
}

double value(const Entry& entry, Coordinate c) {
  switch (c) {
    case Coordinate::mu:
      return entry.mu_k;
    case Coordinate::height_m:
      return entry.height_m;
    case Coordinate::width_m:
      return entry.width_m;
  }
  return unknown;
}

std::vector<GridPoint> grid_points(const Database& db, const std::vector<std::size_t>& entries, Wanted wanted) {
  std::map<std::string, std::vector<std::size_t>> groups;
  std::vector<std::string> order;
  for (const std::size_t i : entries) {
    const std::string key = rest_of(db.entries[i], wanted);
    if (groups[key].empty()) order.push_back(key);
    groups[key].push_back(i);
  }
  std::vector<GridPoint> points;
  const bool none_wanted = std::none_of(wanted.begin(), wanted.end(), [](const auto& w) { return w.has_value(); });
  if (none_wanted) {
    for (const std::size_t i : entries) points.push_back({{{i, 1}}, {}});
    return points;
  }
  for (const std::string& key : order)
    if (auto point = point_in(db, groups[key], wanted)) points.push_back(std::move(*point));
  if (points.empty()) throw no_grid(db, groups, wanted);
  return points;
}

}  // namespace freestand::database
