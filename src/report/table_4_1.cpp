// Table 4.1 against table 5.1: the same shake-table tests stand in both, once with one decimal of the slip, once with two.
#include <array>
#include <cmath>
#include <optional>

#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

constexpr std::array stations{"Aigion", "Gilroy", "Gavilan", "Kofu", "Cholame"};
constexpr std::array floors{"ground", "6th floor"};

// Station and floor, whatever else the name of a motion holds.
std::string motion_key(const std::string& motion) {
  std::string key;
  for (const char* station : stations)
    if (motion.find(station) != std::string::npos) key += station;
  for (const char* floor : floors)
    if (motion.find(floor) != std::string::npos) key.append(" ").append(floor);
  return key;
}

struct Column {
  const char *specimen, *prefix;
};
constexpr Column specimens[] = {{"FORMA", "forma_face"},
                                {"Kelvinator", "kelvinator_face"},
                                {"ASP face", "asp_face"},
                                {"ASP profile", "asp_profile"}};

std::optional<std::size_t> row_of(const PrintedTable& peaks, const std::string& specimen, const std::string& motion) {
  const auto names = peaks.texts("specimen"), motions = peaks.texts("motion");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == specimen && motion_key(motions[i]) == motion_key(motion)) return i;
  return std::nullopt;
}

Item table_4_1(const Sources& sources) {
  const PrintedTable table(sources, "table_4_1.csv"), peaks(sources, "table_5_1.csv");
  const auto motions = table.texts("motion");
  Item item;
  for (const auto& [specimen, prefix] : specimens) {
    for (const auto& [suffix, column, what, unit] :
         {std::array{"_pta_g", "pta_g", "PTA", "g"}, std::array{"_peak_slip_in", "peak_slip_in", "peak slip", "in"}}) {
      const auto printed = table.numbers(std::string(prefix) + suffix);
      const auto values = peaks.rounded(column);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto row = row_of(peaks, specimen, motions[i]);
        if (std::isnan(printed[i]) || !row) continue;
        const double half = 0.5 * values[*row].unit, value = values[*row].value;
        item.numbers.push_back(
            compared({.id = "table_4_1." + std::to_string(i + 1) + "." + prefix + suffix,
                      .what = std::string(specimen) + ", " + motions[i] + ": " + what + " of table 5.1",
                      .unit = unit,
                      .ours = value,
                      .print = printed[i],
                      .print_unit = table.unit(std::string(prefix) + suffix),
                      .reach = Range{value - half, value + half}},
                     Verdict::print_disagrees_with_itself, "tables 4.1 and 5.1 print different numbers for one test"));
      }
    }
  }
  item.left_out = {"the two Parkfield motions of table 4.1 are not in table 5.1"};
  return item;
}

const RegisteredItem table_4_1_here{
    {.name = "table_4_1",
     .order = 410,
     .chapter = 4,
     .place = "Table 4.1",
     .what = "peak table acceleration and peak slip, beside the same tests in table 5.1",
     .compute = table_4_1}};

}  // namespace
}  // namespace freestand::report
