#include "io/samples_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <freestand/response.hpp>
#include <limits>
#include <numeric>
#include <span>

#include "base/durable_file.hpp"
#include "base/open_file.hpp"
#include "base/passed_over.hpp"
#include "io/h5.hpp"

namespace freestand::io {
namespace {

constexpr std::int64_t slab_values = 2'000'000;  // rows held at a time, times columns

h5::Type type_of(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::integer:
      return h5::Type::integer;
    case ColumnKind::flag:
      return h5::Type::flag;
    case ColumnKind::real:
      break;
  }
  return h5::Type::real;
}

ColumnKind kind_of(h5::Type type) {
  if (type == h5::Type::integer || type == h5::Type::integer64) return ColumnKind::integer;
  return type == h5::Type::flag ? ColumnKind::flag : ColumnKind::real;
}

// "at_rest moved overturned ..." and 0 1 2 ..., as the climate and forecast conventions name the values of a flag.
void describe_outcome(h5::Dataset& dataset) {
  std::string meanings;
  std::vector<std::int64_t> values;
  for (int i = 0; i < outcome_count; ++i) {
    if (i) meanings += ' ';
    meanings += name(static_cast<Outcome>(i));
    values.push_back(i);
  }
  meanings += std::string(" ") + passed_over_name;
  values.push_back(static_cast<std::int64_t>(passed_over));
  dataset.attribute("flag_values", values);
  dataset.attribute("flag_meanings", meanings);
}

std::vector<std::int64_t> counted(std::size_t n) {
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

template <class T>
std::vector<T> whole_numbers(const std::vector<double>& values, const Column& column) {
  std::vector<T> whole;
  whole.reserve(values.size());
  for (const double value : values) {
    if (!(value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max()) ||
        value != std::floor(value))
      throw Error(fmt::format("column {} cannot be stored ({} is no whole number of its range): report this",
                              column.name, value),
                  Exit::data);
    whole.push_back(static_cast<T>(value));
  }
  return whole;
}

void lay_out(h5::Group& group, const MotionRows& motions) {
  group.attribute("fingerprint", motions.fingerprint);
  h5::Dataset motion = group.put("motion", counted(motions.names.size()));
  motion.scale("motion").describe("", "number of the floor motion, the samples' column motion");
  group.put("name", motions.names).attach(0, motion).describe("", "name of the floor motion");
  group.put("group", motions.group)
      .attach(0, motion)
      .describe("1", "records whose samples are not independent have one number; -1: a family of pulses");
  const std::vector<Column>& columns = motions.table.columns;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double> values;
    for (std::size_t row = 0; row < motions.table.rows(); ++row) values.push_back(motions.table.at(row, c));
    h5::Dataset dataset = columns[c].kind == ColumnKind::real
                              ? group.put(columns[c].name, values)
                              : group.put(columns[c].name, whole_numbers<std::int32_t>(values, columns[c]));
    dataset.attach(0, motion).describe(columns[c].unit, columns[c].description);
  }
  h5::Dataset period = group.put("period_s", motions.sa_period_s);
  period.scale("period_s").describe("s", "period of the oscillator");
  group.put("sa_mps2", motions.sa_mps2, {motions.names.size(), motions.sa_period_s.size()})
      .attach(0, motion)
      .attach(1, period)
      .describe("m/s2", "pseudo-spectral acceleration at scale 1, 5 % damping; of pulses with a period of 1 s");
}

// Where the values of each column begin in the file, those of the samples' numbers at the end.
parallel::Words lay_out(const std::filesystem::path& aside, const std::filesystem::path& path,
                        const SamplesHeader& header, std::int64_t rows) {
  const h5::Dimensions all{static_cast<std::uint64_t>(rows)};
  parallel::Words places;
  h5::File file = h5::File::create_at(aside, path);
  h5::Group root = file.root();
  write_provenance(root, samples_format, header.provenance);
  h5::Group samples = root.make_group("samples");
  h5::Dataset scale = samples.reserve_dataset("sample", h5::Type::integer64, all);
  scale.scale("sample").describe("", "number of the sample");
  for (const Column& column : header.columns) {
    h5::Dataset dataset = samples.reserve_dataset(column.name, type_of(column.kind), all);
    dataset.attach(0, scale).describe(column.unit, column.description);
    if (column.name == "outcome") describe_outcome(dataset);
    places.push_back(dataset.offset());
  }
  places.push_back(scale.offset());
  h5::Group motions = root.make_group("motions");
  lay_out(motions, header.motions);
  file.close();
  return places;
}

// Rows of consecutive blocks, row-major.
struct Slab {
  std::int64_t first = 0;
  std::vector<double> values;
};

Slab read_slab(const BlockLayout& layout, std::size_t columns, std::int64_t first_block, std::int64_t end_block,
               const ReadBlock& read) {
  Slab slab{first_block * layout.block_size, {}};
  for (std::int64_t block = first_block; block < end_block; ++block) {
    const std::vector<double> rows = read(block);
    if (rows.size() != static_cast<std::size_t>(layout.rows(block)) * columns)
      throw Error(fmt::format("block {} cannot be used ({} values for {} rows of {} columns): run the sweep again",
                              block, rows.size(), layout.rows(block), columns),
                  Exit::data);
    slab.values.insert(slab.values.end(), rows.begin(), rows.end());
  }
  return slab;
}

// The file's datasets, at the places where they begin.
class Columns {
 public:
  Columns(const std::filesystem::path& aside, const std::filesystem::path& path, const std::vector<Column>& columns,
          parallel::Words places)
      : path_(path), columns_(columns), places_(std::move(places)), file_(aside, O_WRONLY) {
    check(static_cast<bool>(file_));
  }

