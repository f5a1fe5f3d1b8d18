#include "app/checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/shown_text.hpp"

namespace freestand::app {
namespace {

template <class Allowed>
CLI::Validator check(const std::string& what, const std::string& range, Allowed allowed) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
        return number && allowed(value) ? std::string()
                                        : fmt::format("{} is no {} ({}): give another one", shown(text), what, range);
      },
      "");
}

}  // namespace

CLI::Validator above_zero(const std::string& what) {
  return check(what, "it is above 0", [](double value) { return value > 0; });
}

CLI::Validator zero_or_above(const std::string& what) {
  return check(what, "it is 0 or above", [](double value) { return value >= 0; });
}

CLI::Validator within(double least, double most, const std::string& what) {
  return check(what, fmt::format("it lies from {:g} to {:g}", least, most),
               [=](double value) { return value >= least && value <= most; });
}

}  // namespace freestand::app
