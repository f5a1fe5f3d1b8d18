#include "io/database_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <freestand/error.hpp>
#include <numeric>

#include "io/database_columns.hpp"
#include "io/h5.hpp"

namespace freestand::io {
namespace {

using database::Curve;
using database::Database;
using database::Entry;
using database::Point;
using database::Word;

template <class Row>
h5::Dataset write_column(h5::Group& group, const DatabaseColumn<Row>& column, const std::vector<const Row*>& rows) {
  return std::visit(
      [&]<class T>(T Row::*member) {
        std::vector<T> values;
        for (const Row* row : rows) values.push_back(row->*member);
        return std::move(group.put(column.name, values).describe(column.unit, column.description));
      },
      column.member);
}

// The numbers of a table's rows, the scale of its columns.
h5::Dataset write_numbers(h5::Group& group, const char* name, std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  h5::Dataset scale = group.put(name, numbers);
  scale.scale(name).describe("1", "row of this table");
  return scale;
}

void expect(bool holds, const h5::Group& group, const char* what) {
  if (!holds)
    throw Error(fmt::format("{} cannot be used ({}): build the database again", group.file_path(), what), Exit::data);
}

template <class Row>
void read_column(const h5::Group& group, const DatabaseColumn<Row>& column, std::vector<Row>& rows) {
  const h5::Dataset dataset = group.open_dataset(column.name);
  const auto fill = [&](const auto& values, auto member) {
    if (rows.empty()) rows.resize(values.size());
    if (values.size() != rows.size())
      throw Error(fmt::format("{} cannot be used (its column {} has {} rows, others {}): build the database again",
                              group.file_path(), column.name, values.size(), rows.size()),
                  Exit::data);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].*member = static_cast<std::remove_reference_t<decltype(rows[i].*member)>>(values[i]);
  };
  if (const auto* text = std::get_if<std::string Row::*>(&column.member))
    fill(dataset.read_texts(), *text);
  else if (const auto* whole = std::get_if<std::int64_t Row::*>(&column.member))
    fill(dataset.read_integers(), *whole);
  else
    fill(dataset.read(), std::get<double Row::*>(column.member));
}

template <class Row>
std::vector<const Row*> pointers(const std::vector<Row>& rows) {
  std::vector<const Row*> all;
  for (const Row& row : rows) all.push_back(&row);
  return all;
}

void write_words(h5::Group& root, const char* name, const std::vector<Word>& words) {
  h5::Group group = root.make_group(name);
  std::vector<std::string> names, units, symbols, summaries;
  std::vector<std::int32_t> binary;
  for (const Word& word : words) {
    names.push_back(word.name);
    units.push_back(word.unit);
    symbols.push_back(word.symbol);
    summaries.push_back(word.summary);
    binary.push_back(word.binary);
  }
  h5::Dataset scale = group.put("name", names);
  scale.scale("name");
  group.put("unit", units).attach(0, scale);
  group.put("symbol", symbols).attach(0, scale);
  group.put("summary", summaries).attach(0, scale);
  group.put("binary", binary).attach(0, scale);
}

std::vector<Word> read_words(const h5::Group& root, const char* name) {
  const h5::Group group = root.open_group(name);
  const auto names = group.open_dataset("name").read_texts();
  const auto texts = [&](const char* of) { return group.open_dataset(of).read_texts(names.size()); };
  const auto units = texts("unit"), symbols = texts("symbol"), summaries = texts("summary");
  const std::vector<double> binary = group.open_dataset("binary").read(names.size());
  std::vector<Word> words;
  for (std::size_t i = 0; i < names.size(); ++i)
    words.push_back({names[i], units[i], symbols[i], summaries[i], binary[i] != 0});
  return words;
}

// Rows of another table that each of `points` rows of `group`/`name` points to, each below `count`.
std::vector<std::size_t> read_rows(const h5::Group& group, const char* name, std::size_t points, std::size_t count) {
  std::vector<std::size_t> rows;
  for (const double value : group.open_dataset(name).read(points)) {
    if (!(value >= 0 && value < static_cast<double>(count)))
      throw Error(fmt::format("{} cannot be used ({} points to row {} of {}): build the database again",
                              group.file_path(), name, value, count),
                  Exit::data);
    rows.push_back(static_cast<std::size_t>(value));
  }
  return rows;
}

void write_tables(h5::Group& root, const Database& db) {
  h5::Group entries = root.make_group("entries");
  h5::Dataset id = write_column(entries, entry_columns().front(), pointers(db.entries));
  id.scale("id");
  for (const auto& column : entry_columns().subspan(1))
    write_column(entries, column, pointers(db.entries)).attach(0, id);
  h5::Group curves = root.make_group("curves"), points = root.make_group("points");
  std::vector<std::int64_t> entry_of, curve_of;
  std::vector<const Point*> all;
  for (std::size_t i = 0; i < db.curves.size(); ++i) {
    entry_of.push_back(static_cast<std::int64_t>(db.curves[i].entry));
    for (const Point& point : db.curves[i].points) {
      curve_of.push_back(static_cast<std::int64_t>(i));
      all.push_back(&point);
    }
  }
  const h5::Dataset curve = write_numbers(curves, "curve", db.curves.size()),
                    point = write_numbers(points, "point", all.size());
  curves.put("entry", entry_of).attach(0, curve).describe("1", "row of the entry");
  for (const auto& column : curve_columns()) write_column(curves, column, pointers(db.curves)).attach(0, curve);
  points.put("curve", curve_of).attach(0, point).describe("1", "row of the curve");
  for (const auto& column : point_columns()) write_column(points, column, all).attach(0, point);
}

}  // namespace

