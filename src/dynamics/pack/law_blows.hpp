// Blocks under laws that rock, stuck, and strike the floor with the corner that is up, a pack of them: those that beyond doubt rock
// on about that corner. The same decisions and bits as Integration::resolve's.
#pragma once

#include "dynamics/impulse.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/law_step.hpp"
#include "dynamics/pack/lane_numbers.hpp"
#include "dynamics/single_root.hpp"
#include "dynamics/witness.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class LawBlows {
 public:
  explicit LawBlows(LawRows& rows)
      : rows_(rows),
        laws_(*rows.laws),
        corner_(number(Row::other_corner)),
        inertia_(number(Row::inertia)),
        inertia_there_(number(Row::other_inertia)),
        kept_(number(Row::kept)),
        kept_next_(number(Row::kept_next)),
        top_(xsimd::max(number(Row::right_up), number(Row::left_up))) {}

  // Not where friction in a blow follows laws, or legs pass none on.
  bool possible() const {
    return rows_.impact == ImpactLaw::housner || (laws_.friction < 0 && laws_.legs.frequency_radps == 0);
  }

  // Where the corner that is up comes down once within h, beyond doubt: when. height: pivot theta.
  template <int N>
  static PackMask comes_down(const Series<Pack, N>& height, const Pack& h, Pack& when) {
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
    if (rows_.impact == ImpactLaw::housner) {
      omega_ = kept_ * at.omega;
    } else {
      const Velocity<Pack> before = at_centre(Arm<Pack>{-at.body.c, h}, zero, at.omega);
      const Velocity<Pack> after = stick(at.body.k2, at.mass, Arm<Pack>{-corner_, h}, before);
      const auto [px, py] = impulse(at.mass, before, after);
      if (rows_.can_slip) sure = sure & (xsimd::abs(px) <= at.mu_s * py);
      omega_ = after.omega;
    }
    sure = sure & (omega_ * at.pivot < zero) & (hop_rotation(inertia_there_, omega_, g, corner_) >= rest);
    if (laws_.walls.any()) sure = sure & clear_of_walls(at);
    return sure & has_room();
  }

  // Neither the last event that is allowed, nor a step after which the sample looks whether it comes any further.
  PackMask has_room() const {
    alignas(64) double room[pack_lanes];
    for (int l = 0; l < pack_lanes; ++l) {
      const int i = l;
      room[l] = rows_.blows[i] + rows_.kinked[i] + 1 < rows_.room[i] && rows_.steps[i] % StepWatch::watched != 0;
    }
    return load(room) > Pack(0.0);
  }

  // Which of them go on in their mode after a blow, or a kink: its forces keep every inequality, with a margin over what counts as
  // zero. arc: of the step that follows.
  template <int N>
  PackMask goes_on(const LawArc<N, Pack>& arc, const Stance<Pack>& stance) const {
    const Pack zero(0.0), force_zero = number(Row::force_zero);
    PackMask sure = zero == zero;
    visit_contact(stance, {}, arc, [&](Witness witness, const Series<Pack, N>& y) {
      if (witness != Witness::impact && witness != Witness::upright) sure = sure & (y[0] > force_zero);
    });
    Pack sum(0.0);
    for (int k = 0; k < judged; ++k) sum = sum + (arc.fx[k] + arc.fy[k] + arc.alpha[k] + arc.foot[k]);
    return sure & (xsimd::abs(sum) < Pack(std::numeric_limits<double>::infinity()));
  }

  // Those lanes stand on the corner that came down. to: the moment before the blow, and then the one after it.
  void stand(const PackMask& which, unsigned lanes, Standing<Pack>& to) {
    const auto move = [&](Pack& from, const Pack& there) { from = choose(which, there, from); };
    const auto swap = [&](Pack& x, Pack& y) {
      const Pack before = x;
      move(x, y);
      move(y, before);
    };
    for (int l = 0; l < pack_lanes; ++l) {
      const int struck = lanes >> l & 1U, i = l;
      rows_.blows[i] += struck;
      rows_.steps[i] += struck;
      rows_.told[i] += struck & static_cast<int>(told_ >> l & 1U);
    }
    const Pack jump = jump_of_centre(to);
    for (int i = 0; i < laws_.states; ++i)  // contents keep their own velocity
      if (laws_.relative_velocity[i]) move(to.states[i], to.states[i] - jump);
    move(to.theta, Pack(0.0));
    move(to.omega, omega_);
    swap(to.body.c, corner_);
    swap(inertia_, inertia_there_);
    swap(kept_, kept_next_);
    move(to.pivot, -to.pivot);
    move(to.half_base, -to.half_base);
    if (laws_.walls.any()) face_walls(which, to);
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
  Pack number(Row row) const { return load(rows_.numbers[static_cast<int>(row)]); }
  void keep(Row row, const Pack& x) { store(rows_.numbers[static_cast<int>(row)], x); }

  // Of the speed of the centre of mass.
  Pack jump_of_centre(const Standing<Pack>& at) const {
    const Rotation<Pack> rotation = rotation_by(at.theta);
    const Pack before = at.w + (at.body.c * rotation.sine + at.body.h * rotation.cosine) * at.omega;
    return (at.w + at.body.h * omega_) - before;
  }

  // No edge is beside a wall when the block is upright.
  PackMask clear_of_walls(const Standing<Pack>& at) const {
    const Pack beside = number(Row::beside_wall);
    PackMask clear = beside == beside;
    if (laws_.walls.right.stands) clear = clear & (at.right_wall.gap - at.xi > beside);
    if (laws_.walls.left.stands) clear = clear & (at.left_wall.gap + at.xi > beside);
    return clear;
  }
  // The edges that are next to the walls on the corner on which the block now stands: corner_ is the other one.
  void face_walls(const PackMask& which, Standing<Pack>& at) const {
    const Pack zero(0.0), between = at.body.c - corner_;
    const PackMask right = which & (at.pivot > zero), left = which & ~right;
    const auto face = [](ToWall<Pack>& wall, const PackMask& lanes, const Pack& across, const Pack& up) {
      wall.across = choose(lanes, across, wall.across);
      wall.up = choose(lanes, up, wall.up);
    };
    face(at.right_wall, right, zero, top_);
    face(at.right_wall, left, between, zero);
    face(at.left_wall, right, between, zero);
    face(at.left_wall, left, zero, top_);
  }

  LawRows& rows_;
  const Laws& laws_;
  Pack corner_, inertia_, inertia_there_, kept_, kept_next_;  // the other corner; about this one, and that one
  Pack top_;           // height of the upper edge: one side meets its wall with it
  Pack omega_;         // after the blow
  unsigned told_ = 0;  // lanes whose impact counts
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
