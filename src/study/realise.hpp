// From sample index to specimen and shaking: the one place where the draws of a study become physics.
#pragma once

#include <cstdint>
#include <freestand/floor_motion.hpp>
#include <freestand/simulate.hpp>
#include <freestand/specimen.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "study/study.hpp"

namespace freestand::study {

// All floor motions of a study, each loaded once: unit pulses (peak acceleration 1 m/s2, period 1 s) and records. They
// stay where they are for the life of the set and of its copies (Shaking points to them).
struct MotionSet {
  struct Entry {
    FloorMotion motion;
    bool pulse = false;
    double peak_mps2 = 1;                    // of the horizontal channel
    double peak_mps = 0;                     // velocity of a unit pulse; v_p = scale * period * peak_mps
    std::string group = {};                  // of a record; empty: by itself
    std::vector<double> numbers = {};        // one for each of MotionSet::numbers, nan where nothing gives it
    std::optional<std::size_t> ground = {};  // of a floor: the entry of the record, under its building
    int storey = 0;                          // of a floor: how many above the ground
    motion::KnownPulse known_pulse = {};     // of a record: what the study or its table says of its pulse
    double weight = 1;                       // of a record: how often it is drawn beside the others of its source
  };
  std::vector<motion::RecordNumber> numbers;  // intensities that tables of records bring
  std::shared_ptr<const std::vector<Entry>> entries;
  // Per source of the study: its items -> entries; records in a building by each of the storeys in turn. Records of the ground
  // stand in the set too.
  std::vector<std::vector<std::size_t>> of_source;

  std::size_t size() const { return entries->size(); }
  const FloorMotion& motion(std::size_t i) const { return (*entries)[i].motion; }
  std::size_t ground(std::size_t i) const {
    return (*entries)[i].ground.value_or(i);
  }  // itself where it is of no floor
  bool has_floors() const;
  bool is_pulse(std::size_t i) const { return (*entries)[i].pulse; }
  std::vector<std::string> names() const;
  std::vector<int> groups() const;  // fragility::Options::motion_group: each record its own, -1 pulses
  // Hash (16 hexadecimal digits) of names and contents.
  std::string fingerprint() const;
};

// Throws Error (Exit::data) that lists every record that cannot be read.
MotionSet load_motions(const Study&);

// One sample, ready to be integrated.
struct Realisation {
  Specimen specimen;
  Shaking shaking;
  std::size_t motion = 0;     // index into the MotionSet
  double pulse_period_s = 0;  // nan for records
  double pta_g = 0;           // peak of the scaled horizontal motion
  double slip_factor = 1;     // by which slips are multiplied: discrepancy.slip of the study
  std::vector<double> draws;  // one value for each of draw_columns()
};

// A pure function of the sample index; const and safe to share between threads.
class Realiser {
 public:
  Realiser(const Study&, MotionSet);
  Realisation operator()(std::uint64_t sample) const;

  // Columns of Realisation::draws: every quantity of the study by its dotted name with '.' -> '_' (block_width_m), then
  // what follows from them and is not already there (block_alpha_rad, block_p_radps, friction_mu_k, friction_mu_s ...),
  // then motion, scale, pta_g, pulse_period_s, and in a building storey.
  const std::vector<Column>& draw_columns() const;
  const MotionSet& motions() const;

  // Column of a dotted axis name: friction.mu_k -> friction_mu_k, motion.period_s -> pulse_period_s.
  static std::string column_of(const std::string& dotted);

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

// The integration settings of the study.
Settings integration_settings(const Study&);

}  // namespace freestand::study
