// The design example [KM05 5.33]: the chance that the slip exceeds a capacity, at one intensity, by the printed lines.
#include "report/printed_line.hpp"

namespace freestand::report {
namespace {

constexpr double example_im = 1.8, example_capacity = 2, example_print = 0.4, example_unit = 0.1;

// The chance over IM, by each printed line.
Sheet chances() {
  Sheet sheet{"design_example", {"im", "probability"}, {}};
  for (const PrintedLine* line : {&best_fit, &slow_pull, &rare_motions})
    for (int i = 1; i <= 80; ++i)
      sheet.rows.push_back({line->name, 0.05 * i, printed_exceedance(*line, 0.05 * i, example_capacity)});
  return sheet;
}

Item design_example(const Sources&) {
  const auto exceeds = [](const PrintedLine& line) { return printed_exceedance(line, example_im, example_capacity); };
  Item item;
  item.numbers = {compared({.id = "design_example.slow_pull",
                            .what = "P(Δ > 2) at IM = 1.8, friction of the slow pulls",
                            .ours = exceeds(slow_pull),
                            .print = example_print,
                            .print_unit = example_unit,
                            .reach = reach_of_exceedance(slow_pull, example_im, example_capacity)},
                           Verdict::print_disagrees_with_itself,
                           "the print reads 0.4 off a picture of the surface; equation 5.33 with the printed slopes "
                           "gives 0.12 by the best fit and 0.51 by the slow pull"),
                  {.id = "design_example.best_fit",
                   .what = "P(Δ > 2) at IM = 1.8, friction that fits best",
                   .ours = exceeds(best_fit)},
                  {.id = "design_example.rare_motions",
                   .what = "P(Δ > 2) at IM = 1.8, motions of 2 % in 50 years",
                   .ours = exceeds(rare_motions)}};
  item.sheets = {chances()};
  return item;
}

const RegisteredItem design_example_here{{.name = "design_example",
                                          .order = 560,
                                          .chapter = 5,
                                          .place = "Design example, [KM05 5.33]",
                                          .what = "the chance that a slip of Δ = 2 is exceeded at IM = 1.8",
                                          .compute = design_example}};

}  // namespace
}  // namespace freestand::report
