// Table 8.1: intensity and demand of the 27 tests under motions of 2 % in 50 years, row by row.
#include "report/table_rows.hpp"

namespace freestand::report {
namespace {

Item table_8_1(const Sources& sources) { return rows_item(sources, "table_8_1", {"mu_best_fit", "im_printed"}); }

const RegisteredItem table_8_1_here{
    {.name = "table_8_1",
     .order = 810,
     .chapter = 8,
     .place = "Table 8.1",
     .what = "intensity and demand of the 27 tests under motions of 2 % in 50 years, row by row",
     .compute = table_8_1}};

}  // namespace
}  // namespace freestand::report
