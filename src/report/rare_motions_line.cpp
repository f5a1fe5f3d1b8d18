// 27 peak slips under motions of 2 % in 50 years: line, bins, fit, surface.
#include "report/printed_line.hpp"

namespace freestand::report {
namespace {

Item rare_motions_item(const Sources& sources) { return line_item(sources, rare_motions); }

const RegisteredItem rare_motions_here{
    {.name = "rare_motions",
     .order = 820,
     .chapter = 8,
     .place = "Figures 8.1 to 8.3, table 8.1",
     .what = "27 peak slips under motions of 2 % in 50 years: line, bins, fit, surface",
     .compute = rare_motions_item}};

}  // namespace
}  // namespace freestand::report
