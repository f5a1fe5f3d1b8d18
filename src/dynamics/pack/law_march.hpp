// Samples under laws, a pack of them at once, each at its own time and in its own step, while nothing happens: no event that is not
// excluded beyond doubt, but for blows of a block that rocks on and kinks of laws that turn. The same steps, with the same decisions and the
// same bits, as taylor_integrator.hpp goes one by one.
#pragma once

#include "dynamics/law_step.hpp"
#include "dynamics/pack/lane_extremes.hpp"
#include "dynamics/pack/lane_floor.hpp"
#include "dynamics/pack/lane_history.hpp"
#include "dynamics/pack/lane_numbers.hpp"
#include "dynamics/pack/law_blows.hpp"
#include "dynamics/pack/law_kinks.hpp"
#include "dynamics/peaks.hpp"
#include "dynamics/taylor_integrator.hpp"
#include "dynamics/witness.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Motion, bool turning, bool slipping>
class LawMarchOf {
  static constexpr int N = Motion::order;
  using Step = LawStep<N, Pack, LaneNumbers, Kind<turning, slipping, Motion>>;
  using Arc = LawArc<N, Pack>;
  using End = LawStep<1, Pack, LaneNumbers, Kind<turning, slipping, Motion>>;

 public:
  explicit LawMarchOf(LawRows& rows)
      : rows_(rows),
        laws_(*rows.laws),
        straight_(laws_.straight(slipping)),
        grip_changes_(!slipping && laws_.grip_changes()),
        on_legs_(laws_.legs.frequency_radps > 0),
        base_moves_(slipping || on_legs_),
        numbers_(rows),
        cursor_(rows),
        floor_{Series<Pack, N>::zero(), Series<Pack, N>::zero()},
        there_{Series<Pack, 1>::zero(), Series<Pack, 1>::zero()},
        step_(laws_, here_, numbers_, {}, floor_),
        end_(laws_, to_, numbers_, {}, there_),
        blows_(rows),
        kinks_(rows),
        history_(rows),
        stance_{turning,
                slipping,
                rows.can_slip,
                rows.can_rock,
                number(Row::pivot),
                number(Row::sigma),
                number(Row::right_arm),
                number(Row::left_arm),
                number(Row::over_height)} {
    load_constants(here_);
    load_constants(to_);
    load_state();
  }

  // Goes on until a lane stops: gaps in a pack cost more than going in and out of it.
  Stopped run(double* series) {
    const int here = rows_.lanes < pack_lanes ? rows_.lanes : pack_lanes;
    const unsigned lanes_here = (1U << here) - 1;
    struck_ &= lanes_here, turned_ &= lanes_here;
    Stopped stopped{0, 0, 0, 0};
    while (!stopped.any()) {
      cursor_.look(floor_);
      const Arc& arc = step_.run();
      h_ = reach_ = length_of_step(arc, lanes_here);
      const unsigned solved = bits(step_.has_found_forces());
      PackMask sure = nothing_happens(arc, lanes_here) & step_.has_found_forces();
      sure = sure & follows_laws(arc);
      if (bits(strikes_)) sure = sure & (~strikes_ | blows_.strike(to_));
      if (bits(kinks_.turn()))
        sure = sure & (~kinks_.turn() | (blows_.has_room() & kinks_.alone(to_, turning, slipping)));
      if (const unsigned just = struck_ | turned_)
        stopped.undecided = just & ~(bits(blows_.goes_on(arc, stance_) & kinks_.keep(arc.kink)) & solved);
      history_.rocked_on(struck_ & ~stopped.undecided, cursor_.time(), here_.pivot);
      struck_ &= stopped.undecided;
      turned_ &= stopped.undecided;
      const unsigned free = see_extremes(arc, bits(sure) & lanes_here & ~stopped.undecided);
      stopped.before_step = lanes_here & ~(free | stopped.undecided) & solved;
      stopped.unsolved = lanes_here & ~(free | stopped.undecided) & ~solved;
      for (unsigned open = stopped.before_step; open; open &= open - 1) tell(arc, __builtin_ctz(open), series);
      history_.record(free, arc, u_, floor_, here_, laws_.lift >= 0, cursor_.time(), reach_);
      stopped.at_end = go_on(free);
    }
    save();
    return stopped;
  }

