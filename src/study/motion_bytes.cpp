#include "study/motion_bytes.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <concepts>
#include <cstring>
#include <type_traits>
#include <utility>

#include "base/motion_table.hpp"
#include "parallel/node_copy.hpp"
#include "parallel/progress.hpp"

namespace freestand::study {
namespace {

constexpr std::size_t after_row(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

// What an archive takes apart, to be read by a writer and filled by a reader. Each part is named, so that what gets another
// member does not compile until that travels too.
template <class T, class Of>
concept Either = std::same_as<std::remove_const_t<T>, Of>;

template <class Archive>
void pass(Archive& archive, Either<MotionTable> auto& table) {
  auto& [step, rate, knots, a, V, D, margin, run_peak, later_peak, columns, v, both, later_v, heights, backwards,
         to_height, levels, run_levels, to_level] = table;
  archive(step, rate, knots, a, V, D, margin, run_peak, later_peak, columns, v, both, later_v, heights, backwards,
          to_height, levels, run_levels, to_level);
}

template <class Archive>
void pass(Archive& archive, Either<FloorMotion> auto& motion) {
  auto& [name, knots, degree, along, up, across, along_runs, up_runs, across_runs, ratio, table] = motion;
  archive(name, knots, degree, along, up, across, along_runs, up_runs, across_runs, ratio, table);
}

template <class Archive>
void pass(Archive& archive, Either<motion::KnownPulse> auto& pulse) {
  auto& [type, period] = pulse;
  archive(type, period);
}

template <class Archive>
void pass(Archive& archive, Either<MotionSet::Entry> auto& entry) {
  auto& [motion, pulse, peak_a, peak_v, group, numbers, ground, storey, known_pulse, weight] = entry;
  archive(motion, pulse, peak_a, peak_v, group, numbers, ground, storey, known_pulse, weight);
}

template <class Archive>
void pass(Archive& archive, Either<motion::RecordNumber> auto& number) {
  auto& [name, unit, power, length, time] = number;
  archive(name, unit, power, length, time);
}

// Nothing is told from something by a flag before it.
class RowWriter {
 public:
  explicit RowWriter(MotionBytes& to) : to_(to) {}
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_arithmetic_v<T>)
      to_.words.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      pass(*this, value);
  }
  void write(const std::string& text) {
    write(text.size());
    to_.words += text;
  }
  template <class T>
  void write(const std::vector<T>& list) {
    write(list.size());
    for (const T& item : list) write(item);
  }
  template <class T>
  void write(const std::vector<T, LineAllocator<T>>& row) {
    write(row.size());
    to_.rows.push_back(std::as_bytes(std::span(row)));
    to_.row_bytes += after_row(to_.rows.back().size());
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class T>
  void write(const std::shared_ptr<const T>& value) {
    write(value != nullptr);
    if (value) write(*value);
  }

  MotionBytes& to_;
};

class RowReader {
 public:
  RowReader(const std::string& words, std::shared_ptr<const std::byte> rows) : words_(words), rows_(std::move(rows)) {}
  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      std::memcpy(&value, words_.data() + at_, sizeof value);
      at_ += sizeof value;
    } else {
      pass(*this, value);
    }
  }
  template <class T>
  T read() {
    T value{};
    read(value);
    return value;
  }
  void read(std::string& text) {
    const auto size = read<std::size_t>();
    text = words_.substr(at_, size);
    at_ += size;
  }
  template <class T>
  void read(std::vector<T>& list) {
    list.resize(read<std::size_t>());
    for (T& item : list) read(item);
  }
  template <class T>
  void read(std::vector<T, LineAllocator<T>>& row) {
    const auto size = read<std::size_t>();
    const auto* first = reinterpret_cast<const T*>(rows_.get() + row_at_);
    row = std::vector<T, LineAllocator<T>>(size, LineAllocator<T>({rows_, first}, size));
    row_at_ += after_row(size * sizeof(T));
  }
  template <class T>
  void read(std::optional<T>& value) {
    if (read<bool>()) read(value.emplace());
  }
  template <class T>
  void read(std::shared_ptr<const T>& value) {
    if (read<bool>()) value = std::make_shared<const T>(read<T>());
  }

  const std::string& words_;
  std::shared_ptr<const std::byte> rows_;
  std::size_t at_ = 0, row_at_ = 0;
};

}  // namespace

void MotionBytes::write_rows(std::byte* to) const {
  for (const auto& row : rows) {
    if (!row.empty()) std::memcpy(to, row.data(), row.size());
    to += after_row(row.size());
  }
}

MotionBytes bytes_of(const MotionSet& set) {
  MotionBytes bytes;
  RowWriter{bytes}(set.numbers, set.of_source, *set.entries);
  return bytes;
}

MotionSet motions_of(const std::string& words, std::shared_ptr<const std::byte> rows) {
  MotionSet set;
  std::vector<MotionSet::Entry> entries;
  RowReader{words, std::move(rows)}(set.numbers, set.of_source, entries);
  set.entries = std::make_shared<const std::vector<MotionSet::Entry>>(std::move(entries));
  return set;
}

MotionSet load_motions_together(const parallel::Communicator& world, const Study& study) {
  MotionSet motions;
  world.on_root([&] { motions = load_motions(study); });
  if (world.size() == 1) return motions;
  MotionBytes bytes = world.is_root() ? bytes_of(motions) : MotionBytes();
  bytes.words = world.broadcast(std::move(bytes.words));
  const auto size =
      static_cast<std::size_t>(world.broadcast(parallel::Words{static_cast<std::int64_t>(bytes.row_bytes)})[0]);
  const parallel::NodeCopy rows = parallel::copy_to_nodes(world, size, [&](std::byte* to) { bytes.write_rows(to); });
  static bool told = false;  // a catalogue loads motions again for each of its entries
  if (world.is_root() && rows.own_copies > 0 && !std::exchange(told, true))
    parallel::tell(fmt::format(
        "{} ranks each hold a copy of their own of the floor motions, {:.1f} MB (their node has less room than that in "
        "/dev/shm, where its ranks would share one): make room there, or start fewer ranks on a node\n",
        rows.own_copies, static_cast<double>(size) / 1e6));
  motions = {};
  ::malloc_trim(0);  // what the root has read goes back to the system
  return motions_of(bytes.words, rows.first);
}

}  // namespace freestand::study
