// Into which direction pairs of horizontal components are turned.
#include <fmt/format.h>

#include "motion/record_pairs.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {

std::optional<TurnPart> read_turn(Section& section) {
  const bool words = section.has("rotate"), angle = section.has("rotate_deg");
  const auto to = section.choice("rotate", {"fault_normal", "fault_parallel"}, 0);
  const auto angle_deg = section.optional_number("rotate_deg");
  if (words && angle)
    section.problem("rotate", fmt::format("{} and rotate_deg are both given (one determines the other): remove one",
                                          section.name("rotate")));
  if (words) return TurnPart{to == 0 ? TurnPart::To::fault_normal : TurnPart::To::fault_parallel, 0};
  return angle ? std::optional(TurnPart{TurnPart::To::angle, angle_deg.value_or(0)}) : std::nullopt;
}

void check_turn(Section& section, const MotionSource& source, const RecordKeys& keys) {
  if (source.turn && source.turn->to != TurnPart::To::angle)
    section.problem("rotate",
                    fmt::format("{} goes with a table of records (where components point, and the strike of the "
                                "fault, are not known without it): give rotate_deg, or a table with azimuth_deg "
                                "and strike_deg",
                                section.name("rotate")));
  else if (source.turn && source.cross_records.empty())
    section.problem("rotate_deg",
                    fmt::format("{} has one component only (a pair is turned): give the other one as {}, or a "
                                "table of records",
                                section.name("rotate_deg"), keys.cross_key));
}

void pair_rows(Section& section, const TurnPart& turn, motion::RecordTable& table) {
  motion::pair_components(table);
  if (turn.to == TurnPart::To::angle) return;
  for (const motion::RecordRow& row : table.rows)
    if (!row.strike_deg)
      section.problem("rotate",
                      fmt::format("{} has no strike_deg (the strike of the fault is not known): give the table that "
                                  "column",
                                  row.where));
}

}  // namespace freestand::study
