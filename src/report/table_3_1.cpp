// Table 3.1: size R, slenderness alpha and frequency parameter p of the specimens, from their outer dimensions.
//   R = sqrt(B^2 + H^2)/2,  alpha = atan(B/H),  p = sqrt(3 g/(4 R))
#include <cmath>
#include <freestand/specimen.hpp>

#include "base/units.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

enum class Figure { size, slenderness, frequency };

double figure_of(Figure figure, double base_in, double height_in) {
  const Block block = Block::rectangular(base_in * inch_m, height_in * inch_m, 1);
  if (figure == Figure::size) return block.size_m() / inch_m;
  return figure == Figure::slenderness ? block.alpha_rad() : block.p_radps();
}

Item table_3_1(const Sources& sources) {
  const PrintedTable table(sources, "table_3_1.csv");
  const auto specimens = table.texts("specimen");
  const auto height = table.rounded("height_in");
  struct Column {
    const char *printed, *base, *what, *unit;
    Figure figure;
  };
  constexpr Column columns[] = {{"r_w_in", "width_in", "R, along the width", "in", Figure::size},
                                {"r_d_in", "depth_in", "R, along the depth", "in", Figure::size},
                                {"alpha_w_rad", "width_in", "α, along the width", "rad", Figure::slenderness},
                                {"alpha_d_rad", "depth_in", "α, along the depth", "rad", Figure::slenderness},
                                {"p_w_rad_per_s", "width_in", "p, along the width", "rad/s", Figure::frequency},
                                {"p_d_rad_per_s", "depth_in", "p, along the depth", "rad/s", Figure::frequency}};
  Item item;
  for (const Column& column : columns) {
    const auto base = table.rounded(column.base);
    const auto printed = table.numbers(column.printed);
    for (std::size_t i = 0; i < specimens.size(); ++i) {
      const auto f = [&](std::span<const double> x) { return figure_of(column.figure, x[0], x[1]); };
      item.numbers.push_back(compared({.id = "table_3_1." + specimens[i] + "." + column.printed,
                                       .what = specimens[i] + ": " + column.what,
                                       .unit = column.unit,
                                       .ours = figure_of(column.figure, base[i].value, height[i].value),
                                       .print = printed[i],
                                       .print_unit = table.unit(column.printed),
                                       .reach = reach(std::vector{base[i], height[i]}, f)},
                                      Verdict::print_disagrees_with_itself,
                                      "does not follow from the printed width and height"));
    }
  }
  return item;
}

const RegisteredItem table_3_1_here{
    {.name = "table_3_1",
     .order = 310,
     .chapter = 3,
     .place = "Table 3.1",
     .what = "size, slenderness and frequency parameter of the specimens, from their dimensions",
     .compute = table_3_1}};

}  // namespace
}  // namespace freestand::report
