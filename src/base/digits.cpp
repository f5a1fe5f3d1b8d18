#include "base/digits.hpp"

#include <cmath>
#include <cstdio>

namespace freestand {

std::string three_digits(double number) {
  const double size = std::abs(number);
  char text[40];
  std::snprintf(text, sizeof text, size >= 9995 ? "%.2g" : size >= 99.95 ? "%.0f" : "%#.3g", number);
  return text;
}

}  // namespace freestand
