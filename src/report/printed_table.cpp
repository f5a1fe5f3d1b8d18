#include "report/printed_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>

#include "base/shown_text.hpp"

namespace freestand::report {
namespace {

CsvTable read(const std::filesystem::path& file) {
  try {
    return read_csv_table(file);
  } catch (const Error& error) {
    throw Error(
        std::string(error.what()) +
            "\nfreestand reproduce reads the report's printed tables: give their folder with --tables (configs/report "
            "of freestand's source)",
        Exit::data);
  }
}

}  // namespace

PrintedTable::PrintedTable(const Sources& sources, const std::string& file) : table_(read(sources.tables / file)) {}

std::size_t PrintedTable::at(const std::string& column) const {
  const std::size_t found = table_.column(column);
  if (found < table_.columns.size()) return found;
  throw Error(table_.file.string() + " has no column " + column +
                  " (it is another table, or was changed): give the one of freestand's source",
              Exit::data);
}

std::vector<std::string> PrintedTable::texts(const std::string& column) const {
  const std::size_t c = at(column);
  std::vector<std::string> found;
  for (const CsvTable::Row& row : table_.rows) found.push_back(row.cells[c]);
  return found;
}

std::optional<double> number_in(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

std::vector<double> PrintedTable::numbers(const std::string& column) const {
  const std::size_t c = at(column);
  std::vector<double> found;
  for (const CsvTable::Row& row : table_.rows) {
    const std::string& cell = row.cells[c];
    const std::optional<double> value = number_in(cell);
    if (!value && !cell.empty())
      throw Error(table_.at(row) + column + " is " + shown(cell) + " (no number): correct it", Exit::data);
    found.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return found;
}

double PrintedTable::unit(const std::string& column) const {
  std::size_t decimals = 0;
  for (const std::string& cell : texts(column))
    if (const std::size_t point = cell.find('.'); point != std::string::npos)
      decimals = std::max(decimals, cell.size() - point - 1);
  return std::pow(10.0, -static_cast<double>(decimals));
}

std::vector<Rounded> PrintedTable::rounded(const std::string& column) const {
  std::vector<Rounded> found;
  const double last = unit(column);
  for (const double value : numbers(column)) found.push_back({value, last});
  return found;
}

}  // namespace freestand::report
