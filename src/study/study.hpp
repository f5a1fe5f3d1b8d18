// The study file as plain structs: what a sweep is, with every default filled in. Read by read_study(), written out in
// full by expanded(), turned into samples by Realiser (realise.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <freestand/specimen.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edp/edp.hpp"
#include "motion/building.hpp"
#include "motion/processing.hpp"
#include "motion/record_table.hpp"
#include "sampling/design.hpp"
#include "sampling/distribution.hpp"

namespace freestand::dynamics {
struct Effect;
}

namespace freestand::study {

// One number of the study: its dotted name ("block.width_m"), its unit ("m"; "1" for a plain number), its distribution.
struct Quantity {
  std::string name;
  std::string unit;
  sampling::Distribution value;
  int line = 0;               // of the study file, for messages; 0: a default
  std::string drawn_as = {};  // the parameter whose draws it takes; empty: its own

  std::string stream() const {
    if (const auto* joint = std::get_if<sampling::Posterior>(&value)) return "posterior." + joint->table;
    return drawn_as.empty() ? name : drawn_as;
  }
};

// Either width and height, or slenderness alpha = atan(W/H) and size R = half the diagonal. Beside the sides, what is not that
// of a uniform rectangle: where the centre of mass is, and the inertia about it.
struct BlockPart {
  std::optional<Quantity> width, height;             // block.width_m, block.height_m
  std::optional<Quantity> slenderness, size;         // block.slenderness_rad, block.size_m
  Quantity mass;                                     // block.mass_kg
  std::optional<Quantity> centre_height;             // block.centre_height_m, over the base
  std::optional<Quantity> gyration_radius, inertia;  // block.gyration_radius_m, or block.inertia_kgm2
};

// Either mu for both coefficients, or mu_k with mu_s, or mu_k with static_ratio = mu_s/mu_k >= 1 (default 1).
struct FrictionPart {
  std::optional<Quantity> mu, mu_k, mu_s, static_ratio;
  // Of sliding in both horizontal directions (freestand/specimen.hpp); 1 and 0 where not given.
  std::optional<Quantity> ratio_across, axis;  // friction.ratio_across, friction.axis_rad
};

struct ImpactPart {
  ImpactLaw law = ImpactLaw::housner;
  Quantity factor;  // impact.factor, in [0, 1]
};

// A physical effect by name with its parameters, named effects.<effect>.<parameter>, in the order of its declaration. A
// formula of the study carries its text, and the effect that is made of it.
struct EffectPart {
  std::string name;
  std::vector<Quantity> parameters;
  std::string friction = {}, force = {};
  std::shared_ptr<const dynamics::Effect> effect = {};
};

// Chains from the top of the block to the wall behind it; forces in newtons, so that the mass matters.
struct ChainPart {
  Quantity slack, stiffness, strength;  // chain.slack_m, chain.stiffness_npm, chain.strength_n
  std::optional<Quantity> height;       // chain.height_m, the block's height where it is not given
  // chain.number, chain.plan_angle_rad, chain.elevation_rad, chain.damping_nspm; one level chain along the shaking, without damping,
  // where not given
  std::optional<Quantity> number, plan_angle, elevation, damping;
  std::optional<Quantity> wall_gap;  // chain.wall_gap_m, 0 where it is not given; none where the model knows no walls
  int side = 1;                      // +1: holds back what moves to the right
};

// Another block beside this one, on the same floor (freestand/specimen.hpp).
struct NeighbourPart {
  Quantity gap, mass;                                 // neighbour.gap_m, neighbour.mass_kg
  Quantity mu_k;                                      // neighbour.mu_k
  std::optional<Quantity> static_ratio, restitution;  // neighbour.static_ratio, 1; neighbour.restitution, 0
  int side = 1;                                       // +1: to the right

