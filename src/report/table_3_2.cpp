// Table 3.2: friction by slow pulls, and friction that fits recorded histories. What follows from it: how far a slow pull
// overrates friction, how stiff the contact is before it yields, and from which intensity on a block slides.
#include <cmath>

#include "base/units.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

// Every row of the tables of peaks takes its friction from here.
Statement friction_of_the_tables(const Sources& sources, const PrintedTable& friction) {
  const auto specimens = friction.texts("specimen");
  std::size_t rows = 0, same = 0;
  for (const char* file : {"table_5_1.csv", "table_8_1.csv"}) {
    const PrintedTable peaks(sources, file);
    const auto names = peaks.texts("specimen");
    for (const auto& [theirs, ours] :
         {std::pair{"mu_slow_pull", "mu_k_slow_pull"}, {"mu_best_fit", "mu_k_coulomb_fit"}}) {
      const auto found = peaks.numbers(theirs), printed = friction.numbers(ours);
      for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t k = 0; k < specimens.size(); ++k)
          if (names[i].starts_with(specimens[k])) {
            ++rows;
            same += found[i] == printed[k];
          }
    }
  }
  return {"table_3_2.used",
          "friction in tables 5.1 and 8.1",
          std::to_string(same) + " of " + std::to_string(rows) + " entries are those of table 3.2",
          "as in table 3.2",
          same == rows ? Verdict::agrees : Verdict::print_disagrees_with_itself,
          ""};
}

Item table_3_2(const Sources& sources) {
  const PrintedTable table(sources, "table_3_2.csv"), dimensions(sources, "table_3_1.csv");
  const auto specimens = table.texts("specimen");
  const auto weights = dimensions.numbers("weight_lb");
  Item item;
  Sheet sheet{"table_3_2",
              {"mu_s_slow_pull", "mu_k_slow_pull", "mu_k_elastoplastic_fit", "mu_s_coulomb_fit", "mu_k_coulomb_fit"},
              {}};
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const auto at = [&](const char* column) { return table.numbers(column)[i]; };
    const auto add = [&](const char* id, const char* what, const char* unit, double ours) {
      item.numbers.push_back({.id = "table_3_2." + specimens[i] + "." + id,
                              .what = specimens[i] + ": " + what,
                              .unit = unit,
                              .ours = ours});
    };
    add("overrated", "kinetic friction of a slow pull over the one that fits histories", "1",
        at("mu_k_slow_pull") / at("mu_k_coulomb_fit"));
    add("static_ratio", "static over kinetic friction, slow pull", "1", at("mu_s_slow_pull") / at("mu_k_slow_pull"));
    // Force at yield over displacement at yield.
    add("stiffness", "stiffness of the contact before it yields, slow pull: μk W/u_y", "lb/in",
        at("mu_k_slow_pull") * weights[i] / at("u_y_slow_pull_in"));
    add("slides_from", "least IM at which it slides: μs/μk − 1, slow pull", "1",
        at("mu_s_slow_pull") / at("mu_k_slow_pull") - 1);
    std::vector<Cell> row{specimens[i]};
    for (const std::string& column : sheet.columns) row.emplace_back(table.numbers(column)[i]);
    sheet.rows.push_back(std::move(row));
  }
  item.statements = {friction_of_the_tables(sources, table),
                     {"table_3_2.negative_im", "can a block slide at IM < 0?",
                      "no: it starts at IM = μs/μk − 1, which is above 0 since μs > μk",
                      "yes, since μs > μ [KM05 ch. 5]", Verdict::print_disagrees_with_itself,
                      "a block that rests slides once PTA exceeds μs g, and IM counts with the smaller μk"}};
  item.sheets = {sheet};
  item.left_out = {
      "the force-displacement records of the pulls, and the histories under which friction was fitted, are not "
      "published as numbers"};
  return item;
}

const RegisteredItem table_3_2_here{{.name = "table_3_2",
                                     .order = 320,
                                     .chapter = 3,
                                     .place = "Table 3.2",
                                     .what = "friction of slow pulls against friction that fits histories",
                                     .compute = table_3_2}};

}  // namespace
}  // namespace freestand::report
