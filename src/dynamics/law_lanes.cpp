#include "dynamics/law_lanes.hpp"

#include <deque>
#include <limits>
#include <memory>
#include <optional>

#include "dynamics/impact.hpp"
#include "dynamics/pulse_slide.hpp"
#include "dynamics/taylor_integrator.hpp"

namespace freestand::dynamics {
namespace {

// Samples of one mode, whose laws have the same shape.
template <class Motion>
class Group {
  using Integrator = IntegratorOf<Motion>;

 public:
  Group(const Integration& trajectory, const Settings& settings)
      : laws_(*trajectory.rig.laws), rows_(std::make_unique<LawRows>()) {
    rows_->laws = &laws_;
    rows_->turns = trajectory.state.pivot != 0;
    rows_->slips = trajectory.state.sigma != 0;
    rows_->can_slip = trajectory.rig.can_slip;
    rows_->can_rock = trajectory.rig.can_rock;
    rows_->slip_by_side = settings.slip_by_side;
    rows_->impact = trajectory.rig.impact.law;
    rows_->tolerance = settings.tolerance;
  }

  bool takes(const Integration& trajectory) const {
    return rows_->turns == (trajectory.state.pivot != 0) && rows_->slips == (trajectory.state.sigma != 0) &&
           rows_->can_slip == trajectory.rig.can_slip && rows_->can_rock == trajectory.rig.can_rock &&
           rows_->impact == trajectory.rig.impact.law && laws_.same_shape(*trajectory.rig.laws);
  }
  int count() const { return rows_->lanes; }
  int lane(int slot) const { return lane_[slot]; }
  LawRows& rows() { return *rows_; }

  void enter(int lane, Integrator& integrator) {
    const int i = rows_->lanes++;
    lane_[i] = lane;
    write_tape(i, *integrator.trajectory().rig.laws);
    write(i, integrator);
  }

  // The sample as it is now; the numbers of its tape are there.
  void write(int i, Integrator& integrator) {
    const Integration& trajectory = integrator.trajectory();
    const Rig& rig = trajectory.rig;
    const State& state = trajectory.state;
    const int pivot = state.pivot != 0 ? state.pivot : 1;
    const Standing<double> at = standing_of(rig, state, trajectory.cursor.time());
    const Sizes& size = integrator.sizes();
    const Response& peaks = trajectory.peaks.response();
    const FloorCursor::Place place = trajectory.cursor.place();
    const auto set = [&](Row row, double x) { rows_->row(row)[i] = x; };
    set(Row::corner, rig.offset(pivot));
    set(Row::height, rig.h);
    set(Row::gyration2, rig.k2);
    set(Row::half_base, at.half_base);
    set(Row::mu_k, rig.mu_k);
    set(Row::mu_s, rig.mu_s);
    set(Row::mass, at.mass);
    set(Row::leg_rate, at.leg_rate);
    set(Row::leg_damping, at.leg_damping);
    set(Row::pivot, at.pivot);
    set(Row::sigma, at.sigma);
    set(Row::theta, state.theta);
    set(Row::omega, state.omega);
    set(Row::xi, state.xi);
    set(Row::w, state.w);
    set(Row::path, state.path);
    set(Row::deflection, state.deflection);
    set(Row::still_since, state.still_since);
    set(Row::right_gap, at.right_wall.gap);
    set(Row::right_across, at.right_wall.across);
    set(Row::right_up, at.right_wall.up);
    set(Row::left_gap, at.left_wall.gap);
    set(Row::left_across, at.left_wall.across);
    set(Row::left_up, at.left_wall.up);
    set(Row::other_corner, rig.offset(-pivot));
    set(Row::inertia, rig.inertia(pivot));
    set(Row::other_inertia, rig.inertia(-pivot));
    set(Row::kept, kept_rate(rig, pivot, -pivot));
    set(Row::kept_next, kept_rate(rig, -pivot, pivot));
    set(Row::told_rotation, rig.told_rotation);
    set(Row::rest_rotation, rig.rest_rotation);
    set(Row::instant, rig.instant_s);
    set(Row::right_arm, rig.right / rig.h);
    set(Row::left_arm, rig.left / rig.h);
    set(Row::over_height, 1 / rig.h);
    set(Row::over_angle, size.over_angle);
    set(Row::over_rotation, size.over_rotation);
    set(Row::over_length, size.over_length);
    set(Row::over_speed, size.over_speed);
    set(Row::longest_step_s, size.longest_step_s);
    set(Row::vertical_scale, place.vertical ? trajectory.shaking.vertical_scale : 0.0);
    set(Row::stretch, trajectory.shaking.stretch);
    set(Row::push, rig.push);
    set(Row::gravity, rig.g);
    set(Row::start, place.start);
    set(Row::offset, place.offset);
    set(Row::end, trajectory.shaking.duration_s() + trajectory.settings.free_vibration_s);
    set(Row::over, trajectory.cursor.motion_over());
    set(Row::peak_slip, peaks.peak_slip_m);
    set(Row::peak_slip_right, peaks.peak_slip_right_m);
    set(Row::peak_slip_left, peaks.peak_slip_left_m);
    set(Row::slid_path, peaks.slid_path_m);
    set(Row::peak_rotation, peaks.peak_rotation_rad);
    set(Row::peak_acceleration, peaks.peak_acceleration_mps2);
    set(Row::force_zero, rig.force_zero);
    set(Row::turn_zero, rig.turn_zero);
    set(Row::touching, touching(rig));
    set(Row::beside_wall, beside_wall(rig));
    for (int k = 0; k < laws_.states; ++k) state_row(k)[i] = state.states[static_cast<std::size_t>(k)];
    const Laws& laws = *rig.laws;
    for (int kink = 0; kink < laws.tape.kink_count(); ++kink) {
      rows_->side[kink][i] = state.sides >> kink & 1U ? -1 : 1;
      rows_->turns_yet[kink][i] = !laws.tape.latched(kink, state.sides);
      rows_->met[kink][i] = state.has_met(kink);
    }
    rows_->place[i] = place;
    rows_->coefficients[i] = trajectory.shaking.motion->degree + 1;
    for (int k = 0; k <= Motion::degree; ++k) {
      rows_->unit[k][i] = trajectory.cursor.unit(k);
      rows_->horizontal[k][i] = 0;
    }
    rows_->vertical[0][i] = rows_->vertical[1][i] = 0;
    if (place.left > 0) rows_->read_segment(i);
    rows_->segments[i] = static_cast<int>(place.left);
    rows_->steps[i] = trajectory.steps();
    rows_->blows[i] = rows_->told[i] = rows_->kinked[i] = 0;
    rows_->just[i] = Just::nothing;
    rows_->room[i] = trajectory.events_left();
    write_history(i, integrator.trajectory().recorder, state.mode);
  }

