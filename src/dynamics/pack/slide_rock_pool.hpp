// Slide-rock, many samples at once. Every lane has its own sample, record and time, and is in the group of those that do
// the same: they rock, strike the floor, slide-rock, or hop. A group goes on in packs, from time to time or when a pack of
// it is full; what none covers is gone through by the text for single samples (dynamics/pack/slide_rock.hpp), which hands
// the block back where a group can take it. A lane whose sample ends takes the next one.
#pragma once

#include <optional>

#include "dynamics/pack/hopping.hpp"
#include "dynamics/pack/slide_rock.hpp"
#include "dynamics/pack/slide_rock_march.hpp"
#include "dynamics/pack/slide_rock_slides.hpp"
#include "dynamics/pack/slide_rock_slips.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Orders of the steps that rock, and that slip.
template <int N, int M, class Gravity, class Friction>
class SlideRockPool {
 public:
  SlideRockPool(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined)
      : cases_(cases), count_(count), responses_(responses), declined_(declined) {
    for (int lane = 0; lane < march_slots; ++lane) refill(lane);
  }

  void run() {
    for (;;) {
      const bool marching = rocks_.count() > pack_lanes;  // in full packs
      if (ready(hops_, marching))
        to_end(hops_);
      else if (ready(slip_ends_, marching))
        end_slips(slip_ends_);
      else if (ready(slips_, marching))
        to_end(slips_);
      else if (slide(marching))
        continue;
      else if (rocks_.count() == 0)
        return;
      else
        march();
    }
  }

 private:
  using March = SlideRockMarch<N, Gravity>;
  using Apart = typename March::Apart;
  using Slides = SlideRockSlides<slide_order, Gravity, Friction>;
  // Sliding flat is no polynomial of the time.
  static constexpr bool in_series = Friction::by_slip || Gravity::pulls;

  // A pack is full, or there is nothing better to do.
  template <class Group>
  static bool ready(const Group& group, bool marching) {
    return group.count() >= at_once || (group.count() > 0 && !marching);
  }

  bool slide(bool marching) {
    if constexpr (in_series) {
      if (ready(slide_ends_, marching))
        end_slips(slide_ends_);
      else if (ready(slides_, marching))
        to_end(slides_);
      else
        return false;
      return true;
    }
    return false;
  }

  void march() {
    int which = 0;
    if (free_ <= 0) free_ = rocks_.free(which);
    if (free_ <= 0) return alone(which);
    --free_;
    Apart apart[March::packs];
    const int packs = (rocks_.count() + pack_lanes - 1) / pack_lanes;
    const int strikes = rocks_.march(apart);
    if (enough(strikes)) strike(apart, packs);
    clear_upper_parts();
    for (int p = packs; p-- > 0;)
      for (unsigned open = apart[p].others; open;) {  // downwards, as the last one fills a gap
        const int l = 31 - __builtin_clz(open), i = p * pack_lanes + l;
        open &= ~(1U << l);
        if (apart[p].strikes >> l & 1U)
          struck(i);
        else
          alone(i);
      }
  }
  // Impacts are gone through where there are enough of them; the others wait, and fall again in the next march.
  bool enough(int strikes) const {
    return strikes >= pack_lanes || (strikes > 0 && strikes * strikes >= rocks_.count());
  }

  void alone(int i) {
    const int lane = rocks_.lane(i);
    rocks_.remove(*lanes_[lane], i);
    lanes_[lane]->go_on();
    settle(lane);
  }

  // Where it is not certain what follows, `others` says so.
  void strike(Apart* apart, int packs) {
    int slots[march_slots], count = 0;
    for (int p = 0; p < packs; ++p)
      for (unsigned open = apart[p].strikes; open; open &= open - 1)
        slots[count++] = p * pack_lanes + __builtin_ctz(open);
    for (int first = 0; enough(count - first); first += pack_lanes)
      strike(slots + first, std::min(count - first, pack_lanes), apart);
  }
  void strike(const int* slots, int count, Apart* apart) {
    for (int l = 0; l < count; ++l) {
      strikes_.copy(l, rocks_, slots[l]);
      lanes_[rocks_.lane(slots[l])]->come_down(rocks_.rows(), slots[l], strike_.rows, l);
    }
    strikes_.strike(strike_, (1U << count) - 1);
    for (int l = 0; l < count; ++l) {
      const int i = slots[l], p = i / pack_lanes;
      if (strike_.rock >> l & 1U) {
        rocks_.copy(i, strikes_, l);
        lanes_[rocks_.lane(i)]->came_down(rocks_.rows(), i, strike_.rows.peak[l], strike_.told >> l & 1U);
      } else {
        apart[p].others |= 1U << i % pack_lanes;
        if (!(strike_.found >> l & 1U)) apart[p].strikes &= ~(1U << i % pack_lanes);
        impacts_[i] = {strike_.parts[l], strike_.rates[l], strikes_.rows().turned[l], strike_.rows.peak[l]};
      }
    }
  }

