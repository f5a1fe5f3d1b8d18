// What can be asked of a database: the probability of a demand beyond a capacity at an intensity, of the entries that a
// question picks, or between them where they form a grid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "database/database.hpp"
#include "database/interpolate.hpp"

namespace freestand::database {

// Numbers of an entry between which answers are interpolated. Each stands for itself: what is not asked for parts the
// entries that do not agree in it.
enum class Coordinate { mu, height_m, width_m };
inline constexpr Coordinate coordinates[] = {Coordinate::mu, Coordinate::height_m, Coordinate::width_m};
const char* name(Coordinate);
double value(const Entry&, Coordinate);

struct Question {
  std::optional<std::string> id, equipment, floor, friction;
  std::optional<double> wanted[std::size(coordinates)];  // by Coordinate
  std::string im;
  double im_value = unknown;  // NaN: the whole curve
  std::string demand;
  double capacity = unknown;  // NaN: of a binary demand
};

struct Part {
  std::size_t entry;  // position in Database::entries
  double weight;      // negative where the answer is extrapolated
};

// One group of entries that agree in all but the coordinates asked for.
struct Answer {
  std::vector<Part> parts;  // one: that entry itself
  std::vector<double> im;   // the one asked for, or the curve's
  std::vector<Probability> probability;
  bool extrapolated = false;       // outside of what was swept, or of the grid of entries
  std::vector<std::string> notes;  // plain sentences: what was extrapolated, and how far; what the band rests on
  std::string rule;                // a plain sentence: how its curves are read between their points
  std::string between;             // and what no band holds there; empty: nothing that is more than the band
  double median = unknown, dispersion = unknown;  // of one entry whose curve is a lognormal
};

// How far outside an answer is still given: intensities up to this factor beyond what was swept; coordinates up to this
// share of the nearest interval of the grid, in its logarithm.
inline constexpr double intensity_reach = 1.5, coordinate_reach = 0.5;

// Entries that a question picks by its words, in the order of the database. Throws Error (Exit::usage) with the choices
// where a word is not in the database or nothing is left.
std::vector<std::size_t> picked(const Database&, const Question&);

// These entries with their curves, and of intensities and demands those that these curves have.
Database part_of(const Database&, const std::vector<std::size_t>& entries);

// Throws Error (Exit::usage): an unknown word, a demand or intensity that is not there, a capacity outside of those that
// are, a coordinate that the entries form no grid in, or a question that is too far outside.
std::vector<Answer> ask(const Database&, const Question&);

}  // namespace freestand::database
