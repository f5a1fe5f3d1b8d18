// A condition on numbers as a study writes it: "peak_slip_m > gap_m or overturned".
//
// Operators: + - * / ^, < > <= >= == !=, and or not (&& || too), parentheses.  Functions: those of muParser: abs min max
// sqrt exp log ...  Comparisons bind less than sums, `not` less than comparisons, `and` less than `not`, `or` least.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formula/formula.hpp"

namespace freestand::formula {

class Condition {
 public:
  // What it may look at; one that happens or not is 0 or 1.
  struct Name {
    std::string name;
    bool binary = false;
  };

  // Throws FormulaError where the text does not parse, names something else, or is no condition: its value is other than 0
  // and 1 for some numbers.
  Condition(const std::string& text, const std::vector<Name>& names);
  ~Condition();
  Condition(Condition&&) noexcept;

  // Positions in `names` of those that it looks at, increasing.
  const std::vector<std::size_t>& uses() const;

  // values: one for each name; those that it does not look at may be anything. Not for two threads at once.
  bool holds(std::span<const double> values) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace freestand::formula