  void write(const Slab& slab) const {
    const std::size_t rows = slab.values.size() / columns_.size();
    std::vector<double> values(rows);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      for (std::size_t row = 0; row < rows; ++row) values[row] = slab.values[row * columns_.size() + c];
      if (columns_[c].kind == ColumnKind::real) put(c, slab.first, values);
      if (columns_[c].kind == ColumnKind::integer) put(c, slab.first, whole_numbers<std::int32_t>(values, columns_[c]));
      if (columns_[c].kind == ColumnKind::flag) put(c, slab.first, whole_numbers<std::uint8_t>(values, columns_[c]));
    }
    std::vector<std::int64_t> numbers(rows);
    std::iota(numbers.begin(), numbers.end(), slab.first);
    put(columns_.size(), slab.first, numbers);
  }

  void finish() {
    check(file_.sync());
    check(file_.close());
  }

 private:
  void check(bool done) const {
    if (!done) throw file_error("write", path_, errno);
  }

  template <class T>
  void put(std::size_t column, std::int64_t first, const std::vector<T>& values) const {
    check(
        file_.write(std::as_bytes(std::span(values)), places_[column] + first * static_cast<std::int64_t>(sizeof(T))));
  }

  const std::filesystem::path& path_;
  const std::vector<Column>& columns_;
  const parallel::Words places_;
  OpenFile file_;
};

// What is left under the name aside where an error ends the writing.
struct Leftover {
  std::filesystem::path path;
  ~Leftover() {
    if (!path.empty()) ::unlink(path.c_str());
  }
};

Column column_of(const std::string& name, const h5::Dataset& dataset) {
  const auto text = [&](const char* key) { return dataset.has_attribute(key) ? dataset.text_attribute(key) : ""; };
  return {name, text("unit"), text("description"), kind_of(dataset.type())};
}

