// Whether two responses of packs have the same bits: the sign of a zero counts, and what neither knows (NaN) is the same.
#pragma once

#include <cstring>
#include <freestand/response.hpp>

namespace freestand::test {

inline bool same_bits(const Response& a, const Response& b) {
  const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return a.outcome == b.outcome && same(a.peak_slip_m, b.peak_slip_m) && same(a.residual_slip_m, b.residual_slip_m) &&
         same(a.slid_path_m, b.slid_path_m) && same(a.peak_rotation_rad, b.peak_rotation_rad) &&
         same(a.residual_rotation_rad, b.residual_rotation_rad) &&
         same(a.peak_acceleration_mps2, b.peak_acceleration_mps2) && a.impacts == b.impacts && a.events == b.events &&
         same(a.end_time_s, b.end_time_s);
}

}  // namespace freestand::test
