// Loads every floor motion of a study once.
#include <fmt/format.h>

#include <bit>
#include <map>

#include "base/random.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "motion/record.hpp"
#include "study/problems.hpp"
#include "study/realise.hpp"

namespace freestand::study {
namespace {

using Entry = MotionSet::Entry;

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

Entry load_record(const MotionSource& source, std::size_t i, const std::filesystem::path& folder) {
  motion::ReadOptions options;
  options.dt_s = source.dt_s;
  options.unit = source.unit;
  options.format = source.format;
  options.channel = source.channel;
  options.component = motion::Component::horizontal;
  if (!source.vertical_files.empty()) options.vertical_file = source.vertical_files[i].string();
  Entry entry{motion::read_record(source.files[i], options), false, 0, 0};
  entry.motion.name = record_name(source.files[i], source, folder);
  const motion::MotionPeaks peaks = motion::peaks(entry.motion);
  entry.peak_mps2 = peaks.pga_mps2;
  entry.peak_mps = peaks.pgv_mps;
  if (!(entry.peak_mps2 > 0))
    throw Error(
        fmt::format("{} is zero throughout (nothing would shake, whatever its scale): leave it out, or get it again",
                    source.files[i].string()),
        Exit::data);
  return entry;
}

bool shakes_vertically(const Study& study) {
  for (const auto& effect : study.model.effects)
    if (effect.name == "vertical_shaking") return true;
  return false;
}

void hash_values(const std::vector<double>& values, std::uint64_t& hash) {
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
    for (std::size_t i = 0; i < source.files.size(); ++i) {
      try {
        entries_.push_back(load_record(source, i, study_.folder));
        items.push_back(entries_.size() - 1);
      } catch (const Error& error) {
        problems_ += (problems_.empty() ? "" : "\n") + std::string(error.what());
      }
    }
    return items;
  }

  std::vector<Entry> finish() {
    if (!problems_.empty()) throw Error(problems_, Exit::data);
    bool vertical = !shakes_vertically(study_);
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

  const Study& study_;
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t> pulses_;
  std::string problems_;
};

}  // namespace

MotionSet load_motions(const Study& study) {
  MotionSet set;
  Loader loader(study);
  for (const auto& source : study.motions) set.of_source.push_back(loader.load(source));
  set.entries = std::make_shared<const std::vector<Entry>>(loader.finish());
  return set;
}

std::vector<std::string> MotionSet::names() const {
  std::vector<std::string> names;
  for (const auto& entry : *entries) names.push_back(entry.motion.name);
  return names;
}

std::vector<int> MotionSet::groups() const {
  std::vector<int> groups;
  for (const Entry& entry : *entries) groups.push_back(entry.pulse ? -1 : static_cast<int>(groups.size()));
  return groups;
}

std::string MotionSet::fingerprint() const {
  std::uint64_t hash = 0;
  for (const auto& [motion, pulse, peak_mps2, peak_mps] : *entries) {
    hash = random::stable_hash(motion.name, hash) ^ static_cast<std::uint64_t>(motion.degree);
    hash_values(motion.knot_s, hash);
    hash_values(motion.horizontal_mps2, hash);
    hash_values(motion.vertical_mps2, hash);
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace freestand::study
