// Which limit states are meant by the words of a request.
#pragma once

#include <string>
#include <vector>

#include "fragility/result.hpp"

namespace freestand::exports {

// A demand and one of its capacities.
struct Wanted {
  const fragility::EdpResult* edp;
  std::size_t capacity;
  std::string name;
};

// Words as in Request::states. Throws Error (Exit::usage) that lists what there is.
std::vector<Wanted> wanted_states(const fragility::Result&, const std::vector<std::string>& words, bool table);

// Letters, digits and _ in place of anything else: "peak_slip_m_over_0p05".
std::string state_name(const fragility::EdpResult&, std::size_t capacity);

}  // namespace freestand::exports
