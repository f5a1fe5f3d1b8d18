#include "base/table.hpp"

#include <freestand/error.hpp>

namespace freestand {

std::size_t column_index(const std::vector<Column>& columns, const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == name) return i;
    known += (i ? ", " : "") + columns[i].name;
  }
  throw Error("no column \"" + name + "\" (the table has " + known + "): name one of these", Exit::data);
}

}  // namespace freestand
