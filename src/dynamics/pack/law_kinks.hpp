// Kinks of laws, a pack of samples: those that stay as they are over a step, and those of which one turns in it, beyond doubt, while
// the mode lasts. The same decisions and bits as FirstEvent's, Kinks' and Integration::resolve's.
#pragma once

#include "dynamics/pack/lane_numbers.hpp"
#include "dynamics/pack/lane_roots.hpp"
#include "dynamics/standing.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class LawKinks {
 public:
  explicit LawKinks(LawRows& rows) : rows_(rows), laws_(*rows.laws), count_(laws_.tape.kink_count()) {
    for (int j = 0; j < count_; ++j) met_ |= bits(load(rows_.met[j]) > Pack(0.0));
  }

  // One turns within the step.
  const PackMask& turn() const { return turn_; }

  // Of those lanes, which have kinks that stay as they are to the end of a step h, or to shortly before a blow, or one that turns first, at
  // `reach`, and so before the blow. strikes, blow: which lanes strike, and when a kink is the blow's.
  template <int N>
  PackMask stay_or_turn(const Series<Pack, N>* kink, const Pack& h, PackMask& strikes, const Pack& blow, unsigned lanes,
                        Pack& reach) {
    const Pack instant = number(Row::instant);
    PackMask sure = h == h;
    Pack within = choose(strikes, blow, h);
    turn_ = h < h;
    for (int j = 0; j < count_; ++j) {
      const Series<Pack, N>& y = kink[j];
      PackMask stays =
          ((surely_positive(y, within) | surely_rises_from_zero(y, within, Pack(0.0))) & (within > instant)) |
          (load(rows_.turns_yet[j]) == Pack(0.0));
      PackMask falls = h < h;
      if (lanes & ~bits(stays)) {
        const PackMask open = ~stays & tells(y, instant);
        Pack when = within;
        falls = falls_within(y, within, lanes & bits(open), 0, Pack(0.0), when);
        falls = falls & (~turn_ | (when < within));
        within = choose(falls, when, within);
        stays = stays | (open & ~falls);
        if (!laws_.walls.any() && !laws_.tape.is_latch(j)) stays = stays | (falls & (when > instant));
      }
      for (int i = 0; i < j; ++i) store(turns_[i], choose(falls, Pack(0.0), load(turns_[i])));
      store(turns_[j], choose(falls, Pack(1.0), Pack(0.0)));
      turn_ = turn_ | falls;
      sure = sure & stays;
    }
    strikes = strikes & ~turn_;
    reach = choose(turn_, within, reach);
    return sure;
  }

  // Where one turns: does nothing else happen there? to: the state at that instant.
  PackMask alone(const Standing<Pack>& to, bool turning, bool slipping) const {
    PackMask sure = to.theta == to.theta;
    if (turning) sure = to.pivot * to.theta > number(Row::rest_rotation);
    if (slipping) sure = sure & (to.sigma * to.w > Pack(0.0));
    return sure;
  }

  // Those lanes have gone on by reach: they have left their kinks behind, or have come to one.
  void go_on(unsigned lanes, const Pack& reach) {
    const unsigned turned = bits(turn_) & lanes;
    if (!(met_ | turned)) return;
    const Pack instant = number(Row::instant);
    const PackMask leave = lanes_of(bits(reach > instant) & lanes), meet = lanes_of(turned);
    met_ = 0;
    for (int j = 0; j < count_; ++j) {
      const PackMask turns = meet & (load(turns_[j]) > Pack(0.0));
      const Pack side = load(rows_.side[j]);
      const Pack met = choose(turns, Pack(1.0), choose(leave, Pack(0.0), load(rows_.met[j])));
      store(rows_.side[j], choose(turns, -side, side));
      store(rows_.met[j], met);
      met_ |= bits(met > Pack(0.0));
    }
    for (unsigned open = turned; open; open &= open - 1) ++rows_.kinked[__builtin_ctz(open)];
  }

  // A blow makes speeds jump.
  void leave(unsigned lanes) {
    if (!(met_ & lanes)) return;
    for (int j = 0; j < count_; ++j) store(rows_.met[j], choose(lanes_of(lanes), Pack(0.0), load(rows_.met[j])));
    met_ &= ~lanes;
  }

  // Which of them keep their kinks in the mode that is to be chosen now.
  template <int N>
  PackMask keep(const Series<Pack, N>* kink) const {
    const Pack instant = number(Row::instant);
    PackMask sure = instant == instant;
    for (int j = 0; j < count_; ++j) {
      const Series<Pack, N>& y = kink[j];
      const PackMask rises = (y[0] > Pack(0.0)) | ((y[0] == Pack(0.0)) & (y[1] > Pack(0.0)));
      sure = sure & ((tells(y, instant) & rises) | (load(rows_.turns_yet[j]) == Pack(0.0)));
    }
    return sure;
  }

 private:
  Pack number(Row row) const { return load(rows_.numbers[static_cast<int>(row)]); }
  // Its first term is none that past_instant() takes for round-off, or is zero, and then the next one is none.
  template <int N>
  static PackMask tells(const Series<Pack, N>& y, const Pack& instant) {
    const PackMask zero = y[0] == Pack(0.0);
    return (~zero & (xsimd::abs(y[0]) > size_of_rest<1>(y, instant))) |
           (zero & (xsimd::abs(y[1]) * instant > size_of_rest<2>(y, instant)));
  }

  LawRows& rows_;
  const Laws& laws_;
  const int count_;
  unsigned met_ = 0;  // lanes that have met one at this instant
  PackMask turn_;
  alignas(64) double turns_[max_kinks][pack_lanes] = {};
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