  // What follows from an impact, for a lane by itself.
  void struck(int i) {
    const int lane = rocks_.lane(i);
    const Impact impact = impacts_[i];
    rocks_.remove(*lanes_[lane], i);
    lanes_[lane]->strike_at(impact);
    settle(lane);
  }

  // One step for a group that says which lanes leave it.
  template <class Group>
  void to_end(Group& group) {
    const std::uint64_t apart = group.march();
    clear_upper_parts();
    for (int i = group.count() < 64 ? group.count() : 64; i-- > 0;) {
      if (!(apart >> i & 1U)) continue;
      if constexpr (Group::ends_in_packs)
        if (group.ends() >> i & 1U) {
          ends_of(group).take(group, i);
          continue;
        }
      const int lane = group.lane(i);
      group.remove(*lanes_[lane], i);
      group.release(*lanes_[lane]);
      settle(lane);
    }
  }

  auto& ends_of(const SlideRockSlips<M, Gravity, Friction>&) { return slip_ends_; }
  auto& ends_of(const Slides&) { return slide_ends_; }

  // The last pack of the lanes whose slips end.
  template <class Group>
  void end_slips(Group& group) {
    const int first = (group.count() - 1) / pack_lanes * pack_lanes, count = group.count() - first;
    SlipEnds ends;
    group.finish(first, (1U << count) - 1, ends);
    clear_upper_parts();
    for (int l = count; l-- > 0;) {
      const int number = group.lane(first + l);
      SlideRock<N, M, Gravity>& lane = *lanes_[number];
      const bool found = ends.found >> l & 1U;
      if (found) lane.end_in_between();
      group.remove(lane, first + l);
      if (found)
        lane.end_slip(ends.parts[l], ends.impacts >> l & 1U);
      else
        lane.go_on();
      settle(number);
    }
  }

  // The lane goes on in a group, or with the next sample.
  void settle(int number) {
    SlideRock<N, M, Gravity>& lane = *lanes_[number];
    if (lane.ended()) {
      hand_out(number);
      return refill(number);
    }
    if (lane.slips()) return slips_.add(lane, number);
    if constexpr (in_series)
      if (lane.slides()) return slides_.add(lane, number);
    if (lane.hops()) return hops_.add(lane, number);
    const int free = rocks_.add(lane, number);
    if (free < free_) free_ = free;
  }

  void hand_out(int lane) {
    const std::size_t number = number_[lane];
    declined_[number] = lanes_[lane]->declined();
    if (!declined_[number]) lanes_[lane]->fill(responses_[number]);
  }

  // The next sample that moves.
  void refill(int lane) {
    while (taken_ < count_) {
      const BatchCase& c = cases_[number_[lane] = taken_++];
      if (!(c.mu_k > 0) || c.scale == 0) {
        declined_[number_[lane]] = 1;
        continue;
      }
      lanes_[lane].emplace(c);
      lanes_[lane]->begin();
      if (!lanes_[lane]->ended()) return settle(lane);
      hand_out(lane);
    }
  }

  static constexpr int at_once = 8;

  const BatchCase* cases_;
  std::size_t count_;
  Response* responses_;
  std::uint8_t* declined_;
  std::size_t taken_ = 0;
  March rocks_, strikes_;                // those of the next impacts: the first pack of it
  typename March::Strikes strike_ = {};  // a pack that is not full reads it whole
  Impact impacts_[march_slots];          // of the lanes that go on by themselves after it
  SlideRockSlips<M, Gravity, Friction> slips_, slip_ends_;
  Slides slides_, slide_ends_;
  Hopping<Gravity> hops_;
  std::optional<SlideRock<N, M, Gravity>> lanes_[march_slots];
  std::size_t number_[march_slots];  // of the lane's sample
  int free_ = 0;                     // intervals until a record may end
};

template <int N, int M = N, class Friction = Coulomb, class Gravity = Steady>
void slide_rock_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  SlideRockPool<N, M, Gravity, Friction>(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