  std::vector<Quantity> given() const;
};

// Legs under the edges of the block that give way up and down (freestand/specimen.hpp).
struct LegsPart {
  Quantity frequency;               // legs.vertical_frequency_hz
  std::optional<Quantity> damping;  // legs.vertical_damping, 0.02 where not given
};

// The contact of model bouc_wen.
struct BoucWenPart {
  Quantity yield_displacement, exponent, gamma, beta;  // bouc_wen.yield_displacement_m, bouc_wen.exponent ...
};

// How the block is when the floor begins to move (freestand/specimen.hpp); what is not given is zero.
struct StartPart {
  std::optional<Quantity> rotation, rotation_rate;  // start.rotation_rad, start.rotation_rate_radps
  std::optional<Quantity> slip, slip_velocity;      // start.slip_m, start.slip_velocity_mps

  std::vector<Quantity> given() const;
  bool any() const { return rotation || rotation_rate || slip || slip_velocity; }
};

struct ModelPart {
  BlockPart block;
  FrictionPart friction;
  Model model = Model::slide_rock;
  std::optional<BoucWenPart> bouc_wen;  // of model bouc_wen, and only there
  ImpactPart impact;
  std::vector<EffectPart> effects;
  std::optional<ChainPart> chain;
  std::optional<NeighbourPart> neighbour;
  std::optional<LegsPart> legs;
  StartPart start;
  std::optional<Quantity>
      slip_discrepancy;  // discrepancy.slip: measured slips over those of the model, of which no law is known
};

// Every number of the model, in the order of its columns.
std::vector<Quantity> quantities(const ModelPart&);

struct Study;

// Does the equipment stand in a building, on records of the ground?
bool in_a_building(const Study&);

// Is an intensity of its results known to be that of a floor, and not of the ground under the building?
bool is_of_a_floor(const std::string& im, const Study&);

// Does it feel vertical components (effect vertical_shaking)?
bool shakes_vertically(const ModelPart&);

// An intensity measure: a name, or {name: sa_g, period_s: 1.0} for one that takes a number.
struct IntensityPart {
  std::string name = "report";
  std::string parameter = {};           // key of that number; empty: the measure takes none
  std::optional<double> period_s = {};  // the number; the measure's own default where the study gives none
};

// A building of which period and damping may be known by a distribution; the rest of it, and all of it at medians, is the base.
struct BuildingPart : motion::Building {
  std::optional<Quantity> drawn_period,
      drawn_damping;  // building.period_s, building.damping, where they are no numbers
};

// Into which direction pairs of horizontal components are turned: by this angle from the first of a pair towards the other; of a
// table of records to this azimuth, clockwise from north, or by the strike that it gives.
struct TurnPart {
  enum class To { angle, fault_normal, fault_parallel };
  To to = To::angle;
  double angle_deg = 0;
};

// Realisations of the stochastic model of motion/synthetic.hpp, each with parameters of its own, drawn by its number.
struct SyntheticPart {
  struct Pulse {
    sampling::Names types;
    Quantity period, peak_velocity, middle;  // synthetic.pulse.period_s, ...peak_velocity_mps, ...middle_s
  };
  std::string name = "synthetic";  // of the set; part of the key of its draws
  int count = 100;
  // synthetic.arias_mps, .duration_s, .middle_s, .frequency_hz, .frequency_slope_hzps, .bandwidth, .corner_hz
  Quantity arias, duration, middle, frequency, slope, bandwidth, corner;
  double step_s = 0.01;
  std::optional<Pulse> pulse;
};

// One entry of `motions`: pulses, records or synthetic motions, taken with probability weight / (sum of weights).
struct MotionSource {
  enum class Kind { pulses, records, synthetic };
  Kind kind = Kind::pulses;
  double weight = 1;
  // Pulses: motion.peak_acceleration_g or motion.peak_velocity_mps (the true peak of the floor's velocity); records:
  // motion.scale (a factor); negative ones mirror. Either: the intensity that the motion is scaled to, motion.sa_g.
  std::optional<Quantity> amplitude;
  std::optional<IntensityPart> scale_to;  // of such an amplitude
  std::optional<SyntheticPart> synthetic;
  // Pulses.
  sampling::Names pulses;
  std::optional<Quantity> period;  // motion.period_s
  double pulse_scale = 1;          // key `scale`: a plain factor on the amplitude
  // Records; all alike likely.
  std::string records;           // glob, folder, file or table of records, relative to the folder of the study file
  std::string vertical_records;  // the same for vertical components, paired in the order of names
  std::string group;             // of a table: the column that groups its records; else the group of all these records
  std::vector<motion::RecordRow> files;       // what `records` names: rows of the table, or files sorted by name
  std::vector<motion::RecordNumber> numbers;  // of those rows
  std::vector<std::string> left_out;          // vertical components, and why they are taken for that
  std::vector<std::string> no_records;        // what else lies in a folder, and why it is taken for no record
  std::vector<std::string> ungrouped;         // columns by which a table could group its records, and does not
  std::optional<double> dt_s;                 // the rest as motion::ReadOptions, where a row does not say it
  std::string unit, format, channel;
  std::string cross_records;  // the other horizontal components, paired as the vertical ones
  bool in_plane() const;      // any record has a second horizontal channel, and is not turned into one direction
  // Where the records are of the ground and the equipment stands in a building; amplitudes stay those of the ground.
  std::optional<BuildingPart> building;
  std::optional<Quantity> storey;    // motion.storey: a whole number of floors above the ground, or a choice of them
  std::vector<int> storeys() const;  // its values; none without a building
  motion::KnownPulse pulse;          // of each record whose row does not say it
  std::optional<TurnPart> turn;      // of each pair
  bool begin_together = false;       // the user says that the two of each pair do
  motion::Processing processing;     // of each record, before it is scaled to an amplitude
};

enum class Spacing { equal_width, equal_count, log };

// Bins of an intensity measure or of a second axis. Exactly one of edges (not empty), width (> 0) and count (> 0).
struct BinsPart {
  std::vector<double> edges;
  double width = 0;
  int count = 0;
  Spacing spacing = Spacing::equal_count;  // of `count` bins
};

struct CapacitiesPart {
  std::string edp;
  std::vector<double> values;  // increasing
};

// A damage state: a condition on demands, whose parameters may be distributions (a capacity that is not known).
struct DamagePart {
  std::string name;                  // blocked_door
  std::string when;                  // "peak_slip_m > gap_m or overturned"
  std::vector<Quantity> parameters;  // damage.blocked_door.gap_m
  std::vector<std::string> demands;  // that the condition looks at
  int line = 0;
};

struct AxisPart {
  std::string name;  // a dotted name: friction.mu_k, block.alpha_rad, motion.period_s ...
  BinsPart bins;
};

struct FragilityPart {
  IntensityPart im;
  BinsPart bins;                           // default: 12 bins of equal count
  std::vector<std::string> edp;            // default: every one that is known
  std::vector<CapacitiesPart> capacities;  // of each EDP of the list that is not binary, in its order
  std::vector<DamagePart> damage;          // each one more binary demand
  std::vector<AxisPart> axes;
  std::vector<Quantity> target;  // other distributions of what was swept (target.hpp)
  int resamples = 500;           // bootstrap repeats of the intervals
  double confidence = 0.95;
  int minimum_samples = 30;                  // a bin with fewer stays empty
  double adequate = 0.05;                    // a fit is used where it is off by no more
  std::map<std::string, double> still = {};  // by EDP: at or below it the block stood still; every one of `capacities`
  double false_discovery = 0.05;             // level of the goodness-of-fit tests over the bins
  bool empirical_fallback = true;            // a bin whose fit may be off by more takes its curve from the counts
};

// Run until every wanted point of the surface is known well enough (fragility::Wanted), or `at_most` samples are drawn.
struct UntilPart {
  double half_width = 0.5;
  std::optional<double> relative_error = {};
  double down_to = 0.001;   // the least probability that is wanted to relative_error
  bool everywhere = false;  // samples of all intensities are taken, whether they are wanted there or not
  std::uint64_t at_most = 0;
};

// Which samples are kept beside what is counted of them: the first ones, since the first points of a Sobol sequence are evenly
// spread and every k-th is not.
struct KeepPart {
  std::uint64_t one_in = 1;  // of so many samples one is kept; 0: none
};

struct Study {
  std::string name;              // key `name`, or the stem of the file
  std::filesystem::path folder;  // relative paths start here: the study file's folder, or its key paths_from
  std::uint64_t seed = 1;
  std::uint64_t samples = 0;  // with `until`: until->at_most
  std::optional<UntilPart> until;
  KeepPart keep;
  sampling::Design design = sampling::Design::sobol;
  int scrambles =
      1;  // independent designs, from whose differences errors come where every sample is a motion of its own
  double tolerance = 1e-9;
  double free_vibration_s = 60;
  std::optional<double> acceleration_height_m =
      {};                        // over the base: accelerations there are computed too, in more time
  bool contact_forces = false;   // peaks of the forces of floor and chain are computed too, in more time
  bool slip_by_side = false;     // the peak slip to each side is computed too, in more time
  std::uint64_t block_size = 0;  // samples a work unit; default: samples/1000 as a power of two within 256 and 8192
  ModelPart model;
  std::vector<MotionSource> motions;
  FragilityPart fragility;

