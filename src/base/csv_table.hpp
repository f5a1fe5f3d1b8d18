// A table that a user wrote: csv with a header, cells in quotes where they hold commas [RFC 4180], lines that begin with #
// and empty lines left out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace freestand {

struct CsvTable {
  struct Row {
    int line = 0;                    // of the file, 1 first
    std::vector<std::string> cells;  // one for each column, without blanks around them
  };
  std::filesystem::path file;
  std::vector<std::string> columns;
  std::vector<Row> rows;

  // Position of a column; columns.size() where there is none.
  std::size_t column(const std::string& name) const;
  // "FILE:LINE: "
  std::string at(const Row& row) const;
};

// The cells of one line, without blanks around them; nothing where a quote does not end on it.
std::optional<std::vector<std::string>> csv_cells(std::string_view line);

// The columns of the file's first line that is no comment; empty where it cannot be read as text.
std::vector<std::string> csv_columns(const std::filesystem::path& file);

// Throws Error (Exit::data) that names every line that is wrong: other than the header's number of cells, a quote that does
// not end, a column without a name or twice; and where the file cannot be read or has no rows.
CsvTable read_csv_table(const std::filesystem::path& file);

}  // namespace freestand
