// The cells of a CSV file, as a reader that knows nothing of freestand takes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace freestand::exports {

// Rows of cells, unquoted. Throws Error (Exit::data) where the file is no CSV (RFC 4180).
std::vector<std::vector<std::string>> csv_rows(const std::filesystem::path& file);

// A table with a head: the cell of a row under a column's name.
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& file);
  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string& column) const;
  const std::string& text(std::size_t row, const std::string& column) const;
  double number(std::size_t row, const std::string& column) const;  // NaN where the cell is empty

 private:
  std::filesystem::path file_;
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace freestand::exports
