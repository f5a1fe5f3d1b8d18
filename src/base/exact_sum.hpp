// Sums that do not depend on the order of their terms.
//
// A term is rounded once to a multiple of 2^-40 and added as a 128-bit integer. Integer addition is associative, so any
// number of ranks, in any order, gets the same bits. Range: |sum| < 2^87 (about 1e26); resolution 9e-13 a term.
#pragma once

#include <cmath>
#include <cstdint>

namespace freestand {

class ExactSum {
 public:
  // value: finite, |value| < 2^80.
  void add(double value) {
    const double units = std::nearbyint(value * scale);
    // Most terms fit into 64 bits, whose conversion is one instruction.
    units_ +=
        std::abs(units) < 0x1p62 ? static_cast<Int128>(static_cast<std::int64_t>(units)) : static_cast<Int128>(units);
  }
  void add(const ExactSum& other) { units_ += other.units_; }
  double value() const { return static_cast<double>(units_) / scale; }

  // The 128 bits as two words, for messages and files.
  std::int64_t high() const { return static_cast<std::int64_t>(units_ >> 64); }
  std::uint64_t low() const { return static_cast<std::uint64_t>(units_); }
  static ExactSum from_words(std::int64_t high, std::uint64_t low) {
    ExactSum sum;
    sum.units_ = static_cast<Int128>((static_cast<unsigned __int128>(static_cast<std::uint64_t>(high)) << 64) | low);
    return sum;
  }
  bool operator==(const ExactSum&) const = default;

 private:
  __extension__ using Int128 = __int128;
  static constexpr double scale = 1099511627776.0;  // 2^40
  Int128 units_ = 0;
};

}  // namespace freestand
