// A table of numbers as laboratories write them: columns set apart by commas, semicolons, tabs or blanks; decimal points or
// decimal commas; lines of words above the names of the columns, and a line of units below them. Columns of dates or words may stand among
// them, and cells that are no numbers: a flaw of their column.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace freestand {

struct LabTable {
  std::filesystem::path file;
  std::vector<std::string> columns;         // as the file names them; without names "1", "2", ...
  std::vector<std::string> units;           // of the line between names and numbers; empty: there is none
  std::vector<std::vector<double>> values;  // of each column
  std::vector<std::string>
      flaws;               // of each column: its first cell that is no finite number (NaN in values); empty: none
  std::string with_comma;  // the first number with a decimal comma; empty: none
  std::vector<int> lines;  // of each row, 1 first

  // Position of a column; columns.size() where there is none.
  std::size_t column(const std::string& name) const;
};

// Throws Error (Exit::data) that names file and line: no numbers, or a row with another number of cells.
// a_column: one of its names, by which the line of names is known; "": the upper one of two lines that may be.
LabTable read_lab_table(const std::filesystem::path& file, const std::string& a_column = "");

}  // namespace freestand
