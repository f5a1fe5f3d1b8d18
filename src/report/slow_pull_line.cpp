// the same 28 peak slips, friction of the slow pulls.
#include "report/printed_line.hpp"

namespace freestand::report {
namespace {

Item slow_pull_item(const Sources& sources) { return line_item(sources, slow_pull); }

const RegisteredItem slow_pull_here{{.name = "slow_pull",
                                     .order = 520,
                                     .chapter = 5,
                                     .place = "Figures 5.1 to 5.8, table 5.1",
                                     .what = "the same 28 peak slips, friction of the slow pulls",
                                     .compute = slow_pull_item}};

}  // namespace
}  // namespace freestand::report
