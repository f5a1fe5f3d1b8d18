// 28 peak slips over IM, friction that fits the histories best: line, bins, fit, surface.
#include "report/printed_line.hpp"

namespace freestand::report {
namespace {

Item best_fit_item(const Sources& sources) { return line_item(sources, best_fit); }

const RegisteredItem best_fit_here{
    {.name = "best_fit",
     .order = 510,
     .chapter = 5,
     .place = "Figures 5.1 to 5.8, table 5.1",
     .what = "28 peak slips over IM, friction that fits the histories best: line, bins, fit, surface",
     .compute = best_fit_item}};

}  // namespace
}  // namespace freestand::report
