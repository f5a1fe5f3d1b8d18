// The outcome of a sample that a sweep drew and did not integrate, because the bin of its intensity is known well enough. No integration
// ends so: it stands in rows of samples alone, where all that responds is nan, and nothing counts it.
#pragma once

#include <freestand/response.hpp>

namespace freestand {

inline constexpr Outcome passed_over = static_cast<Outcome>(outcome_count);
inline constexpr const char* passed_over_name = "passed_over";

}  // namespace freestand