 private:
  Pack number(Row row) const { return load(rows_.numbers[static_cast<int>(row)]); }
  void keep(Row row, const Pack& x) { store(rows_.numbers[static_cast<int>(row)], x); }
  static Row state_row(int i) { return static_cast<Row>(static_cast<int>(Row::state) + i); }

  void load_constants(Standing<Pack>& at) {
    at.body = {number(Row::corner), number(Row::height), number(Row::gyration2)};
    at.half_base = number(Row::half_base);
    at.mu_k = number(Row::mu_k);
    at.mu_s = number(Row::mu_s);
    at.mass = number(Row::mass);
    at.leg_rate = number(Row::leg_rate);
    at.leg_damping = number(Row::leg_damping);
    at.pivot = number(Row::pivot);
    at.sigma = number(Row::sigma);
    at.still_since = number(Row::still_since);
    at.right_wall = {number(Row::right_gap), number(Row::right_across), number(Row::right_up)};
    at.left_wall = {number(Row::left_gap), number(Row::left_across), number(Row::left_up)};
  }

  void load_state() {
    here_.theta = number(Row::theta);
    here_.omega = number(Row::omega);
    here_.xi = number(Row::xi);
    here_.w = number(Row::w);
    here_.path = number(Row::path);
    here_.deflection = number(Row::deflection);
    for (int i = 0; i < laws_.states; ++i) here_.states[i] = number(state_row(i));
    here_.time = cursor_.time();
    slip_ = number(Row::peak_slip);
    slip_right_ = number(Row::peak_slip_right);
    slip_left_ = number(Row::peak_slip_left);
    slid_ = number(Row::slid_path);
    rotation_ = number(Row::peak_rotation);
    acceleration_ = number(Row::peak_acceleration);
    for (int l = 0; l < pack_lanes; ++l) {
      struck_ |= unsigned{rows_.just[l] == Just::struck} << l;
      turned_ |= unsigned{rows_.just[l] == Just::turned} << l;
    }
  }

  void save() {
    const Standing<Pack>& at = here_;
    keep(Row::theta, at.theta);
    keep(Row::omega, at.omega);
    keep(Row::xi, at.xi);
    keep(Row::w, at.w);
    keep(Row::path, at.path);
    keep(Row::deflection, at.deflection);
    keep(Row::still_since, at.still_since);
    for (int i = 0; i < laws_.states; ++i) keep(state_row(i), at.states[i]);
    cursor_.save();
    history_.save();
    keep(Row::peak_slip, slip_);
    keep(Row::peak_slip_right, slip_right_);
    keep(Row::peak_slip_left, slip_left_);
    keep(Row::slid_path, slid_);
    keep(Row::peak_rotation, rotation_);
    keep(Row::peak_acceleration, acceleration_);
    for (int l = 0; l < pack_lanes; ++l)
      rows_.just[l] = struck_ >> l & 1U ? Just::struck : turned_ >> l & 1U ? Just::turned : Just::nothing;
    if (turning && !slipping) blows_.save(at);
  }

