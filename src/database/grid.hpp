// Entries that differ in some coordinates alone, as a grid in these.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "database/query.hpp"

namespace freestand::database {

// Two numbers that differ by less than this share are the same one.
inline constexpr double same_number = 1e-9;

// Where the wanted coordinates lie in one grid: the entries around, with weights that are products of linear ones in the
// logarithm of each coordinate.
struct GridPoint {
  std::vector<Part> parts;
  std::vector<std::string> notes;
  bool extrapolated = false;
};

// Parts the entries into groups that agree in all but the wanted coordinates, and finds these in each group. A group that
// lacks an entry of its grid, or does not reach there, is left out; throws Error (Exit::usage) with what there is where no
// group is left. wanted: by Coordinate.
std::vector<GridPoint> grid_points(const Database&, const std::vector<std::size_t>& entries,
                                   std::span<const std::optional<double>> wanted);

}  // namespace freestand::database
