#include "report/table_rows.hpp"

#include "base/units.hpp"
#include "report/peaks.hpp"

namespace freestand::report {

Item rows_item(const Sources& sources, const std::string& name, const PrintedRows& printed) {
  const PrintedTable table(sources, name + ".csv");
  const auto specimens = table.texts("specimen"), motions = table.texts("motion");
  const auto pta = table.rounded("pta_g"), slip = table.rounded("peak_slip_in");
  const auto period = table.numbers("pulse_period_s"), mu = table.numbers(printed.mu_column);
  const auto im = table.numbers(printed.im_column), delta = table.numbers("edp_printed");
  Item item;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const std::string row = specimens[i] + ", " + motions[i];
    const auto add = [&](const char* id, const std::string& what, double ours, double print, double unit, Range range) {
      item.numbers.push_back(compared({.id = name + "." + std::to_string(i + 1) + "." + id,
                                       .what = row + ": " + what,
                                       .ours = ours,
                                       .print = print,
                                       .print_unit = unit,
                                       .reach = range},
                                      Verdict::print_disagrees_with_itself,
                                      "does not follow from the row's printed PTA, slip, period and friction"));
    };
    const auto im_of = [&](std::span<const double> x) { return intensity(x[0], mu[i]); };
    const auto delta_of = [&](std::span<const double> x) { return demand(x[0] * inch_m, period[i], x[1]); };
    add("im", "IM = PTA/(μ g) − 1", intensity(pta[i].value, mu[i]), im[i], table.unit(printed.im_column),
        reach(std::vector{pta[i]}, im_of));
    add("delta", "Δ = U ω²/PTA", demand(slip[i].value * inch_m, period[i], pta[i].value), delta[i],
        table.unit("edp_printed"), reach(std::vector{slip[i], pta[i]}, delta_of));
  }
  return item;
}

}  // namespace freestand::report
