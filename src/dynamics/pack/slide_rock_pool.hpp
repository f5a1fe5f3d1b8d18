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
#include "dynamics/pack/slide_rock_hopping.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"
#include "dynamics/pack/slide_rock_slips.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N>
class SlideRockPool {
 public:
  SlideRockPool(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined)
      : cases_(cases), count_(count), responses_(responses), declined_(declined) {
    for (int slot = 0; slot < march_slots; ++slot) r_.clear(slot);
    for (; top_ < march_slots && taken_ < count_; ++top_) {
      lane_of_[top_] = top_;
      refill(top_);
    }
  }

  void run() {
    while (top_ > 0) {
      if (gaps_ > 0) close_gaps();
      const int marching = top_ - waiting_ - slips_.count() - hopping_.count();
      if (waiting_ >= pack_lanes || (waiting_ > 0 && marching == 0)) {
        strike();
        continue;
      }
      if (hopping_.count() >= at_once || (hopping_.count() > 0 && marching == 0)) {
        hop();
        continue;
      }
      if (slips_.count() >= at_once || marching == 0) {
        slip();
        continue;
      }
      if (free_ == 0 && !count_free()) continue;
      --free_;
      const int packs = (top_ + pack_lanes - 1) / pack_lanes;
      Apart apart[march_slots / pack_lanes];
      for (int p = 0; p < packs; ++p) apart[p] = !alive_[p] ? Apart{} : partial_[p] ? march<false>(p) : march<true>(p);
      for (int p = 0; p < packs; ++p)
        for (int l = 0; l < pack_lanes && apart[p].all >> l; ++l)
          if (apart[p].strikes >> l & 1U)
            wait(p * pack_lanes + l);
          else if (apart[p].all >> l & 1U)
            alone(p * pack_lanes + l);
    }
  }

 private:
  // Bits of the lanes in which something happens; of those that strike the floor, and nothing else.
  struct Apart {
    unsigned all = 0, strikes = 0;
  };

  // One interval, or what is left of it, for every lane in which nothing happens.
  template <bool Whole>
  Apart march(int p) {
    const int i = p * pack_lanes;
    const Pack zero(0.0), one(1.0), left = Whole ? one : load(r_.left + i);
    RockSeries<N> y;
    const Pack a = load(r_.a + i), a_next = fetch(r_.next + i), change = a_next - a;
    const Pack push = load(r_.push + i), gravity = load(r_.gravity + i), omega0 = load(r_.omega + i);
    expand<Whole>(y, i, left, omega0, gravity, push, a, change);
    const Pack theta = y.sum(y.theta), rx = y.sum(y.rx), ry = y.sum(y.ry);
    Pack omega = y.sum(y.omega);

    const Pack rate = xsimd::abs(y.omega[0]), reach = rate + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
    const Pack low = xsimd::min(y.theta[0], theta), high = xsimd::max(y.theta[0], theta);
    const PackMask matters = (high + reach > load(r_.look + i)) | (low < reach);
    const PackMask turns = (y.omega[0] * omega <= zero) | turns_twice(y, omega);
    const PackMask strange = (turns & matters) | ~(theta < Pack(1.5)) | (xsimd::abs(y.omega[N + 1]) > Pack(neglected));
    if constexpr (!Whole) omega = omega * (one / left);

    const Pack weight_g = load(r_.weight_g + i), weight = load(r_.weight + i);
    const Pack alpha = rx * gravity - ry * (push * a_next), omega2 = omega * omega;
    const Pack fx = ry * alpha - rx * omega2 + weight * a_next, lift = zero - rx * alpha - ry * omega2;
    const Pack grip0 = load(r_.grip + i), grip = load(r_.mu + i) * (weight_g + lift) - xsimd::abs(fx);
    const Pack square0 = load(r_.square + i), square = fx * fx + lift * lift;
    const Pack bend = load(r_.bend0 + i) + (load(r_.bend1 + i) * xsimd::abs(change) + load(r_.bend2 + i) * rate) * rate;
    const Pack most = xsimd::max(square0, square) * Pack(1 + 1.0 / 256) + Pack(257.0) * (bend * bend);
    const Pack seen = load(r_.seen + i);
    const PackMask slips = xsimd::min(grip0, grip) <= bend, tops = most > seen, falls = theta <= zero;
    const PackMask stays = strange | slips | falls;
    if (const PackMask feels = tops & ~stays; bits(feels)) watch<Whole>(y, i, left, {omega, rx, ry, a_next}, feels);

    store(r_.theta + i, choose(stays, y.theta[0], theta));
    store(r_.omega + i, choose(stays, omega0, omega));
    store(r_.rx + i, choose(stays, y.rx[0], rx));
    store(r_.ry + i, choose(stays, y.ry[0], ry));
    store(r_.a + i, choose(stays, a, a_next));
    store(r_.grip + i, choose(stays, grip0, grip));
    store(r_.square + i, choose(stays, square0, square));
    const unsigned all = bits(stays) & alive_[p];
    if constexpr (!Whole) {
      store(r_.left + i, choose(stays, left, one));
      partial_[p] &= all;
    }
    advance(r_.next + i, alive_[p] & ~all);
    return {all, bits(falls & ~strange & ~slips & ~tops & (y.omega[0] < zero)) & all};
  }

