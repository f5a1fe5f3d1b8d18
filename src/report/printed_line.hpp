// A line of the report through the origin of demand over intensity, as printed, and computed again from the printed table.
#pragma once

#include "report/peaks.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {

struct PrintedLine {
  std::string name;                  // "best_fit"
  std::string words;                 // "best-fit friction"
  std::string table;                 // "table_5_1.csv"
  std::string mu_column;             // "mu_best_fit"
  double slope = 0, r2 = 0, ks = 0;  // as printed
  // sigma of the demand over IM. Not printed; two digits of what the table gives.
  double sd_slope = 0;
};
inline constexpr double slope_unit = 0.01, r2_unit = 0.01, ks_unit = 0.001;

extern const PrintedLine best_fit, slow_pull, rare_motions;

// The points of the table: IM out of the printed PTA and friction, the demand as printed.
Peaks printed_peaks(const PrintedTable&, const std::string& mu_column);

// Slope, r2, S and the line's own goodness of fit, bins and surface.
Item line_item(const Sources&, const PrintedLine&);

// P(Delta > capacity) at an intensity, by the printed slope [KM05 5.33], and where the rounding of slope and sigma takes it.
double printed_exceedance(const PrintedLine&, double im, double capacity);
Range reach_of_exceedance(const PrintedLine&, double im, double capacity);

}  // namespace freestand::report
