#include "report/rounding.hpp"

#include <algorithm>

#include "base/random.hpp"

namespace freestand::report {

Range reach(std::span<const Rounded> inputs, const std::function<double(std::span<const double>)>& f) {
  constexpr std::uint64_t draws = 1000;
  const std::uint64_t stream = random::stable_hash("report/reach");
  std::vector<double> values;
  for (const Rounded& input : inputs) values.push_back(input.value);
  Range range{f(values), 0};
  range.high = range.low;
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < inputs.size(); ++i)
      values[i] = inputs[i].value + inputs[i].unit * (random::uniform(1, draw * inputs.size() + i, stream) - 0.5);
    const double value = f(values);
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  return range;
}

}  // namespace freestand::report