  // Back to the text for single samples.
  void read(int i, Integrator& integrator) {
    Integration& trajectory = integrator.trajectory();
    State& state = trajectory.state;
    const auto get = [&](Row row) { return rows_->row(row)[i]; };
    state.pivot = static_cast<int>(get(Row::pivot));
    state.theta = get(Row::theta);
    state.omega = get(Row::omega);
    state.xi = get(Row::xi);
    state.w = get(Row::w);
    state.path = get(Row::path);
    state.deflection = get(Row::deflection);
    state.still_since = get(Row::still_since);
    for (int k = 0; k < laws_.states; ++k) state.states[static_cast<std::size_t>(k)] = state_row(k)[i];
    trajectory.went_to(static_cast<std::size_t>(rows_->segments[i]), get(Row::start), get(Row::offset),
                       rows_->steps[i]);
    read_kinks(i, trajectory.rig.laws->tape, state);
    trajectory.went_through(rows_->blows[i] - (rows_->just[i] == Just::struck), rows_->told[i],
                            rows_->kinked[i] - (rows_->just[i] == Just::turned));
    trajectory.recorder.times().went_to(rows_->points[i]);
    Response& peaks = trajectory.peaks.response();
    peaks.peak_slip_m = get(Row::peak_slip);
    peaks.peak_slip_right_m = get(Row::peak_slip_right);
    peaks.peak_slip_left_m = get(Row::peak_slip_left);
    peaks.slid_path_m = get(Row::slid_path);
    peaks.peak_rotation_rad = get(Row::peak_rotation);
    peaks.peak_acceleration_mps2 = get(Row::peak_acceleration);
    if (rows_->just[i] != Just::nothing) trajectory.goes_on_after(rows_->just[i] == Just::struck);
  }

  // The last one takes its slot.
  void remove(int i) {
    const int last = --rows_->lanes;
    if (i != last) take_place_of(last, i);
    rows_->just[last] = Just::nothing;  // an empty slot, which the packs read all the same
  }

 private:
  double* state_row(int k) { return rows_->numbers[static_cast<int>(Row::state) + k]; }

