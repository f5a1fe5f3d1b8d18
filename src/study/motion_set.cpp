// Loads every floor motion of a study once.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <span>

#include "base/random.hpp"
#include "motion/building_response.hpp"
#include "motion/peaks.hpp"
#include "motion/processing.hpp"
#include "motion/pulse.hpp"
#include "motion/record.hpp"
#include "motion/record_pairs.hpp"
#include "study/drawn_building.hpp"
#include "study/problems.hpp"
#include "study/realise.hpp"
#include "study/synthetic_set.hpp"

namespace freestand::study {
namespace {

using Entry = MotionSet::Entry;

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

Entry load_pulse(const std::string& name) {
  const motion::Pulse pulse = motion::find_pulse(name);
  Entry entry{motion::pulse_motion(pulse), true, 1, pulse.peak_velocity};
  entry.motion.name = pulse.name;
  return entry;
}

// Name of a record in the result files: its path as the study gives it, so that results do not depend on where the study
// lies, nor on the folder that it is read from.
std::string record_name(const std::filesystem::path& file, const MotionSource& source,
                        const std::filesystem::path& folder) {
  const bool whole = folder.empty() || std::filesystem::path(source.records).is_absolute();
  return (whole ? file.lexically_normal() : file.lexically_proximate(folder)).generic_string();
}

// From the first component of the pair.
double angle_deg(const TurnPart& turn, const motion::RecordRow& row) {
  if (!row.azimuth_deg) return turn.angle_deg;  // no table
  const double azimuth = turn.to == TurnPart::To::angle          ? turn.angle_deg
                         : turn.to == TurnPart::To::fault_normal ? row.strike_deg.value() + 90
                                                                 : row.strike_deg.value();
  return motion::angle_to_azimuth_deg(row, azimuth);
}

// What its row says of a record, and else what the study says of all of them.
motion::ReadOptions read_options(const MotionSource& source, const motion::RecordRow& row) {
  motion::ReadOptions options;
  options.dt_s = row.dt_s ? row.dt_s : source.dt_s;
  options.unit = row.unit.empty() ? source.unit : row.unit;
  options.format = row.format.empty() ? source.format : row.format;
  options.channel = row.channel.empty() ? source.channel : row.channel;
  options.component = motion::Component::horizontal;
  options.vertical_file = row.vertical.string();
  options.cross_file = row.cross.string();
  options.keep_cross = !source.turn;
  options.begin_together = source.begin_together;
  if (source.turn) options.rotate_deg = angle_deg(*source.turn, row);
  return options;
}

// What its row says of its pulse, and else what the study says; at the scale of the model.
motion::KnownPulse known_pulse(const MotionSource& source, const motion::RecordRow& row) {
  motion::KnownPulse known = row.pulse;
  if (known.type.empty()) known.type = source.pulse.type;
  if (!known.period_s) known.period_s = source.pulse.period_s;
  if (known.period_s && source.processing.scale) *known.period_s *= source.processing.scale->time;
  return known;
}

// Of the pulse on top of a synthetic motion. Types that a record's pulse cannot have are looked for, at its period.
motion::KnownPulse known_pulse(const motion::SyntheticPulse& pulse) {
  const auto& types = motion::pulse_types();
  const bool of_a_record = std::find(types.begin(), types.end(), pulse.type) != types.end();
  return {of_a_record ? pulse.type : "", pulse.period_s};
}

void take_peaks(Entry& entry) {
  const motion::MotionPeaks peaks = motion::peaks(entry.motion);
  entry.peak_mps2 = peaks.pga_mps2;
  entry.peak_mps = peaks.pgv_mps;
}

Entry load_record(const MotionSource& source, const motion::RecordRow& row, const std::filesystem::path& folder) {
  FloorMotion motion = motion::processed(motion::read_record(row.file, read_options(source, row)), source.processing);
  Entry entry{std::move(motion), false, 0, 0, row.group};
  entry.motion.name = record_name(row.file, source, folder);
  entry.known_pulse = known_pulse(source, row);
  entry.weight = row.weight;
  take_peaks(entry);
  if (!(entry.peak_mps2 > 0))
    throw Error(fmt::format("{}: its horizontal acceleration is zero throughout (amplitudes and intensities go by "
                            "that): leave it out, or get it "
                            "again; of a pair, name the component that shakes first",
                            row.file.string()),
                Exit::data);
  return entry;
}

void hash_values(std::span<const double> values, std::uint64_t& hash) {
  hash = random::mix(hash ^ values.size());
  for (const double value : values) hash = random::mix(hash * 31 ^ std::bit_cast<std::uint64_t>(value));
}

// Problems of single records, gathered so that one run tells them all.
class Loader {
 public:
  explicit Loader(const Study& study) : study_(study) {}

