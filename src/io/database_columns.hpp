// The columns of a database's tables, each named once: for its HDF5 file, its csv and its words.
#pragma once

#include <span>
#include <string>
#include <variant>

#include "database/database.hpp"

namespace freestand::io {

template <class Row>
struct DatabaseColumn {
  const char* name;
  const char* unit;  // "" for words
  const char* description;
  std::variant<double Row::*, std::int64_t Row::*, std::string Row::*> member;

  bool is_text() const { return std::holds_alternative<std::string Row::*>(member); }
};

// One row an entry. `id` is the first; words and numbers stand in words.json and entries.csv.
std::span<const DatabaseColumn<database::Entry>> entry_columns();
// One row a curve, behind the id of its entry.
std::span<const DatabaseColumn<database::Curve>> curve_columns();
// One row a point of a curve.
std::span<const DatabaseColumn<database::Point>> point_columns();

}  // namespace freestand::io
