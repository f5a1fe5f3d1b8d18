// The tables of a database as csv, its words as json.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/database_columns.hpp"
#include "io/database_file.hpp"
#include "io/text_files.hpp"

namespace freestand::io {
namespace {

using database::Curve;
using database::Database;
using database::Entry;
using database::Point;
using database::Word;

std::string value_text(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }
std::string value_text(std::int64_t value) { return fmt::format("{}", value); }
std::string value_text(const std::string& text) { return text; }

template <class Row>
std::string value_text(const DatabaseColumn<Row>& column, const Row& row) {
  return std::visit([&](auto member) { return value_text(row.*member); }, column.member);
}

nlohmann::ordered_json words(const std::vector<Word>& all) {
  nlohmann::ordered_json json;
  for (const Word& word : all)
    json[word.name] = {
        {"unit", word.unit}, {"symbol", word.symbol}, {"summary", word.summary}, {"binary", word.binary}};
  return json;
}

template <class Columns>
std::string header(const Columns& columns, bool numbers_only) {
  std::string text;
  for (const auto& column : columns)
    if (!numbers_only || !column.is_text()) text += fmt::format(",{}", column.name);
  return text + "\n";
}

}  // namespace

std::string entries_csv(const Database& db) {
  std::string text = "id" + header(entry_columns(), true);
  for (const Entry& entry : db.entries) {
    text += entry.id;
    for (const auto& column : entry_columns())
      if (!column.is_text()) text += fmt::format(",{}", value_text(column, entry));
    text += "\n";
  }
  return text;
}

std::string curves_csv(const Database& db) {
  std::string text = "id" + header(curve_columns(), false);
  for (const Curve& curve : db.curves) {
    text += db.entries[curve.entry].id;
    for (const auto& column : curve_columns()) text += fmt::format(",{}", value_text(column, curve));
    text += "\n";
  }
  return text;
}

std::string points_csv(const Database& db) {
  std::string text = "id,intensity,demand,capacity" + header(point_columns(), false);
  for (const Curve& curve : db.curves)
    for (const Point& point : curve.points) {
      text +=
          fmt::format("{},{},{},{}", db.entries[curve.entry].id, curve.im, curve.demand, value_text(curve.capacity));
      for (const auto& column : point_columns()) text += fmt::format(",{}", value_text(column, point));
      text += "\n";
    }
  return text;
}

std::string words_json(const Database& db) {
  nlohmann::ordered_json json{{"format", words_format}, {"name", db.name}, {"revision", db.revision}};
  json["classes"] = db.classes;
  json["families"] = {
      {database::lognormal_family, "the lognormal of median and dispersion is off the shares of bins of IM by at most off_by, which is small"},
      {database::not_refuted_family,
       "the points of the curve are to be used, as below: the lognormal is not refuted, but may be off by off_by"},
      {database::points_family,
       "straight lines in probability over the intensity between the points of the curve, from 0 at 0 to the first "
       "one (level below one from which the curve falls), level above the last"}};
  json["intensities"] = words(db.intensities);
  json["demands"] = words(db.demands);
  nlohmann::ordered_json columns;
  for (const auto& column : entry_columns())
    columns[column.name] = {{"unit", column.unit}, {"description", column.description}};
  for (const auto& column : curve_columns())
    columns[column.name] = {{"unit", column.unit}, {"description", column.description}};
  for (const auto& column : point_columns())
    columns[column.name] = {{"unit", column.unit}, {"description", column.description}};
  json["columns"] = columns;
  for (const Entry& entry : db.entries) {
    nlohmann::ordered_json& one = json["entries"][entry.id];
    for (const auto& column : entry_columns())
      if (column.is_text() && column.name != std::string_view("id")) one[column.name] = value_text(column, entry);
  }
  return json_text(json);
}

}  // namespace freestand::io
