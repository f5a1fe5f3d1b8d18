#include "study/motion_bytes.hpp"

#include <cstring>
#include <type_traits>

namespace freestand::study {
namespace {

class ByteWriter {
 public:
  template <class T>
  void operator()(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      (*this)(value.size());
      if constexpr (std::is_same_v<T, std::string>)
        bytes_ += value;
      else
        for (const auto& item : value) (*this)(item);
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      std::memcpy(&value, bytes_.data() + at_, sizeof value);
      at_ += sizeof value;
    } else {
      std::size_t size = 0;
      (*this)(size);
      value.resize(size);
      for (auto& item : value) (*this)(item);
    }
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

// Nothing is a list of no items.
template <class Archive, class T>
void pass(Archive& archive, std::optional<T>& value) {
  std::vector<T> list(value ? 1 : 0, value.value_or(T{}));
  archive(list);
  value = list.empty() ? std::optional<T>() : std::optional<T>(list.front());
}

template <class Archive>
void pass(Archive& archive, MotionSet::Entry& entry) {
  FloorMotion& motion = entry.motion;
  archive(motion.name);
  archive(motion.degree);
  for (std::vector<double>* list :
       {&motion.knot_s, &motion.horizontal_mps2, &motion.vertical_mps2, &motion.cross_mps2, &entry.numbers})
    archive(*list);
  archive(entry.pulse);
  archive(entry.peak_mps2);
  archive(entry.peak_mps);
  archive(entry.group);
  pass(archive, entry.ground);
  archive(entry.storey);
  archive(entry.known_pulse.type);
  pass(archive, entry.known_pulse.period_s);
  archive(entry.weight);
}

template <class Archive>
void pass(Archive& archive, motion::RecordNumber& number) {
  archive(number.name);
  archive(number.unit);
  archive(number.power);
  archive(number.length);
  archive(number.time);
}

template <class Archive, class T>
void pass_all(Archive& archive, std::vector<T>& list) {
  std::size_t size = list.size();
  archive(size);
  list.resize(size);
  for (T& item : list) pass(archive, item);
}

template <class Archive>
void pass(Archive& archive, MotionSet& set, std::vector<MotionSet::Entry>& entries) {
  pass_all(archive, set.numbers);
  archive(set.of_source);
  pass_all(archive, entries);
}

}  // namespace

std::string bytes_of(const MotionSet& set) {
  ByteWriter writer;
  MotionSet copy = set;
  std::vector<MotionSet::Entry> entries = *set.entries;
  pass(writer, copy, entries);
  return writer.bytes();
}

MotionSet motions_of(const std::string& bytes) {
  ByteReader reader(bytes);
  MotionSet set;
  std::vector<MotionSet::Entry> entries;
  pass(reader, set, entries);
  for (MotionSet::Entry& entry : entries) index_runs(entry.motion);
  set.entries = std::make_shared<const std::vector<MotionSet::Entry>>(std::move(entries));
  return set;
}

MotionSet load_motions_together(const parallel::Communicator& world, const Study& study) {
  MotionSet motions;
  world.on_root([&] { motions = load_motions(study); });
  if (world.size() == 1) return motions;
  const std::string bytes = world.broadcast(world.is_root() ? bytes_of(motions) : std::string());
  return world.is_root() ? motions : motions_of(bytes);
}

}  // namespace freestand::study
