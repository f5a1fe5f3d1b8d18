// Whether two histories have the same bits.
#pragma once

#include <algorithm>
#include <freestand/response.hpp>

namespace freestand::test {

inline bool same_points(const HistoryPoint& p, const HistoryPoint& q) {
  return p.time_s == q.time_s && p.floor_acceleration_mps2 == q.floor_acceleration_mps2 && p.slip_m == q.slip_m &&
         p.slip_velocity_mps == q.slip_velocity_mps && p.rotation_rad == q.rotation_rad &&
         p.rotation_rate_radps == q.rotation_rate_radps && p.mode == q.mode &&
         p.acceleration_mps2 == q.acceleration_mps2 && p.vertical_acceleration_mps2 == q.vertical_acceleration_mps2 &&
         p.contact_x_mps2 == q.contact_x_mps2 && p.contact_y_mps2 == q.contact_y_mps2;
}

inline bool same_points(const Event& p, const Event& q) {
  return p.time_s == q.time_s && p.from == q.from && p.to == q.to && p.pivot == q.pivot && p.impact == q.impact;
}

inline bool same_histories(const History& a, const History& b) {
  const auto same = [](const auto& p, const auto& q) { return same_points(p, q); };
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same) &&
         std::equal(a.events.begin(), a.events.end(), b.events.begin(), b.events.end(), same);
}

}  // namespace freestand::test
