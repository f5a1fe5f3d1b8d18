// Table 5.1: intensity and demand of the 28 tests, row by row.
#include "report/table_rows.hpp"

namespace freestand::report {
namespace {

Item table_5_1(const Sources& sources) {
  return rows_item(sources, "table_5_1", {"mu_slow_pull", "im_slow_pull_printed"});
}

const RegisteredItem table_5_1_here{{.name = "table_5_1",
                                     .order = 505,
                                     .chapter = 5,
                                     .place = "Table 5.1",
                                     .what = "intensity and demand of the 28 tests, row by row",
                                     .compute = table_5_1}};

}  // namespace
}  // namespace freestand::report