void write_database(const std::filesystem::path& path, const Database& db) {
  h5::File file = h5::File::create(path);
  h5::Group root = file.root();
  root.attribute("format", database_format);
  root.attribute("name", db.name);
  root.attribute("revision", db.revision);
  root.attribute("confidence", db.confidence);
  root.put("classes", db.classes).scale("classes");
  root.put("families",
           std::vector<std::string>{database::lognormal_family, database::not_refuted_family, database::points_family})
      .scale("families");
  write_words(root, "intensities", db.intensities);
  write_words(root, "demands", db.demands);
  write_tables(root, db);
  file.finish();
}

Database read_database(const std::filesystem::path& path) {
  const h5::File file = h5::File::open(path);
  const h5::Group root = file.root();
  const std::string format = root.has_attribute("format") ? root.text_attribute("format") : "";
  if (format != database_format)
    throw Error(
        fmt::format("{} is no database (its format is \"{}\", not \"{}\"): name one that `freestand catalogue` has "
                    "made",
                    path.string(), format, database_format),
        Exit::data);
  Database db;
  db.name = root.text_attribute("name");
  db.revision = root.text_attribute("revision");
  db.confidence = root.real_attribute("confidence");
  expect(db.confidence > 0 && db.confidence < 1, root, "its confidence is no share");
  db.classes = root.open_dataset("classes").read_texts();
  db.intensities = read_words(root, "intensities");
  db.demands = read_words(root, "demands");
  const h5::Group entries = root.open_group("entries"), curves = root.open_group("curves"),
                  points = root.open_group("points");
  for (const auto& column : entry_columns()) read_column(entries, column, db.entries);
  for (const auto& column : curve_columns()) read_column(curves, column, db.curves);
  const auto entry_of = read_rows(curves, "entry", db.curves.size(), db.entries.size());
  for (std::size_t i = 0; i < db.curves.size(); ++i) db.curves[i].entry = entry_of[i];
  for (const Curve& curve : db.curves) expect(std::isfinite(curve.capacity), curves, "a capacity is no number");
  std::vector<Point> all;
  for (const auto& column : point_columns()) read_column(points, column, all);
  for (const Point& point : all) expect(std::isfinite(point.im), points, "an intensity is no number");
  const auto curve_of = read_rows(points, "curve", all.size(), db.curves.size());
  for (std::size_t i = 0; i < all.size(); ++i) db.curves[curve_of[i]].points.push_back(all[i]);
  return db;
}

}  // namespace freestand::io
