// The parts of a study file, one reader each. Internal to src/study.
#pragma once

#include "study/section.hpp"
#include "study/study.hpp"

namespace freestand::study {

// block, friction, model, impact, effects: the keys that studies and cases share.
ModelPart read_model(Section& file);

FrictionPart read_friction(Section& file);
// What does not go with the friction of the model, once effects are read.
void check_friction(Section& file, const ModelPart&);

std::vector<EffectPart> read_effects(Section& file, Model model);

// The block beside this one, where there is one; problems where something does not go with it.
std::optional<NeighbourPart> read_neighbour(Section& file, const ModelPart&);
// Legs that give way, where it stands on such; problems where something does not go with them.
std::optional<LegsPart> read_legs(Section& file, const ModelPart&);
// The specimen as far as its kind goes: effects with values that are met in practice, so that none vanishes.
Specimen kind_of(const ModelPart&);

// What is said where the laws of effects and chain do not find room together; "" where they do.
std::string no_room_for(const std::vector<EffectPart>&, const std::optional<ChainPart>&);

// How near the walls of a wall_impact may stand to the block's face on either side, in any sample [m]; none: there is no wall.
struct NearestWalls {
  std::optional<double> right, left;
};
NearestWalls nearest_walls(const EffectPart& wall_impact);

// What is said where a formula leaps against the speed, or where the block tips, and would hold it there; "" where it does not.
std::string leap_that_holds(const EffectPart& formula);

// Entries of `motions`; globs start at `folder`. vertical: the model feels vertical components, so that tables of records
// are searched for them.
std::vector<MotionSource> read_motions(Section& file, const std::filesystem::path& folder, Files, bool vertical);

// The amplitude from the key scale_to, if it is there: any intensity measure that is proportional to the motion's scale.
std::optional<Quantity> read_scale_to(Section& section, MotionSource& source);

// The amplitude of motions that have a strength of their own: scale_to, or scale, 1 where neither is given.
void read_amplitude(Section& section, MotionSource& source);

// Checks names of pulses at a key, and gives each the form that the pulse itself has (c1 -> C1).
void settle_pulse_names(Section& section, const std::string& key, sampling::Names& names);

// What an entry of `motions` says of records; `key`: records, or file of a case.
struct RecordKeys {
  std::string key, vertical_key, cross_key;
  std::filesystem::path folder;
  Files look;
  bool vertical;
};
void read_records(Section& section, MotionSource& source, const RecordKeys&);

// Problems of what a study follows and does not go with a neighbour.
void check_neighbour(Section& file, const Study&);

// Problems of motions with a second horizontal channel in a study of which something does not go with one.
void check_cross(Section& file, const Study&, Files look);
// Into which direction pairs are turned; what is wrong with that where records come without a table; the rows of a table as
// pairs.
std::optional<TurnPart> read_turn(Section& section);
void check_turn(Section& section, const MotionSource& source, const RecordKeys&);
void pair_rows(Section& section, const TurnPart& turn, motion::RecordTable& table);

// What is known of the pulse of a record.
motion::KnownPulse read_known_pulse(Section& section);

// What is to be done to a record; every key of it.
motion::Processing read_processing(Section& section);
const std::vector<std::string>& processing_keys();

// `motion` of a case: one pulse or one file.
MotionSource read_motion(Section& file, const std::filesystem::path& folder);

// What a surface may have as its second axis, and whether it takes more than one value in this study.
struct AxisChoice {
  std::string name;
  bool varies;
};
std::vector<AxisChoice> axis_choices(const ModelPart&, const std::vector<MotionSource>&);

// `fragility`, defaults where it is absent. No choices: axes are not checked.
FragilityPart read_fragility(Section& file, const Known&, const std::vector<AxisChoice>&);

// `damage` of the fragility block, after the damage states that its capacities made.
void read_damage(Section& fragility, const Known&, FragilityPart&);

// The study that a mapping says. Throws Error (Exit::usage) with all problems. `path`: names it in messages, and its folder
// is where relative paths start. line: of the mapping, for what it lacks.
Study read_sweep(const YAML::Node& root, const std::filesystem::path& path, const Known&, Files, Problems&,
                 int line = 1, FittedAs = FittedAs::draws);

// Text of `motions`, as expanded() writes it.
std::string motions_text(const std::vector<MotionSource>&);

// Everything in a file; throws Error where it cannot be read.
std::string read_text(const std::filesystem::path& file);

// The mapping of the file, or nothing (syntax errors and empty files are problems).
std::optional<YAML::Node> parse_yaml(const std::string& text, Problems&);

}  // namespace freestand::study
