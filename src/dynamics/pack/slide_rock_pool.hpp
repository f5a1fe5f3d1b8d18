// Slide-rock, many samples at once. Lanes that rock march together, one Taylor step per knot interval
// (dynamics/pack/rock_series.hpp), as long as it is certain that nothing happens within: no impact, no turn that could be a
// peak, no loss of grip, no new peak of the acceleration. Any other interval is gone through by the text for single
// samples (dynamics/pack/slide_rock.hpp), which hands the block back at the knot from which it rocks on. Every lane has
// its own sample, record and time; a lane whose sample ends takes the next one.
#pragma once

#include <optional>

#include "base/pack.hpp"
#include "dynamics/pack/rock_series.hpp"
#include "dynamics/pack/slide_rock.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr double neglected = 3e-11;  // least term of a series that counts

template <int N>
class SlideRockPool {
 public:
  SlideRockPool(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined)
      : cases_(cases), count_(count), responses_(responses), declined_(declined) {
    for (int slot = 0; slot < march_slots; ++slot) {
      r_.clear(slot);
      lane_of_[slot] = slot;
    }
    while (top_ < march_slots && taken_ < count_) refill(top_++);
  }

  void run() {
    while (top_ > 0) {
      if (free_ == 0 && !count_free()) continue;
      --free_;
      const int packs = (top_ + pack_lanes - 1) / pack_lanes;
      unsigned apart[march_slots / pack_lanes];
      for (int p = 0; p < packs; ++p) apart[p] = march(p);
      for (int p = packs; p-- > 0;)
        for (int l = pack_lanes; l-- > 0;)  // downwards, as the last slot may fill a gap
          if (apart[p] >> l & 1U) alone(p * pack_lanes + l);
    }
  }

 private:
  // One interval for every lane in which nothing happens; bits of the others.
  unsigned march(int p) {
    const int i = p * pack_lanes;
    const Pack zero(0.0);
    RockSeries<N> y;
    y.theta[0] = load(r_.theta + i);
    y.omega[0] = load(r_.omega + i);
    y.rx[0] = load(r_.rx + i);
    y.ry[0] = load(r_.ry + i);
    const Pack a = load(r_.a + i), a_next = fetch(r_.next + i), change = a_next - a;
    const Pack push = load(r_.push + i), gravity = load(r_.gravity + i);
    y.expand(gravity, push * a, push * change);
    const Pack theta = y.sum(y.theta), omega = y.sum(y.omega), rx = y.sum(y.rx), ry = y.sum(y.ry);

    const Pack rate = xsimd::abs(y.omega[0]), reach = rate + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
    const Pack low = xsimd::min(y.theta[0], theta), high = xsimd::max(y.theta[0], theta);
    const PackMask matters = (high + reach > load(r_.look + i)) | (low < reach);
    const PackMask turns = (y.omega[0] * omega <= zero) | turns_twice(y, omega);
    const PackMask rotates =
        (turns & matters) | (theta <= zero) | ~(theta < Pack(1.5)) | (xsimd::abs(y.omega[N + 1]) > Pack(neglected));

    const Pack weight_g = load(r_.weight_g + i);
    const Pack alpha = rx * gravity - ry * (push * a_next), omega2 = omega * omega;
    const Pack fx = ry * alpha - rx * omega2 + load(r_.weight + i) * a_next, lift = zero - rx * alpha - ry * omega2;
    const Pack grip = load(r_.mu + i) * (weight_g + lift) - xsimd::abs(fx), square = fx * fx + lift * lift;
    const Pack bend = load(r_.bend0 + i) + (load(r_.bend1 + i) * xsimd::abs(change) + load(r_.bend2 + i) * rate) * rate;
    const Pack most = xsimd::max(load(r_.square + i), square) * Pack(1 + 1.0 / 256) + Pack(257.0) * (bend * bend);
    const PackMask feels = (xsimd::min(load(r_.grip + i), grip) <= bend) | (most > load(r_.seen + i));

    const PackMask stays = rotates | feels;
    const unsigned apart = bits(stays) & alive_[p];
    store(r_.theta + i, choose(stays, y.theta[0], theta));
    store(r_.omega + i, choose(stays, y.omega[0], omega));
    store(r_.rx + i, choose(stays, y.rx[0], rx));
    store(r_.ry + i, choose(stays, y.ry[0], ry));
    store(r_.a + i, choose(stays, a, a_next));
    store(r_.grip + i, choose(stays, load(r_.grip + i), grip));
    store(r_.square + i, choose(stays, load(r_.square + i), square));
    advance(r_.next + i, alive_[p] & ~apart);
    return apart;
  }

  void alone(int slot) {
    SlideRock<N>& lane = *lanes_[lane_of_[slot]];
    lane.leave(r_, slot);
    lane.go_on();
    settle(slot);
  }

  // The lane goes on in the packs, or makes room.
  void settle(int slot) {
    SlideRock<N>& lane = *lanes_[lane_of_[slot]];
    if (lane.ended()) {
      hand_out(lane_of_[slot]);
      return refill(slot);
    }
    const int free = lane.enter(r_, slot);
    if (free < free_) free_ = free;
  }

  void hand_out(int lane) {
    const std::size_t number = number_[lane];
    declined_[number] = lanes_[lane]->declined();
    if (!declined_[number]) lanes_[lane]->fill(responses_[number]);
  }

  // The next sample that rocks takes the slot, or the last slot's.
  void refill(int slot) {
    const int lane = lane_of_[slot];
    while (taken_ < count_) {
      const BatchCase& c = cases_[number_[lane] = taken_++];
      if (!(c.mu_k > 0) || c.scale == 0) {
        declined_[number_[lane]] = 1;
        continue;
      }
      lanes_[lane].emplace(c);
      lanes_[lane]->begin();
      if (!lanes_[lane]->ended()) {
        alive_[slot / pack_lanes] |= 1U << (slot % pack_lanes);
        return settle(slot);
      }
      hand_out(lane);
    }
    --top_;
    if (slot != top_) {
      r_.copy(top_, slot);
      lane_of_[slot] = lane_of_[top_];
      lane_of_[top_] = lane;
    }
    r_.clear(top_);
    alive_[top_ / pack_lanes] &= ~(1U << (top_ % pack_lanes));
  }

  // How many intervals every lane can go before one meets the end of its record. False: one has met it, and was seen to.
  bool count_free() {
    int least = 1 << 30;
    for (int slot = 0; slot < top_; ++slot) {
      const int free = static_cast<int>(r_.stop[slot] - r_.next[slot]) + 1;
      if (free <= 0) {
        alone(slot);
        return false;
      }
      if (free < least) least = free;
    }
    free_ = least;
    return true;
  }

  const BatchCase* cases_;
  std::size_t count_;
  Response* responses_;
  std::uint8_t* declined_;
  std::size_t taken_ = 0;
  SlideRockRows r_;
  std::optional<SlideRock<N>> lanes_[march_slots];
  std::size_t number_[march_slots];  // of the lane's sample
  int lane_of_[march_slots];         // of the slot
  unsigned alive_[march_slots / pack_lanes] = {};
  int top_ = 0, free_ = 0;  // slots in use; intervals until a record may end
};

template <int N>
void slide_rock_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  SlideRockPool<N>(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
