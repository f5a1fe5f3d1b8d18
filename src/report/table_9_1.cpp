// Table 9.1: the pulls that tore the connections of the chains, mean and standard deviation (divisor n - 1), in pounds.
#include <fmt/format.h>

#include "fragility/intervals.hpp"
#include "report/pounds.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

Item table_9_1(const Sources& sources) {
  const PrintedTable table(sources, "table_9_1.csv");
  struct Kind {
    const char *column, *words;
    double mean, deviation;
  };
  Item item;
  Sheet sheet{"table_9_1", {"test", "strength_lb", "strength_n"}, {}};
  constexpr double unit = 5;  // means and deviations are printed to 5 lb
  for (const Kind& kind : {Kind{"cross_chained_strength_lb", "cross-chained", 705, 30},
                           Kind{"straight_chained_strength_lb", "straight-chained", 615, 45}}) {
    const std::vector<double> pulls = table.numbers(kind.column);
    double sum = 0;
    for (std::size_t i = 0; i < pulls.size(); ++i) {
      sum += pulls[i];
      sheet.rows.push_back({std::string(kind.words), static_cast<double>(i + 1), pulls[i], pulls[i] * pound_n});
    }
    const double mean = sum / static_cast<double>(pulls.size());
    const auto add = [&](const char* id, const char* what, double ours, double print) {
      item.numbers.push_back(compared({.id = fmt::format("table_9_1.{}.{}", kind.words, id),
                                       .what = fmt::format("{}: {}", kind.words, what),
                                       .unit = "lb",
                                       .ours = ours,
                                       .print = print,
                                       .print_unit = unit},
                                      Verdict::print_disagrees_with_itself,
                                      "does not follow from the six pulls of the table"));
    };
    add("mean", "mean strength of the connection", mean, kind.mean);
    add("sd", "standard deviation of six pulls", fragility::standard_deviation(pulls), kind.deviation);
    item.numbers.push_back({.id = fmt::format("table_9_1.{}.newton", kind.words),
                            .what = fmt::format("{}: mean strength", kind.words),
                            .unit = "N",
                            .ours = mean * pound_n});
  }
  item.statements = {
      {"table_9_1.unit", "unit of the strengths",
       "pounds: read as newtons they would be 4.4 times too small, less than the weight of the lightest specimen",
       "pounds in the table", Verdict::agrees, ""}};
  item.sheets = {sheet};
  return item;
}

const RegisteredItem table_9_1_here{{.name = "table_9_1",
                                     .order = 910,
                                     .chapter = 9,
                                     .place = "Table 9.1",
                                     .what = "pull-out strength of the chains' connections",
                                     .compute = table_9_1}};

}  // namespace
}  // namespace freestand::report
