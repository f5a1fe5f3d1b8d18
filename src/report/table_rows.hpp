// Tables 5.1 and 8.1 row by row: intensity and demand of each test, from its printed peaks.
#pragma once

#include "report/printed_table.hpp"

namespace freestand::report {

struct PrintedRows {
  std::string mu_column;  // the friction that the printed intensity counts with
  std::string im_column;
};

// Periods and friction are taken as they are printed: the report chose them with these digits.
Item rows_item(const Sources&, const std::string& name, const PrintedRows&);

}  // namespace freestand::report