  void read_kinks(int i, const Tape& tape, Kinks& kinks) const {
    kinks.left_kinks();
    for (int j = 0; j < tape.kink_count(); ++j) {
      const std::uint32_t bit = 1U << j;
      kinks.sides = rows_->side[j][i] < 0 ? kinks.sides | bit : kinks.sides & ~bit;
      if (rows_->met[j][i] > 0) kinks.turned |= bit;
    }
  }

  void write_history(int i, HistoryRecorder& recorder, Mode mode) {
    const OutputTimes& times = recorder.times();
    rows_->history[i] = recorder.history();
    rows_->points[i] = times.count();
    rows_->mode[i] = mode;
    rows_->row(Row::output_step)[i] = times.step_s();
    rows_->row(Row::next_output)[i] = times.wanted() ? times.next() : std::numeric_limits<double>::infinity();
  }

  void write_tape(int i, const Laws& laws) {
    for (int node = input_count; node < laws.tape.size(); ++node) {
      rows_->value[node][i] = laws.tape.operation(node).value;
      rows_->shift[node][i] = laws.tape.operation(node).shift;
    }
  }

  void take_place_of(int last, int i) {
    lane_[i] = lane_[last];
    const auto move = [&](auto& row) { row[i] = row[last]; };
    for (auto& row : rows_->numbers) move(row);
    for (int node = input_count; node < laws_.tape.size(); ++node) move(rows_->value[node]), move(rows_->shift[node]);
    for (int kink = 0; kink < laws_.tape.kink_count(); ++kink) {
      move(rows_->side[kink]);
      move(rows_->turns_yet[kink]);
      move(rows_->met[kink]);
    }
    move(rows_->knot);
    for (int k = 0; k <= Motion::degree; ++k) move(rows_->horizontal[k]), move(rows_->unit[k]);
    for (auto& row : rows_->vertical) move(row);
    move(rows_->place);
    move(rows_->coefficients);
    move(rows_->segments);
    move(rows_->steps);
    move(rows_->blows);
    move(rows_->told);
    move(rows_->room);
    move(rows_->kinked);
    move(rows_->just);
    move(rows_->history);
    move(rows_->points);
    move(rows_->mode);
  }

  const Laws laws_;
  std::unique_ptr<LawRows> rows_;
  int lane_[law_slots] = {};
};

// A lane may go along with others: nothing is special about this instant.
bool can_march(const Integration& trajectory) {
  const State& s = trajectory.state;
  const bool contact = s.mode == Mode::slide || s.mode == Mode::rock || s.mode == Mode::slide_rock ||
                       (s.mode == Mode::rest && !trajectory.waits());
  return contact && !(trajectory.cursor.motion_over() && s.mode == Mode::rest) && s.wall == 0 && !s.released &&
         s.doubt == 1 && !s.held && !trajectory.peaks.waits() && trajectory.rig.laws->in_packs(s.sigma != 0);
}

template <class Motion>
class Pool {
  using Integrator = IntegratorOf<Motion>;
  using Arc = LawArc<Motion::order>;

 public:
  Pool(const LawMarch (*marches)[2], int lanes, std::span<const Specimen> specimens, std::span<const Shaking> shakings,
       const Settings& settings, const std::vector<std::size_t>& which, std::span<Response> responses,
       std::span<History> histories)
      : marches_(marches),
        pack_lanes_(lanes),
        specimens_(specimens),
        shakings_(shakings),
        settings_(settings),
        which_(which),
        responses_(responses),
        histories_(histories),
        series_(static_cast<std::size_t>(lanes)) {}

  void run() {
    for (int lane = 0; lane < law_slots; ++lane) refill(lane);
    while (Group<Motion>* group = fullest()) march(*group);
  }

 private:
  struct Lane {
    std::size_t sample = 0;
    std::optional<Integrator> integrator = {};
  };

  Group<Motion>* fullest() {
    Group<Motion>* best = nullptr;
    for (Group<Motion>& group : groups_)
      if (group.count() > (best ? best->count() : 0)) best = &group;
    return best;
  }

