// The floor under the lanes of a pack, each at its own place of its own motion: FloorCursor's local(), left() and next_segment().
#pragma once

#include "base/pack.hpp"
#include "dynamics/law_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Motion>
class LaneFloor {
  static constexpr int N = Motion::order, degree = Motion::degree;

 public:
  explicit LaneFloor(LawRows& rows)
      : rows_(rows),
        start_(number(Row::start)),
        offset_(number(Row::offset)),
        stretch_(number(Row::stretch)),
        over_(number(Row::over) > Pack(0.0)) {}

  Pack time() const { return start_ + offset_; }
  // To the end of the segment, or of the sample [s].
  const Pack& left() const { return left_; }

  // Its polynomials about the present instant.
  void look(Floor<Pack, N>& floor) {
    const Pack by = offset_ / stretch_, zero(0.0);
    Pack c[degree + 1];
    for (int k = 0; k <= degree; ++k) c[k] = load(rows_.horizontal[k]);
    if (degree == 1 || bits(by != zero))
#pragma GCC unroll 8
      for (int i = 0; i < degree; ++i)
#pragma GCC unroll 8
        for (int k = degree - 1; k >= i; --k) c[k] = c[k] + by * c[k + 1];
    for (int k = 0; k <= degree; ++k) floor.a[k] = zero + load(rows_.unit[k]) * c[k];
    floor.a[0] = floor.a[0] + number(Row::push);
    floor.g[0] = number(Row::gravity);
    if constexpr (Motion::vertical_degree == 1) {
      const Pack scale = number(Row::vertical_scale), v0 = load(rows_.vertical[0]), v1 = load(rows_.vertical[1]);
      floor.g[0] = zero + scale * (v0 + by * v1) + floor.g[0];
      floor.g[1] = zero + scale / stretch_ * v1;
    }
    next_ = load(rows_.knot) * stretch_;
    left_ = freestand::choose(over_, number(Row::end) - time(), next_ - start_ - offset_);
  }

  // Which lanes a step h takes to a knot.
  unsigned to_knot(const Pack& h) const { return bits(h == left_) & ~bits(over_); }

  // Those lanes go on by h.
  void advance(const PackMask& which, const Pack& h) { offset_ = freestand::choose(which, offset_ + h, offset_); }
  // Which of them are at the end of the time given.
  unsigned at_end() const { return bits(over_ & (time() >= number(Row::end))); }

  // Those lanes go to the next segment. Bit: there is none.
  unsigned next_segment(unsigned which, const PackMask& mask) {
    start_ = freestand::choose(mask, next_, start_);
    offset_ = freestand::choose(mask, Pack(0.0), offset_);
    unsigned over = 0;
    for (; which; which &= which - 1) {
      const int lane = __builtin_ctz(which), i = lane;
      rows_.steps[i] = --rows_.segments[i] > 0;
      if (rows_.segments[i] == 0) {
        over |= 1U << lane;
        continue;
      }
      FloorCursor::Place& place = rows_.place[i];
      ++place.knot_at_end;
      place.horizontal += rows_.coefficients[i];
      if (place.vertical) place.vertical += 2;
      rows_.read_segment(i);
    }
    return over;
  }

  void save() {
    keep(Row::start, start_);
    keep(Row::offset, offset_);
  }

 private:
  Pack number(Row row) const { return load(rows_.numbers[static_cast<int>(row)]); }
  void keep(Row row, const Pack& x) { store(rows_.numbers[static_cast<int>(row)], x); }

  LawRows& rows_;
  Pack start_, offset_, next_, left_;
  const Pack stretch_;
  const PackMask over_;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