  std::vector<std::size_t> load(const MotionSource& source) {
    std::vector<std::size_t> items;
    if (source.kind == MotionSource::Kind::pulses) {
      for (const auto& name : source.pulses.values) items.push_back(pulse(name));
      return items;
    }
    if (source.synthetic) return synthetic(source);
    for (const motion::RecordRow& row : source.files) {
      try {
        entries_.push_back(load_record(source, row, study_.folder));
        add_numbers(source, row.numbers, entries_.back());
        add_item(source, items);
      } catch (const Error& error) {
        const std::string what = error.what();
        const bool named = what.find(row.file.string()) != std::string::npos;
        problems_.push_back(
            {row.file.string(), named ? what : fmt::format("{}: {}", row.file.string(), what), row.where});
      }
    }
    return items;
  }

  const std::vector<motion::RecordNumber>& numbers() const { return numbers_; }

  std::vector<Entry> finish() {
    for (Entry& entry : entries_) entry.numbers.resize(numbers_.size(), not_given);
    if (!problems_.empty()) throw Error(fmt::format("{}", fmt::join(told_once(problems_), "\n")), Exit::data);
    bool vertical = !shakes_vertically(study_.model);
    for (const auto& entry : entries_) vertical = vertical || !entry.motion.vertical_mps2.empty();
    if (!vertical)
      throw Error(
          "effect vertical_shaking has nothing to act on (no motion of the study has a vertical channel): give "
          "vertical_records, or floor csv files with floor_vertical_acceleration_mps2, or remove the effect",
          Exit::data);
    return std::move(entries_);
  }

 private:
  // Sources that share a pulse share its table.
  std::size_t pulse(const std::string& name) {
    const auto known = pulses_.find(name);
    if (known != pulses_.end()) return known->second;
    entries_.push_back(load_pulse(name));
    return pulses_[name] = entries_.size() - 1;
  }

  // Each by itself a motion that no other goes with.
  std::vector<std::size_t> synthetic(const MotionSource& source) {
    std::vector<std::size_t> items;
    for (std::uint64_t n = 0; n < static_cast<std::uint64_t>(source.synthetic->count); ++n) {
      const motion::SyntheticParameters parameters = synthetic_parameters(*source.synthetic, study_.seed, n);
      Entry entry{realisation(*source.synthetic, study_.seed, n)};
      if (const auto& pulse = parameters.pulse) entry.known_pulse = known_pulse(*pulse);
      take_peaks(entry);
      entries_.push_back(std::move(entry));
      add_numbers(source, synthetic_values(parameters), entries_.back());
      try {
        add_item(source, items);
      } catch (const Error& error) {
        const std::string& name = entries_.back().motion.name;
        problems_.push_back({name, fmt::format("{}: {}", name, error.what())});
      }
    }
    return items;
  }

  // The last entry, or in a building its floors.
  void add_item(const MotionSource& source, std::vector<std::size_t>& items) {
    if (source.building)
      add_floors(source, items);
    else
      items.push_back(entries_.size() - 1);
  }

  // Of the last record, in its building.
  void add_floors(const MotionSource& source, std::vector<std::size_t>& items) {
    const std::size_t ground = entries_.size() - 1;
    const FloorMotion record = entries_.back().motion;
    const std::vector<motion::Mode> modes = motion::modes(drawn(*source.building, study_.seed, record.name));
    if (const std::string why = motion::outside_the_band(record, modes); !why.empty()) throw Error(why, Exit::data);
    motion::BuildingResponse response(record, modes);
    for (const int storey : source.storeys()) {
      items.push_back(storey == 0 ? ground : entries_.size());
      if (storey == 0) continue;
      const std::string name = fmt::format("{} {} storey {}", record.name, source.building->name, storey);
      Entry floor{response.floor(storey, name), false,  0,     0, entries_[ground].group,
                  entries_[ground].numbers,     ground, storey};
      take_peaks(floor);
      entries_.push_back(std::move(floor));
    }
  }