  // Of the tables of joint draws that it takes numbers from: what is doubtful, in sentences.
  std::vector<std::string> doubtful_draws = {};

  // Of no study file: parameters that take other draws than the study's, with all others as they are.
  std::vector<std::string> redrawn = {};

  sampling::Plan plan() const { return {design, seed, samples, scrambles, redrawn}; }
};

// One sample to be simulated: a study in which every number is fixed and there is one motion.
struct Case {
  Study study;
  double output_step_s = 0.005;
};

// An EDP and an intensity measure, as far as the study file is concerned.
struct KnownEdp {
  std::string name;
  bool binary = false;  // overturned: takes no capacities
  std::vector<double> default_capacities;
  bool by_default = true;
  double still = 0;  // threshold where the study gives none
  edp::Wants wants = edp::Wants::nothing;
  std::string refusal = {};  // what is said where this study has not what it wants
  bool censored = false;     // an overturned block is beyond every capacity of it
};
struct KnownIntensity {
  std::string name;
  std::string parameter;  // key of its number, such as period_s; empty: none
  double fallback = 0;
};

// The names that a study may use; of the whole program: registries() in known.hpp.
struct Known {
  std::vector<KnownEdp> edps;
  std::vector<KnownIntensity> intensities;
  bool any_record = false;  // record.COLUMN of any column: the tables of records are not looked at
};

// Are the records of the study looked for? `ignore`: for the stored study of finished results, whose records need not
// be there any more; MotionSource::files stays empty.
enum class Files { look, ignore };

// Numbers that were fitted to measurements: their joint draws, where the study names a table of them, or their best values.
enum class FittedAs { draws, best };

// Reads and checks a study or case. Every problem of the file is reported at once: throws Error (Exit::usage) with one
// line each, "file:line: problem (why): what to do".
Study read_study(const std::filesystem::path& file, const Known&, FittedAs = FittedAs::draws);
Case read_case(const std::filesystem::path& file);

// The same from text; `file` names it in messages and its folder is where globs start.
Study parse_study(const std::string& text, const std::filesystem::path& file, const Known&, Files = Files::look,
                  FittedAs = FittedAs::draws);
Case parse_case(const std::string& text, const std::filesystem::path& file);

// The study that a result of this program stores; its records are not looked for. `origin` names it in messages.
Study parse_stored(const std::string& expanded, const std::filesystem::path& origin);

// The whole study, every default written out, as YAML that parses back to the same study in the same folder.
std::string expanded(const Study&);

// The same for a file in `folder`: where paths start elsewhere, `paths_from` leads there. It is relative, so that studies,
// records and results may be moved together.
std::string expanded(const Study&, const std::filesystem::path& folder);
std::string expanded(const Case&, const std::filesystem::path& folder);

// Hash (16 hexadecimal digits) of all that determines the numbers in the result files; the name does not. The contents
// of records count through MotionSet::fingerprint.
std::string fingerprint(const Study&);

// The same of what determines the samples: nothing of the fragility block.
std::string samples_fingerprint(const Study&);

}  // namespace freestand::study
