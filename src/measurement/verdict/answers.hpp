// What simulations answered to the questions of a diagnosis. Each is asked once, and all that decided stand in Diagnosis::chances.
#pragma once

#include <functional>
#include <string>

#include "measurement/verdict/diagnose.hpp"

namespace freestand::measurement {

// Null: it was not asked.
const Chance* answer(const Diagnosis&, const std::string& question, const std::string& about);

// May chance do it? Asked where it was not yet.
bool is_chance(Diagnosis&, const char* question, const std::string& about, const std::function<Chance()>& ask);

// Does any effect help? Null: that was not asked.
const Chance* help_of(const Diagnosis&);

}  // namespace freestand::measurement
