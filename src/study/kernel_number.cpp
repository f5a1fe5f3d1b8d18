#include "study/kernel_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <span>
#include <vector>

#include "parallel/run_files.hpp"

namespace freestand::study {
namespace {

// Of the bits that functions of the mathematical library give at many places between 0 and 1. Where a processor or another version of the library
// gives other last bits, it is at one place in a thousand.
std::uint32_t bits_of_functions() {
  std::vector<double> values;
  constexpr int places = 8192;
  for (int i = 0; i < places; ++i) {
    const double x = (i + 0.5) / places, y = std::fmod(i * 0.61803398874989485, 1.0);
    values.insert(values.end(), {std::exp(3 * x), std::expm1(x), std::log(x), std::log1p(x), std::pow(x, y),
                                 std::sin(7 * x), std::cos(7 * x), std::tan(x), std::atan(x), std::atan2(x, y),
                                 std::hypot(x, y), std::erfc(x), std::exp2(x), std::tanh(x)});
  }
  const std::uint64_t hash = parallel::fnv1a(std::as_bytes(std::span(values)));
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

}  // namespace

std::uint32_t kernel_here() {
  static const std::uint32_t number = kernel_number ^ bits_of_functions();
  return number;
}

std::string kernel_text() { return fmt::format("{:08x}", kernel_here()); }

void refuse_mixed_machines(const parallel::Communicator& world) {
  if (world.size() == 1) return;
  const auto all = world.gather({kernel_here()});
  world.on_root([&] {
    const auto other =
        std::find_if(all.begin(), all.end(), [&](const parallel::Words& rank) { return rank != all[0]; });
    if (other != all.end())
      throw Error(
          fmt::format("rank {} would give other numbers than rank 0 (its machine has another mathematical library, or "
                      "a processor without "
                      "fused multiply-add): run on machines of one kind",
                      other - all.begin()));
  });
}

}  // namespace freestand::study
