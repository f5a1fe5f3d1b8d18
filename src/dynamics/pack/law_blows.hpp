// Blocks under laws that rock, stuck, and strike the floor with the corner that is up, a pack of them: those that beyond doubt rock
// on about that corner. The same decisions and bits as Integration::resolve's.
#pragma once

#include "dynamics/blow.hpp"
#include "dynamics/law_step.hpp"
#include "dynamics/pack/lane_numbers.hpp"
#include "dynamics/single_root.hpp"
#include "dynamics/witness.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class LawBlows {
 public:
  LawBlows(LawRows& rows, int first)
      : rows_(rows),
        laws_(*rows.laws),
        first_(first),
        corner_(number(Row::other_corner)),
        inertia_(number(Row::inertia)),
        inertia_there_(number(Row::other_inertia)),
        kept_(number(Row::kept)),
        kept_next_(number(Row::kept_next)) {}

  // Not where friction in a blow follows laws, or legs pass none on.
  bool possible() const {
    return rows_.impact == ImpactLaw::housner || (laws_.friction < 0 && laws_.legs.frequency_radps == 0);
  }

  // Where the corner that is up comes down once within h, beyond doubt: when. height: pivot theta.
  static PackMask comes_down(const Series<Pack, law_order>& height, const Pack& h, Pack& when) {
    constexpr int N = law_order;
    const PackMask down = height[0] == Pack(0.0);  // it rises first: what is sought is the root behind
    Pack c[N + 1], power(1.0), size(0.0);
    for (int k = 0; k <= N; ++k) {
      c[k] = choose(down, k < N ? height[k + 1] : Pack(0.0), height[k]) * power;
      size = size + xsimd::abs(c[k]);
      power = power * h;
    }
    const PackMask falls = falls_once<N>(c) & (size < Pack(std::numeric_limits<double>::infinity()));
    if (bits(falls)) when = choose(falls, only_root<N, LaneNumbers>(c, falls) * h, when);
    return falls;
  }

  // Which of them beyond doubt have one corner down after the blow, that sticks. at: the moment before it.
  PackMask strike(const Standing<Pack>& at) {
    const Pack g = number(Row::gravity), rest = number(Row::rest_rotation), zero(0.0), &h = at.body.h;
    told_ = bits(hop_rotation(inertia_, at.omega, g, at.body.c) >= number(Row::told_rotation));
    PackMask sure = hop_rotation(inertia_there_, at.omega, g, corner_) >= rest;

    to_ = at;
    to_.body.c = corner_;
    to_.pivot = -at.pivot;
    to_.half_base = -at.half_base;  // w is zero, but for the speed of a base on legs
    to_.theta = zero;
    if (rows_.impact == ImpactLaw::housner) {
      to_.omega = kept_ * at.omega;
    } else {
      const Velocity<Pack> before = at_centre(Arm<Pack>{-at.body.c, h}, zero, at.omega);
      const Velocity<Pack> after = stick(at.body.k2, at.mass, Arm<Pack>{-corner_, h}, before);
      const auto [px, py] = impulse(at.mass, before, after);
      if (rows_.can_slip) sure = sure & (xsimd::abs(px) <= at.mu_s * py);
      to_.omega = after.omega;
    }
    sure = sure & (to_.omega * to_.pivot > zero) & (hop_rotation(inertia_there_, to_.omega, g, corner_) >= rest);
    keep_contents_velocity(at);
    if (laws_.walls.any()) sure = sure & clear_of_walls(at);
    return sure & has_room();
  }

  // Which of them go on rocking about that corner, stuck: its forces keep every inequality, with a margin over what counts as
  // zero. arc: of the step after the blow.
  PackMask rocks_on(const LawArc<law_order, Pack>& arc, const Stance<Pack>& stance) const {
    const Pack zero(0.0), force_zero = number(Row::force_zero);
    PackMask sure = zero == zero;
    visit_contact(stance, {}, arc, [&](Witness witness, const Series<Pack, law_order>& y) {
      if (witness != Witness::impact && witness != Witness::upright) sure = sure & (y[0] > force_zero);
    });
    Pack sum(0.0);
    for (int k = 0; k < judged; ++k) sum = sum + (arc.fx[k] + arc.fy[k] + arc.alpha[k] + arc.foot[k]);
    sure = sure & (xsimd::abs(sum) < Pack(std::numeric_limits<double>::infinity()));
    for (int j = 0; j < laws_.tape.kink_count(); ++j)
      sure = sure & (~(arc.kink[j][0] < zero) | (load(rows_.turns_yet[j] + first_) == zero));
    return sure;
  }

  // Those lanes stand on the corner that came down.
  void stand(const PackMask& which, unsigned lanes, Standing<Pack>& at) {
    const auto move = [&](Pack& from, const Pack& to) { from = choose(which, to, from); };
    const auto swap = [&](Pack& x, Pack& y) {
      const Pack before = x;
      move(x, y);
      move(y, before);
    };
    for (int l = 0; l < pack_lanes; ++l) {
      const int struck = lanes >> l & 1U, i = first_ + l;
      rows_.blows[i] += struck;
      rows_.steps[i] += struck;
      rows_.told[i] += struck & static_cast<int>(told_ >> l & 1U);
    }
    swap(at.body.c, corner_);
    swap(inertia_, inertia_there_);
    swap(kept_, kept_next_);
    move(at.pivot, to_.pivot);
    move(at.half_base, to_.half_base);
    move(at.theta, to_.theta);
    move(at.omega, to_.omega);
    move(at.xi, to_.xi);
    move(at.w, to_.w);
    move(at.path, to_.path);
    move(at.deflection, to_.deflection);
    for (int i = 0; i < laws_.states; ++i) move(at.states[i], to_.states[i]);
    if (!laws_.walls.any()) return;
    move(at.right_wall.across, to_.right_wall.across);
    move(at.right_wall.up, to_.right_wall.up);
    move(at.left_wall.across, to_.left_wall.across);
    move(at.left_wall.up, to_.left_wall.up);
  }

  void save(const Standing<Pack>& at) {
    keep(Row::corner, at.body.c);
    keep(Row::pivot, at.pivot);
    keep(Row::half_base, at.half_base);
    keep(Row::other_corner, corner_);
    keep(Row::inertia, inertia_);
    keep(Row::other_inertia, inertia_there_);
    keep(Row::kept, kept_);
    keep(Row::kept_next, kept_next_);
    if (!laws_.walls.any()) return;
    keep(Row::right_across, at.right_wall.across);
    keep(Row::right_up, at.right_wall.up);
    keep(Row::left_across, at.left_wall.across);
    keep(Row::left_up, at.left_wall.up);
  }

 private:
  // Terms by which mode_logic.cpp mostly tells whether a mode stands.
  static constexpr int judged = 3;
  // Steps within a segment after which a sample goes on alone, which looks whether it comes any further.
  static constexpr int most_steps = 9000;

  Pack number(Row row) const { return load(rows_.numbers[static_cast<int>(row)] + first_); }
  void keep(Row row, const Pack& x) { store(rows_.numbers[static_cast<int>(row)] + first_, x); }

  PackMask has_room() const {
    alignas(64) double room[pack_lanes];
    for (int l = 0; l < pack_lanes; ++l) {
      const int i = first_ + l;
      room[l] = rows_.blows[i] + 1 < rows_.room[i] && rows_.steps[i] < most_steps;
    }
    return load(room) > Pack(0.0);
  }

  // As Integration's, by the speed of the centre of mass.
  void keep_contents_velocity(const Standing<Pack>& at) {
    const Rotation<Pack> rotation = rotation_by(at.theta);
    const Pack before = at.w + (at.body.c * rotation.sine + at.body.h * rotation.cosine) * at.omega;
    const Pack jump = (to_.w + at.body.h * to_.omega) - before;
    for (int i = 0; i < laws_.states; ++i)
      if (laws_.relative_velocity[i]) to_.states[i] = to_.states[i] - jump;
  }

  // No edge touches a wall when the block is upright; the edges that are next to the walls on the other corner.
  PackMask clear_of_walls(const Standing<Pack>& at) {
    const Pack zero(0.0), touching = number(Row::touching), between = corner_ - at.body.c, top = Pack(2.0) * at.body.h;
    const PackMask right = to_.pivot > zero;
    to_.right_wall.across = choose(right, zero, between);
    to_.right_wall.up = choose(right, top, zero);
    to_.left_wall.across = choose(right, between, zero);
    to_.left_wall.up = choose(right, zero, top);
    PackMask clear = zero == zero;
    if (laws_.walls.right.stands) clear = clear & (at.right_wall.gap - at.xi > touching);
    if (laws_.walls.left.stands) clear = clear & (at.left_wall.gap + at.xi > touching);
    return clear;
  }

  LawRows& rows_;
  const Laws& laws_;
  const int first_;
  Pack corner_, inertia_, inertia_there_, kept_, kept_next_;  // the other corner; about this one, and that one
  Standing<Pack> to_;
  unsigned told_ = 0;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
