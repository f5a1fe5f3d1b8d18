#include "report/item.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::report {

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::disagrees:
      return "disagrees";
    case Verdict::print_disagrees_with_itself:
      return "print disagrees with itself";
    case Verdict::not_printed:
      break;
  }
  return "not printed";
}

double Number::difference() const { return ours - print.value_or(std::numeric_limits<double>::quiet_NaN()); }

bool reaches(double print, double print_unit, Range range) {
  const double half = 0.5 * print_unit, round_off = 1e-9 * (std::abs(print) + print_unit);
  return print + half >= range.low - round_off && print - half <= range.high + round_off;
}

Number compared(Number number, Verdict otherwise, std::string why) {
  if (!number.print) return number;
  const bool agrees = reaches(*number.print, number.print_unit, number.reach.value_or(Range{number.ours, number.ours}));
  number.verdict = agrees ? Verdict::agrees : otherwise;
  if (!agrees) number.why = std::move(why);
  return number;
}

std::vector<Entry> entries() {
  std::vector<Entry> all = registry<Entry>();
  std::stable_sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.order < b.order; });
  return all;
}

}  // namespace freestand::report
