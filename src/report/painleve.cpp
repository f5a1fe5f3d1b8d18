// The mass matrix of slide-rock [KM05 6.42, 6.45]: with theta'' inside f_x it is singular where
//   mu = (1/3 + sin^2 phi)/(sin phi cos phi),  phi = alpha - |theta|   (Painlevé's paradox; least 4/3, at tan phi = 1/2).
#include <fmt/format.h>

#include <cmath>
#include <freestand/specimen.hpp>

#include "base/units.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

double singular_friction(double phi) {
  return (1.0 / 3 + std::pow(std::sin(phi), 2)) / (std::sin(phi) * std::cos(phi));
}

// Friction over slenderness, and where the specimens stand.
Sheet of_slenderness(const std::vector<std::string>& specimens, const std::vector<double>& alpha) {
  Sheet sheet{"painleve", {"alpha_rad", "friction"}, {}};
  for (int i = 10; i <= 100; ++i)
    sheet.rows.push_back({std::string("any block"), 0.01 * i, singular_friction(0.01 * i)});
  for (std::size_t i = 0; i < specimens.size(); ++i)
    sheet.rows.push_back({specimens[i], alpha[i], singular_friction(alpha[i])});
  return sheet;
}

Item painleve(const Sources& sources) {
  const PrintedTable table(sources, "table_3_1.csv");
  const auto specimens = table.texts("specimen");
  const auto height = table.numbers("height_in"), depth = table.numbers("depth_in");
  Item item;
  double forma = 0;
  std::vector<double> slenderness;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    slenderness.push_back(Block::rectangular(depth[i], height[i], 1).alpha_rad());
    const double mu = singular_friction(slenderness.back());
    if (specimens[i] == "FORMA") forma = mu;
    item.numbers.push_back(
        {.id = "painleve." + specimens[i],
         .what = specimens[i] + ", along its depth: friction at which the mass matrix is singular as it lifts off",
         .ours = mu});
  }
  item.numbers.push_back({.id = "painleve.least",
                          .what = "least such friction of any block: 4/3",
                          .ours = singular_friction(std::atan(0.5))});
  item.statements = {{"painleve.singular", "is the mass matrix of slide-rock ever singular?",
                      fmt::format("at μ = {:.2f} for FORMA", forma), "never [KM05 6.45]",
                      Verdict::print_disagrees_with_itself, "f_x of 6.42 holds θ'', which belongs into the matrix"}};
  item.sheets = {of_slenderness(specimens, slenderness)};
  item.left_out = {"the sign of equation 6.33, which disagrees with 6.3 and 6.34, is no number"};
  return item;
}

const RegisteredItem painleve_here{{.name = "painleve",
                                    .order = 640,
                                    .chapter = 6,
                                    .place = "[KM05 6.42, 6.45]",
                                    .what = "friction at which slide-rock has no unique motion",
                                    .compute = painleve}};

}  // namespace
}  // namespace freestand::report
