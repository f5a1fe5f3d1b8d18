// Lanes whose blocks do the same thing at present, side by side in rows without gaps.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/pack.hpp"
#include "dynamics/pack/lane_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Rows>
class LaneGroup {
 public:
  LaneGroup() {
    for (double* row : r_.all()) std::fill_n(row, march_slots, 1.0);
    std::fill_n(r_.next, march_slots, still_ground);
    std::fill_n(r_.stop, march_slots, still_ground);
    for (int i = 0; i < march_slots; ++i) r_.retire(i);
  }

  int count() const { return count_; }
  int lane(int i) const { return lane_[i]; }

  template <class Lane>
  auto add(Lane& lane, int number) {
    lane_[count_] = number;
    return lane.enter(r_, count_++);
  }
  // The last one takes the place.
  template <class Lane>
  void remove(Lane& lane, int i) {
    lane.leave(r_, i);
    close(i);
  }
  // As it is, from a group with the same rows.
  void take(LaneGroup& other, int i) {
    lane_[count_] = other.lane_[i];
    copy_lane(r_, count_++, other.r_, i);
    other.close(i);
  }
  const Rows& rows() const { return r_; }
  // Lane `from` of a group with the same rows, as lane `to` of these.
  void copy(int to, LaneGroup& other, int from) { copy_lane(r_, to, other.r_, from); }

 protected:
  using Gravity = typename Rows::Gravity;

  // Bits of the lanes for which march(first lane, bits of the lanes in use) says so, or whose record ends: these first. Full
  // packs alone, if there is one: the lanes of the rest wait for others.
  template <class March>
  std::uint64_t each_pack(March&& march) {
    std::uint64_t apart = 0;
    const int end = count_ < pack_lanes ? count_ : count_ / pack_lanes * pack_lanes;
    for (int i = 0; i < end && i < 64; i += pack_lanes) {
      const unsigned here = (1U << std::min(count_ - i, pack_lanes)) - 1,
                     over = bits_after(r_.next + i, r_.stop + i) & here;
      apart |= static_cast<std::uint64_t>(over ? over : march(i, here) & here) << i;
    }
    return apart;
  }

  Rows r_;

 private:
  void close(int i) {
    if (--count_ != i) {
      copy_lane(r_, i, r_, count_);
      lane_[i] = lane_[count_];
    }
    r_.retire(count_);
  }

  int lane_[march_slots];
  int count_ = 0;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