  // As TaylorIntegrator's.
  Pack length_of_step(const Arc& arc, unsigned lanes_here) const {
    const Pack longest = number(Row::longest_step_s), whole = xsimd::min(cursor_.left(), longest);
    Pack last(0.0);
    const auto neglects = [&](const Series<Pack, N>& y, Row over) {
      last = xsimd::max(last, xsimd::abs(y[N]) * number(over));
    };
    if (base_moves_) {
      neglects(arc.xi, Row::over_length);
      neglects(arc.w, Row::over_speed);
      neglects(arc.path, Row::over_length);
    }
    if (on_legs_) neglects(arc.deflection, Row::over_length);
    if (turning) {
      neglects(arc.theta, Row::over_angle);
      neglects(arc.omega, Row::over_rotation);
    }
    for (int i = 0; i < laws_.states; ++i)
      neglects(arc.states[i], laws_.relative_velocity[i] ? Row::over_speed : Row::over_length);
    const PackMask good = last * whole_power<N>(whole) <= Pack(rows_.tolerance);
    if (!(lanes_here & ~bits(good))) return whole;
    alignas(64) double h[pack_lanes];
    store(h, last);
    for (unsigned open = lanes_here & ~bits(good); open; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(open));
      const double unit = longest.get(lane);
      h[lane] = unit * pow_outside(rows_.tolerance / (h[lane] * whole_power<N>(unit)), 1.0 / N);
    }
    return freestand::choose(good, whole, load(h));
  }

  // No witness can turn within the step, or only the raised corner comes down, or only a kink turns.
  PackMask nothing_happens(const Arc& arc, unsigned lanes_here) {
    strikes_ = h_ < h_;
    Pack blow = h_;  // when kinks are no more the blow's
    PackMask sure = h_ > Pack(shortest_step) * number(Row::longest_step_s);
    if (const unsigned within = lanes_here & ~cursor_.to_knot(h_)) sure = sure & lanes_of(~(within & watched()));
    if (slipping && laws_.friction >= 0) sure = sure & (arc.friction >= Pack(0.0));
    visit_contact(stance_, {}, arc, [&](Witness witness, const Series<Pack, N>& y) {
      const bool impact = witness == Witness::impact, may_strike = impact && !slipping && blows_.possible();
      PackMask positive = surely_positive(y, h_);
      if (impact) positive = positive | surely_rises_from_zero(y, h_, Pack(0.0));
      if (witness == Witness::slipping) positive = positive | surely_rises_from_zero(y, h_, number(Row::force_zero));
      if (impact && (bits(~positive) & lanes_here)) {
        positive = positive | surely_positive_by_shape(y, h_);
        if (may_strike) strikes_ = ~positive & blows_.comes_down(y, h_, reach_);
      }
      if (const unsigned open = lanes_here & bits(sure & ~(positive | strikes_))) {
        const auto [level, zero] = zero_of(witness, number(Row::force_zero), number(Row::turn_zero));
        Pack when = reach_;
        const PackMask falls = falls_within(y, reach_, open, level, zero, when);
        positive = positive | (lanes_of(open) & ~falls);
        if (may_strike) strikes_ = strikes_ | (falls & (when > Pack(0.0)));
        if (may_strike) reach_ = freestand::choose(falls, when, reach_);
      }
      if (impact && bits(strikes_))
        blow = xsimd::max(reach_ - before_blow(y, reach_, number(Row::rest_rotation)), Pack(0.0));
      sure = sure & (impact ? positive | strikes_ : positive);
    });
    if (laws_.walls.any()) sure = sure & clear_of_walls(arc);
    return sure & kinks_.stay_or_turn(arc.kink, h_, strikes_, blow, lanes_here, reach_);
  }

  PackMask clear_of_walls(const Arc& arc) const {
    PackMask clear = Pack(0.0) == Pack(0.0);
    const Pack touching = number(Row::touching);
    for (const int side : {1, -1}) {
      if (!laws_.walls.on(side).stands) continue;
      const Series<Pack, N>& gap = side > 0 ? arc.right_gap : arc.left_gap;
      if (!turning) clear = clear & (gap[0] > touching);
      if (turning || slipping) clear = clear & surely_positive(gap, h_);
    }
    return clear;
  }

  // Leaves in to_ the state at the end of the step.
  PackMask follows_laws(const Arc& arc) {
    Standing<Pack>& to = to_;
    const Pack bound(beyond_all_bounds);
    to.theta = turning ? arc.theta.at(reach_) : Pack(0.0);
    to.omega = turning ? arc.omega.at(reach_) : Pack(0.0);
    to.xi = base_moves_ ? arc.xi.at(reach_) : here_.xi;
    to.w = base_moves_ ? arc.w.at(reach_) : here_.w;
    to.path = slipping ? arc.path.at(reach_) : here_.path;
    to.deflection = on_legs_ ? arc.deflection.at(reach_) : here_.deflection;
    for (int i = 0; i < laws_.states; ++i) to.states[i] = arc.states[i].at(reach_);
    to.time = here_.time + reach_;
    PackMask follows = (xsimd::abs(to.theta) < bound) & (xsimd::abs(to.omega) < bound) & (xsimd::abs(to.xi) < bound) &
                       (xsimd::abs(to.w) < bound);
    if (straight_ && !grip_changes_) return follows;
    there_.a[0] = floor_.a.at(reach_);
    there_.g[0] = floor_.g.at(reach_);
    const LawArc<1, Pack>& fresh = grip_changes_ ? end_.run() : end_.accelerations();
    const Pack allowed(defect_allowed * rows_.tolerance);
    const auto little = [&](const Pack& missed, Row over) {
      return xsimd::abs(missed) * number(over) * reach_ <= allowed;
    };
    follows = follows & end_.has_found_forces() & little(fresh.w[1] - derivative(arc.w).at(reach_), Row::over_speed);
    if (turning) follows = follows & little(fresh.omega[1] - derivative(arc.omega).at(reach_), Row::over_rotation);
    if (grip_changes_)
      follows = follows & little(fresh.limit_right[0] - arc.limit_right.at(reach_), Row::over_speed) &
                little(fresh.limit_left[0] - arc.limit_left.at(reach_), Row::over_speed);
    return follows;
  }

  Pack largest(const Series<Pack, N>& y, const Pack& before, unsigned wanted) const {
    const PackMask within = surely_within(y, reach_, before);
    if (!(wanted & ~bits(within))) return before;
    return extreme(y, reach_, within, xsimd::abs(y[0]), xsimd::abs(y.at(reach_)), before, wanted, detail::max_abs);
  }

  // As Peaks::observe, of the lanes wanted; of which of them there are any.
  unsigned see_extremes(const Arc& arc, unsigned wanted) {
    const Standing<Pack>& at = here_;
    u_ = turning ? midpoint(at.body, at.half_base, arc, arc.versine) : arc.xi;
    new_slip_ = largest(u_, slip_, wanted);
    if (rows_.slip_by_side) {
      const Pack last = u_.at(reach_);
      const auto side = [&](const Series<Pack, N>& y, const Pack& first, const Pack& end, const Pack& before) {
        return extreme(y, reach_, surely_within(y, reach_, before), first, end, before, wanted, detail::max_of);
      };
      new_slip_right_ = side(u_, u_[0], last, slip_right_);
      new_slip_left_ = side(scaled(Pack(-1.0), u_), -u_[0], -last, slip_left_);
    }
    new_rotation_ = turning ? largest(arc.theta, rotation_, wanted) : rotation_;
    new_slid_ = slid_ + (to_.path - arc.path[0]);
    return see_acceleration(arc, wanted);
  }

  unsigned see_acceleration(const Arc& arc, unsigned wanted) {
    Series<Pack, N> x = arc.ax, y = laws_.lift < 0 ? arc.fy : combination(Pack(1.0), arc.fy, Pack(1.0), arc.lift);
    x[0] = x[0] - number(Row::push);
    y[0] = y[0] - number(Row::gravity);
    const Pack peak2 = acceleration_ * acceleration_;
    const Pack bound_x = size_of_rest<0>(x, reach_), bound_y = size_of_rest<0>(y, reach_);
    const Pack bound2 = bound_x * bound_x + bound_y * bound_y;
    const PackMask within = bound2 <= peak2 * Pack(same_peak);
    new_acceleration_ = acceleration_;
    const unsigned may_exceed = wanted & ~bits(within);
    if (!may_exceed) return wanted;
    const PackMask finite = bound2 < Pack(std::numeric_limits<double>::infinity());
    const Pack peak = largest(squared_length(x, y), peak2, may_exceed & bits(finite));
    new_acceleration_ = freestand::choose(within, acceleration_, xsimd::sqrt(peak));
    return wanted & bits(finite);
  }

  // Those that are free go to the end of their step; bit l: lane l is at the end of its motion, or of its time.
  unsigned go_on(unsigned free) {
    const unsigned struck = bits(strikes_) & free, turned = bits(kinks_.turn()) & free,
                   at_knot = cursor_.to_knot(h_) & free & ~(struck | turned);
    const PackMask goes = lanes_of(free);
    cursor_.advance(goes, reach_);
    unsigned at_end = at_knot ? cursor_.next_segment(at_knot, lanes_of(at_knot)) : 0;
    const unsigned within = free & ~at_knot & ~struck;
    if (within) {
      const unsigned ends = cursor_.at_end() & within;
      at_end |= ends;
      for (unsigned open = within & ~ends; open; open &= open - 1) ++rows_.steps[__builtin_ctz(open)];
    }
    const auto move = [&](Pack& from, const Pack& to) { from = freestand::choose(goes, to, from); };
    Standing<Pack>&at = here_, &to = to_;
    kinks_.go_on(free, reach_);
    turned_ |= turned;
    if (turned && slipping) at.still_since = freestand::choose(lanes_of(turned), cursor_.time(), at.still_since);
    if (struck) {
      kinks_.leave(struck);
      at.still_since = freestand::choose(lanes_of(struck), cursor_.time(), at.still_since);
      blows_.stand(lanes_of(struck), struck, to);
      at.body.c = to.body.c;
      at.half_base = to.half_base;
      at.pivot = stance_.pivot = to.pivot;
      at.right_wall = to.right_wall;
      at.left_wall = to.left_wall;
      struck_ |= struck;
    }
    move(at.theta, to.theta);
    move(at.omega, to.omega);
    move(at.xi, to.xi);
    move(at.w, to.w);
    move(at.path, to.path);
    move(at.deflection, to.deflection);
    for (int i = 0; i < laws_.states; ++i) move(at.states[i], to.states[i]);
    at.time = cursor_.time();
    move(slip_, new_slip_);
    if (rows_.slip_by_side) {
      move(slip_right_, new_slip_right_);
      move(slip_left_, new_slip_left_);
    }
    move(slid_, new_slid_);
    move(rotation_, new_rotation_);
    move(acceleration_, new_acceleration_);
    return at_end;
  }

  // Those that look before their next step whether they come any further (StepWatch::watched).
  unsigned watched() const {
    unsigned which = 0;
    for (int l = 0; l < pack_lanes; ++l) which |= unsigned{rows_.steps[l] % StepWatch::watched == 0} << l;
    return which;
  }

  // The series of one lane.
  void tell(const Arc& arc, int lane, double* series) const {
    using Numbers = LawArcNumbers<N>;
    const double* from = reinterpret_cast<const double*>(&arc) + lane;
    double* to = series + lane * Numbers::all;
    const auto copy = [&](int begin, int end) {
      for (int i = begin; i < end; ++i) to[i] = from[i * pack_lanes];
    };
    copy(0, laws_.lift >= 0 ? Numbers::walls : Numbers::lift);
    if (laws_.walls.any()) copy(Numbers::walls, Numbers::states);
    copy(Numbers::states, Numbers::states + laws_.states * Numbers::series);
    copy(Numbers::kinks, Numbers::kinks + laws_.tape.kink_count() * Numbers::series);
  }

  LawRows& rows_;
  const Laws& laws_;
  const bool straight_, grip_changes_, on_legs_;
  const bool base_moves_;  // the point of contact, or the base over legs
  const LaneNumbers numbers_;
  Pack h_, reach_;                    // the step, and how much of it there is before a blow or a kink [s]
  PackMask strikes_;                  // within the step
  unsigned struck_ = 0, turned_ = 0;  // before it
  Pack slip_, slip_right_, slip_left_, slid_, rotation_, acceleration_;
  Pack new_slip_, new_slip_right_, new_slip_left_, new_slid_, new_rotation_, new_acceleration_;
  Standing<Pack> here_, to_;
  LaneFloor<Motion> cursor_;
  Floor<Pack, N> floor_;
  Floor<Pack, 1> there_;
  Step step_;
  End end_;
  LawBlows blows_;
  LawKinks kinks_;
  LaneHistory history_;
  Series<Pack, N> u_;  // of the base's midpoint
  Stance<Pack> stance_;
};

template <class Motion, bool turning, bool slipping>
Stopped law_march(LawRows& rows, double* series) {
  const Stopped stopped = LawMarchOf<Motion, turning, slipping>(rows).run(series);
  clear_upper_parts();
  return stopped;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