  void march(Group<Motion>& group) {
    LawRows& rows = group.rows();
    const Stopped stopped = marches_[rows.turns][rows.slips](rows, reinterpret_cast<double*>(series_.data()));
    // From the last one on, since the last one of the group takes the place of one that leaves.
    for (int slot = pack_lanes_; slot-- > 0;) {
      const unsigned bit = 1U << slot;
      if (!(stopped.any() & bit)) continue;
      const int lane = group.lane(slot);
      Integrator& integrator = *lanes_[lane].integrator;
      group.read(slot, integrator);
      if (stopped.before_step & bit) integrator.step_along(series_of(slot, integrator));
      if (stopped.unsolved & bit) integrator.step();
      if (walks_on(integrator) && group.takes(integrator.trajectory())) {
        group.write(slot, integrator);
        continue;
      }
      group.remove(slot);
      place(lane);
    }
  }

  const Arc& series_of(int slot, Integrator& integrator) {
    Arc& arc = series_[static_cast<std::size_t>(slot)];
    const Laws& laws = *integrator.trajectory().rig.laws;
    for (int kink = 0; kink < laws.tape.kink_count(); ++kink)
      if (!laws.tape.turns(kink, integrator.trajectory().state.sides, arc.kink[kink][0]))
        arc.kink[kink] = Series<double, Motion::order>::zero();
    return arc;
  }

  // Step by step, until a group can take it. False: it has ended.
  static bool walks_on(Integrator& integrator) {
    while (integrator.goes_on()) {
      if (can_march(integrator.trajectory())) return true;
      integrator.step();
    }
    return false;
  }

  void place(int lane) {
    Integrator& integrator = *lanes_[lane].integrator;
    if (walks_on(integrator))
      group_of(integrator.trajectory()).enter(lane, integrator);
    else
      finish(lane);
  }

  Group<Motion>& group_of(const Integration& trajectory) {
    for (Group<Motion>& group : groups_)
      if (group.takes(trajectory)) return group;
    return groups_.emplace_back(trajectory, settings_);
  }

  void finish(int lane) {
    responses_[lanes_[lane].sample] = lanes_[lane].integrator->trajectory().result();
    refill(lane);
  }

  void refill(int lane) {
    lanes_[lane].integrator.reset();
    if (taken_ == which_.size()) return;
    const std::size_t sample = which_[taken_++];
    lanes_[lane].sample = sample;
    History* history = histories_.empty() ? nullptr : &histories_[sample];
    lanes_[lane].integrator.emplace(set_up(specimens_[sample], shakings_[sample]), settings_, history);
    place(lane);
  }

  const LawMarch (*marches_)[2];
  const int pack_lanes_;
  const std::span<const Specimen> specimens_;
  const std::span<const Shaking> shakings_;
  const Settings settings_;
  const std::vector<std::size_t>& which_;
  const std::span<Response> responses_;
  const std::span<History> histories_;
  std::size_t taken_ = 0;
  std::vector<Arc> series_;  // of the lanes that stop
  std::deque<Group<Motion>> groups_;
  Lane lanes_[law_slots];
};

}  // namespace

HistoryPoint& add_point(History& history) { return history.points.emplace_back(); }

void add_blow(History& history, double time_s, int pivot) {
  history.events.push_back({time_s, Mode::rock, Mode::rock, pivot, true});
}

bool goes_in_law_lanes(const Setup& setup, const Settings& settings) {
  const Shaking& shaking = setup.shaking;
  if (setup.specimen.model == Model::bouc_wen || !admissible(setup, settings) || shaking.motion->degree < 1)
    return false;
  const bool shaken = shaking.vertical_scale != 0 && !shaking.motion->vertical_mps2.empty();
  if ((shaking.motion->degree > 1 && shaken) || slides_on_pulse(setup, settings)) return false;
  return has_laws(setup.specimen) || setup.floor.push_mps2 != 0 || !follows_record(shaking);
}

void respond_in_law_lanes(const BatchKernels& kernels, std::span<const Specimen> specimens,
                          std::span<const Shaking> shakings, const Settings& settings,
                          const std::vector<std::size_t>& which, std::span<Response> responses,
                          std::span<History> histories) {
  std::vector<std::size_t> on_records, on_pulses;
  for (const std::size_t i : which) (shakings[i].motion->degree > 1 ? on_pulses : on_records).push_back(i);
  const auto run = [&]<class Motion>(Motion, const LawMarch(*marches)[2], const std::vector<std::size_t>& some) {
    if (!some.empty())
      std::make_unique<Pool<Motion>>(marches, kernels.lanes, specimens, shakings, settings, some, responses, histories)
          ->run();
  };
  run(OnRecords(), kernels.under_laws, on_records);
  run(OnPulses(), kernels.on_pulses, on_pulses);
}

}  // namespace freestand::dynamics