  // Tables with the same column mean the same number.
  void add_numbers(const MotionSource& source, std::vector<double> values, Entry& entry) {
    if (source.building) {
      const motion::Building own = drawn(*source.building, study_.seed, entry.motion.name);
      if (source.building->drawn_period) values.push_back(*own.period_s);
      if (source.building->drawn_damping) values.push_back(own.damping);
    }
    for (std::size_t column = 0; column < source.numbers.size(); ++column) {
      const auto known = std::find_if(numbers_.begin(), numbers_.end(), [&](const motion::RecordNumber& number) {
        return number.name == source.numbers[column].name;
      });
      const auto place = static_cast<std::size_t>(known - numbers_.begin());
      if (known == numbers_.end()) numbers_.push_back(source.numbers[column]);
      entry.numbers.resize(numbers_.size(), not_given);
      entry.numbers[place] =
          numbers_[place].at_scale(values[column], source.processing.scale.value_or(motion::Similitude{}));
    }
  }

  const Study& study_;
  std::vector<Entry> entries_;
  std::vector<motion::RecordNumber> numbers_;
  std::map<std::string, std::size_t> pulses_;
  std::vector<Refusal> problems_;
};

}  // namespace

MotionSet load_motions(const Study& study) {
  MotionSet set;
  Loader loader(study);
  for (const auto& source : study.motions) set.of_source.push_back(loader.load(source));
  set.entries = std::make_shared<const std::vector<Entry>>(loader.finish());
  set.numbers = loader.numbers();
  return set;
}

std::vector<std::string> MotionSet::names() const {
  std::vector<std::string> names;
  for (const auto& entry : *entries) names.push_back(entry.motion.name);
  return names;
}

bool MotionSet::has_floors() const {
  return std::any_of(entries->begin(), entries->end(), [](const Entry& entry) { return entry.ground.has_value(); });
}

// Floors of one record are no more independent than the record is of itself, nor is the same record by another name.
std::vector<int> MotionSet::groups() const {
  std::map<std::string, std::string> group_of;  // of each record that stands in one, for wherever it stands again
  for (const Entry& entry : *entries)
    if (!entry.group.empty()) group_of.try_emplace(entry.motion.name, "group " + entry.group);
  std::map<std::string, int> first;
  std::map<std::uint64_t, std::string> name_of;  // by what the record holds
  std::vector<int> groups;
  for (const Entry& entry : *entries) {
    if (entry.pulse || entry.ground) {
      groups.push_back(entry.pulse ? -1 : groups[*entry.ground]);
      continue;
    }
    std::uint64_t held = 0;
    hash_values(entry.motion.horizontal_mps2, held);
    const std::string& record = name_of.try_emplace(held, entry.motion.name).first->second;
    const auto known = group_of.find(record);
    const std::string group = known == group_of.end() ? "record " + record : known->second;
    groups.push_back(first.try_emplace(group, static_cast<int>(groups.size())).first->second);
  }
  return groups;
}

std::string MotionSet::fingerprint() const {
  std::uint64_t hash = 0;
  for (const Entry& entry : *entries) {
    const FloorMotion& motion = entry.motion;
    hash = random::stable_hash(motion.name, hash) ^ static_cast<std::uint64_t>(motion.degree);
    hash_values(motion.knot_s, hash);
    hash_values(motion.horizontal_mps2, hash);
    hash_values(motion.vertical_mps2, hash);
    if (!motion.cross_mps2.empty()) hash_values(motion.cross_mps2, hash);
    if (entry.weight != 1) hash_values(std::span(&entry.weight, 1), hash);
    if (!entry.known_pulse.any()) continue;
    hash = random::stable_hash(entry.known_pulse.type, hash);
    const double period_s = entry.known_pulse.period_s.value_or(0);
    hash_values(std::span(&period_s, 1), hash);
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace freestand::study