  template <bool Whole>
  void expand(RockSeries<N>& y, int i, const Pack& left, const Pack& omega, const Pack& gravity, const Pack& push,
              const Pack& a, const Pack& change) const {
    y.theta[0] = load(r_.theta + i);
    y.rx[0] = load(r_.rx + i);
    y.ry[0] = load(r_.ry + i);
    if constexpr (Whole) {
      y.omega[0] = omega;
      y.expand(gravity, push * a, push * change);
    } else {
      const Pack left2 = left * left, pushed = push * left2;
      y.omega[0] = omega * left;
      y.expand(gravity * left2, pushed * a, pushed * change);
    }
  }

  // The squared acceleration may have a new peak.
  template <bool Whole>
  void watch(const RockSeries<N>& y, int i, const Pack& left, const RockEnd& end, const PackMask& feels) {
    const Pack seen = load(r_.seen + i), a = load(r_.a + i), left2 = left * left, left4 = left2 * left2;
    RockEnd there = end;
    there.omega = end.omega * left;
    const Pack top = watch_force(y, load(r_.weight + i) * left2, load(r_.gravity + i) * left2,
                                 load(r_.push + i) * left2, a, end.a - a, there, Pack(1.0), seen * left4, true);
    store(r_.seen + i, choose(feels, Whole ? top : top / left4, seen));
  }

  void wait(int slot) {
    set(alive_, slot, false);
    queue_[waiting_++] = slot;
  }

  // Impacts, for a pack of the lanes that wait.
  void strike() {
    int slots[pack_lanes];
    const int count = waiting_ < pack_lanes ? waiting_ : pack_lanes;
    waiting_ -= count;
    for (int l = 0; l < pack_lanes; ++l) slots[l] = queue_[waiting_ + (l < count ? l : 0)];
    const auto gathered = [&](const double* row) {
      alignas(64) double values[pack_lanes];
      for (int l = 0; l < pack_lanes; ++l) values[l] = row[slots[l]];
      return load(values);
    };
    alignas(64) double nexts[pack_lanes];
    for (int l = 0; l < pack_lanes; ++l) nexts[l] = *r_.next[slots[l]];
    const Pack left = gathered(r_.left), left2 = left * left, a = gathered(r_.a);
    const Pack push = gathered(r_.push) * left2;
    RockSeries<N> y;
    y.theta[0] = gathered(r_.theta);
    y.omega[0] = gathered(r_.omega) * left;
    y.rx[0] = gathered(r_.rx);
    y.ry[0] = gathered(r_.ry);
    y.expand(gathered(r_.gravity) * left2, push * a, push * (load(nexts) - a));
    const Pack zero(0.0), one(1.0), end = y.sum(y.theta), guess = first_zero(y.theta[0], y.omega[0], end);
    const Pack part = bracketed_root<N + 1>(y.theta, one, zero, one, guess, end <= zero);
    alignas(64) double parts[pack_lanes], rates[pack_lanes];
    store(parts, part);
    store(rates, y.at(y.omega, part) / left);
    for (int l = 0; l < count; ++l) {
      const int slot = slots[l];
      lanes_[lane_of_[slot]]->strike_at(r_, slot, parts[l], rates[l]);
    }
    for (int l = 0; l < count; ++l) settle(slots[l]);
  }

