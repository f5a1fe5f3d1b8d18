// Numbers as tables and sentences show them.
#pragma once

#include <string>

namespace freestand {

// Three digits: "45.8", "1.00", "0.0206", "123", "1.2e+04".
std::string three_digits(double number);

}  // namespace freestand