MotionRows read_motions(const h5::Group& group) {
  MotionRows motions;
  motions.fingerprint = group.text_attribute("fingerprint");
  motions.names = group.open_dataset("name").read_texts();
  for (const std::int64_t number : group.open_dataset("group").read_integers())
    motions.group.push_back(static_cast<int>(number));
  motions.sa_period_s = group.open_dataset("period_s").read();
  motions.sa_mps2 = group.open_dataset("sa_mps2").read();
  std::vector<std::vector<double>> columns;
  for (const std::string& name : group.names()) {
    if (name == "motion" || name == "name" || name == "group" || name == "period_s" || name == "sa_mps2") continue;
    const h5::Dataset dataset = group.open_dataset(name);
    motions.table.columns.push_back(column_of(name, dataset));
    columns.push_back(dataset.read());
  }
  const std::size_t count = motions.names.size();
  const bool whole = motions.group.size() == count && motions.sa_mps2.size() == count * motions.sa_period_s.size() &&
                     std::all_of(columns.begin(), columns.end(), [&](const auto& c) { return c.size() == count; });
  if (!whole)
    throw Error(fmt::format("{} cannot be used (the tables of its motions differ in length): run the sweep again",
                            group.file_path()),
                Exit::data);
  for (std::size_t row = 0; row < count; ++row)
    for (const std::vector<double>& column : columns) motions.table.values.push_back(column[row]);
  return motions;
}

}  // namespace

std::int64_t BlockLayout::rows(std::int64_t block) const {
  return std::clamp<std::int64_t>(samples - block * block_size, 0, block_size);
}

void write_samples(const parallel::Communicator& world, const std::filesystem::path& path, const SamplesHeader& header,
                   const BlockLayout& layout, const ReadBlock& read) {
  const std::filesystem::path aside = path.parent_path() / fmt::format(".{}.part", path.filename().string());
  Leftover leftover;
  parallel::Words places;
  if (world.is_root()) {
    places = lay_out(aside, path, header, layout.samples);
    leftover.path = aside;
  }
  Columns file(aside, path, header.columns, world.broadcast(places));
  const auto columns = static_cast<std::int64_t>(header.columns.size());
  const std::int64_t run =
      std::max<std::int64_t>(1, slab_values / std::max<std::int64_t>(1, columns * layout.block_size));
  const std::int64_t blocks = layout.blocks();
  for (std::int64_t first = world.rank() * run; columns > 0 && first < blocks; first += run * world.size())
    file.write(read_slab(layout, header.columns.size(), first, std::min(first + run, blocks), read));
  file.finish();
  world.barrier();
  world.on_root([&] {
    publish_durably(aside, path);
    leftover.path.clear();
  });
}

SampleReader::SampleReader(const std::filesystem::path& path)
    : file_(std::make_shared<const h5::File>(h5::File::open(path))) {
  const h5::Group root = file_->root();
  provenance_ = read_provenance(root, samples_format);
  const h5::Group samples = root.open_group("samples");
  const std::size_t rows = samples.open_dataset("sample").rows();
  rows_ = static_cast<std::int64_t>(rows);
  for (const std::string& name : samples.names()) {
    const h5::Dataset dataset = samples.open_dataset(name);
    if (dataset.rows() != rows)
      throw Error(fmt::format("{} cannot be used (its column {} has {} rows, and {} samples): run the sweep again",
                              path.string(), name, dataset.rows(), rows),
                  Exit::data);
    if (name != "sample") columns_.push_back(column_of(name, dataset));
  }
  motions_ = read_motions(root.open_group("motions"));
}

Table SampleReader::read(std::int64_t first, std::int64_t count) const {
  std::vector<std::string> names;
  for (const Column& column : columns_) names.push_back(column.name);
  return read(first, count, names);
}

Table SampleReader::read(std::int64_t first, std::int64_t count, const std::vector<std::string>& names) const {
  if (first < 0 || count < 0 || first + count > rows_)
    throw Error(fmt::format("no samples {} to {} (there are {}): ask for fewer", first, first + count, rows_),
                Exit::data);
  Table table;
  table.values.resize(static_cast<std::size_t>(count) * names.size());
  const h5::Group samples = file_->root().open_group("samples");
  for (std::size_t c = 0; c < names.size(); ++c) {
    table.columns.push_back(columns_[column_index(columns_, names[c])]);
    const std::vector<double> values =
        samples.open_dataset(names[c]).read_rows(static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(count));
    for (std::size_t row = 0; row < values.size(); ++row) table.values[row * names.size() + c] = values[row];
  }
  return table;
}

}  // namespace freestand::io
