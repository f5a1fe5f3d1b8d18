// What both integrators share: the life of one sample from event to event. They differ only in how they move between
// events.
#pragma once

#include "dynamics/floor_cursor.hpp"
#include "dynamics/history_recorder.hpp"
#include "dynamics/mode_logic.hpp"
#include "dynamics/peaks.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/witness.hpp"

namespace freestand::dynamics {

// Sizes, friction, scales and settings that can be integrated at all.
bool admissible(const Specimen& specimen, const Shaking& shaking, const Settings& settings);

class Integration {
 public:
  Integration(const Specimen& specimen, const Shaking& shaking, const Settings& settings, History* history);

  bool finished() const { return finished_; }
  // At rest nothing is integrated: goes along the motion to the instant at which rest ends, or to its end.
  void wait();
  // Applies an event: sets what the event makes exact, strikes or lands where corners meet the floor, chooses the next
  // mode.
  void resolve(Witness witness);
  void chose(const State& from, bool impact);  // counts and records a change of mode
  void stop(Outcome outcome);
  // Ends the sample when it can move no more, or has used up its time.
  void stop_when_done();
  Response result();

  const Rig rig;
  const Shaking shaking;
  const Settings settings;
  FloorCursor cursor;
  State state;
  Peaks peaks;
  HistoryRecorder recorder;

 private:
  double slip() const;

  bool finished_ = false;
  bool moved_ = false;
  int resolved_ = 0;  // events, those that changed nothing included
  Outcome outcome_ = Outcome::moved;
};

}  // namespace freestand::dynamics