  // One interval for the lanes that slide-rock.
  void slip() {
    const std::uint64_t apart = slips_.march();
    for (int i = slips_.count() < 64 ? slips_.count() : 64; i-- > 0;) {  // downwards, as the last one fills the gap
      if (!(apart >> i & 1U)) continue;
      const int slot = slips_.slot(i);
      SlideRock<N>& lane = *lanes_[lane_of_[slot]];
      slips_.remove(lane, i);
      lane.go_on();
      settle(slot);
    }
  }

  // To the next impact or knot for the lanes in small hops.
  void hop() {
    const std::uint64_t apart = hopping_.march();
    for (int i = hopping_.count() < 64 ? hopping_.count() : 64; i-- > 0;) {
      if (!(apart >> i & 1U)) continue;
      const int slot = hopping_.slot(i);
      SlideRock<N>& lane = *lanes_[lane_of_[slot]];
      hopping_.remove(lane, i);
      lane.settle();
      settle(slot);
    }
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
    if (lane.slips()) {
      set(alive_, slot, false);
      return slips_.add(lane, slot);
    }
    if (lane.hops()) {
      set(alive_, slot, false);
      return hopping_.add(lane, slot);
    }
    set(alive_, slot, true);
    const int free = lane.enter(r_, slot);
    if (free < free_) free_ = free;
    if (r_.left[slot] < 1) set(partial_, slot, true);
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
        return settle(slot);
      }
      hand_out(lane);
    }
    r_.clear(slot);
    set(alive_, slot, false);
    lane_of_[slot] = none;
    ++gaps_;
  }

  // No more samples: the lanes of the last slots fill the gaps before them, so that few packs are left to march.
  void close_gaps() {
    for (int slot = 0; gaps_ > 0; ++slot) {
      while (gaps_ > 0 && lane_of_[top_ - 1] == none) --top_, --gaps_;
      if (gaps_ == 0 || lane_of_[slot] != none) continue;
      const int last = --top_;
      --gaps_;
      r_.copy(last, slot);
      lane_of_[slot] = lane_of_[last];
      set(alive_, slot, is_set(alive_, last));
      set(partial_, slot, is_set(partial_, last));
      slips_.rename(last, slot);
      hopping_.rename(last, slot);
      for (int k = 0; k < waiting_; ++k)
        if (queue_[k] == last) queue_[k] = slot;
      r_.clear(last);
      set(alive_, last, false);
    }
  }

  static bool is_set(const unsigned* bits, int slot) { return bits[slot / pack_lanes] >> (slot % pack_lanes) & 1U; }
  static void set(unsigned* bits, int slot, bool on) {
    const unsigned bit = 1U << (slot % pack_lanes);
    bits[slot / pack_lanes] = on ? bits[slot / pack_lanes] | bit : bits[slot / pack_lanes] & ~bit;
  }

  // How many intervals every lane can go before one meets the end of its record. False: one has met it, and was seen to.
  bool count_free() {
    int least = 1 << 30;
    for (int slot = 0; slot < top_; ++slot) {
      if (!is_set(alive_, slot)) continue;
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
  SlideRockSlips<N> slips_;
  SlideRockHopping hopping_;
  static constexpr int at_once = 8;
  std::optional<SlideRock<N>> lanes_[march_slots];
  std::size_t number_[march_slots];  // of the lane's sample
  static constexpr int none = -1;
  int lane_of_[march_slots];                         // of the slot
  unsigned alive_[march_slots / pack_lanes] = {};    // bits of the lanes that march
  unsigned partial_[march_slots / pack_lanes] = {};  // from somewhere within an interval
  int queue_[march_slots], waiting_ = 0;
  int top_ = 0, gaps_ = 0;  // slots in use, and those of them without a lane
  int free_ = 0;            // intervals until a record may end
};

template <int N>
void slide_rock_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  SlideRockPool<N>(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
