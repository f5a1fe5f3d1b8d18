#include "exports/csv_rows.hpp"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <limits>

#include "base/durable_file.hpp"

namespace freestand::exports {
namespace {

using Rows = std::vector<std::vector<std::string>>;

struct Reading {
  Rows rows;
  std::vector<std::string> row;
};

void take_cell(void* text, std::size_t size, void* data) {
  static_cast<Reading*>(data)->row.emplace_back(static_cast<const char*>(text), size);
}

void take_row(int, void* data) {
  auto* reading = static_cast<Reading*>(data);
  reading->rows.push_back(std::move(reading->row));
  reading->row.clear();
}

}  // namespace

Rows csv_rows(const std::filesystem::path& file) {
  const std::string text = read_whole(file);
  csv_parser parser;
  Reading reading;
  bool sound = csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) == 0;
  if (sound) {
    sound = csv_parse(&parser, text.data(), text.size(), take_cell, take_row, &reading) == text.size() &&
            csv_fini(&parser, take_cell, take_row, &reading) == 0;
    csv_free(&parser);
  }
  if (!sound)
    throw Error(fmt::format("{} is no table (its quotes do not match): export again", file.string()), Exit::data);
  return std::move(reading.rows);
}

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file), rows_(csv_rows(file)) {
  if (rows_.empty()) throw Error(fmt::format("{} is empty (no head): export again", file.string()), Exit::data);
  head_ = rows_.front();
  rows_.erase(rows_.begin());
  for (const auto& row : rows_)
    if (row.size() != head_.size())
      throw Error(fmt::format("{} has a row of {} cells under {} columns (they must match): export again",
                              file.string(), row.size(), head_.size()),
                  Exit::data);
}

bool CsvTable::has(const std::string& column) const {
  return std::find(head_.begin(), head_.end(), column) != head_.end();
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = std::find(head_.begin(), head_.end(), column);
  if (found == head_.end())
    throw Error(fmt::format("{} has no column {} (its readers ask for it): export again", file_.string(), column),
                Exit::data);
  return rows_[row][static_cast<std::size_t>(found - head_.begin())];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  try {
    return std::stod(cell);
  } catch (const std::exception&) {
    throw Error(fmt::format("{} has {} under {} (no number): export again", file_.string(), cell, column), Exit::data);
  }
}

}  // namespace freestand::exports
