#include "io/samples_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <freestand/response.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "base/durable_file.hpp"
#include "base/passed_over.hpp"
#include "io/h5.hpp"
#include "io/packed.hpp"

namespace freestand::io {
namespace {

constexpr std::int64_t piece_rows = 8192;        // of a dataset, packed together: what a fit reads at once
constexpr std::int64_t slab_values = 2'000'000;  // rows held at a time, times columns
constexpr int most_packing = 64;                 // ranks at a time, whose pieces the root holds

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

// Datasets of the columns.
std::vector<h5::Dataset> lay_out(const h5::File& file, const SamplesHeader& header, std::int64_t samples_rows) {
  const auto rows = static_cast<std::uint64_t>(samples_rows), piece = std::min<std::uint64_t>(rows, piece_rows);
  std::vector<h5::Dataset> datasets;
  h5::Group root = file.root();
  write_provenance(root, samples_format, header.provenance);
  h5::Group samples = root.make_group("samples");
  const h5::Dataset scale = samples.make_dimension("sample", rows);
  for (const Column& column : header.columns) {
    h5::Dataset dataset = samples.make_in_pieces(column.name, type_of(column.kind), rows, piece);
    dataset.attach(0, scale).describe(column.unit, column.description);
    if (column.name == "outcome") describe_outcome(dataset);
    datasets.push_back(std::move(dataset));
  }
  h5::Group motions = root.make_group("motions");
  lay_out(motions, header.motions);
  return datasets;
}

// Rows of any range, from blocks; the last block is kept, since the next range begins in it.
class Rows {
 public:
  Rows(const BlockLayout& layout, std::size_t columns, const ReadBlock& read)
      : layout_(layout), columns_(columns), read_(read) {}

  std::vector<double> operator()(std::int64_t first, std::int64_t end) {
    std::vector<double> values;
    while (first < end) {
      take(first / layout_.block_size);
      const std::int64_t begin = block_ * layout_.block_size, until = std::min(end, begin + layout_.rows(block_));
      const auto at = [&](std::int64_t row) {
        return block_values_.begin() + (row - begin) * static_cast<std::int64_t>(columns_);
      };
      values.insert(values.end(), at(first), at(until));
      first = until;
    }
    return values;
  }

 private:
  void take(std::int64_t block) {
    if (block == block_) return;
    block_values_ = read_(block);
    block_ = block;
    if (block_values_.size() != static_cast<std::size_t>(layout_.rows(block)) * columns_)
      throw Error(fmt::format("block {} cannot be used ({} values for {} rows of {} columns): run the sweep again",
                              block, block_values_.size(), layout_.rows(block), columns_),
                  Exit::data);
  }

  const BlockLayout& layout_;
  const std::size_t columns_;
  const ReadBlock& read_;
  std::int64_t block_ = -1;
  std::vector<double> block_values_;
};

template <class T>
std::string packed_piece(std::vector<T> values, std::int64_t piece) {
  values.resize(static_cast<std::size_t>(piece));  // the last one too has its whole length
  return packed(std::as_bytes(std::span(values)), sizeof(T));
}

// Of the rows of one piece each column's values, packed.
std::vector<std::string> pieces_of(const std::vector<double>& rows, std::int64_t piece,
                                   const std::vector<Column>& columns) {
  std::vector<std::string> pieces;
  std::vector<double> values(rows.size() / columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t row = 0; row < values.size(); ++row) values[row] = rows[row * columns.size() + c];
    if (columns[c].kind == ColumnKind::real) pieces.push_back(packed_piece(values, piece));
    if (columns[c].kind == ColumnKind::integer)
      pieces.push_back(packed_piece(whole_numbers<std::int32_t>(values, columns[c]), piece));
    if (columns[c].kind == ColumnKind::flag)
      pieces.push_back(packed_piece(whole_numbers<std::uint8_t>(values, columns[c]), piece));
  }
  return pieces;
}

// Texts as words: the length of each and, in whole words, its bytes.
void append(parallel::Words& words, const std::string& text) {
  words.push_back(static_cast<std::int64_t>(text.size()));
  const std::size_t at = words.size();
  words.resize(at + (text.size() + sizeof(std::int64_t) - 1) / sizeof(std::int64_t));
  std::memcpy(words.data() + at, text.data(), text.size());
}
std::string next_text(const parallel::Words& words, std::size_t& at) {
  const auto size = static_cast<std::size_t>(words[at]);
  const std::string text(reinterpret_cast<const char*>(words.data() + at + 1), size);
  at += 1 + (size + sizeof(std::int64_t) - 1) / sizeof(std::int64_t);
  return text;
}

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
  const auto columns = static_cast<std::int64_t>(header.columns.size());
  const std::int64_t piece = std::min(layout.samples, piece_rows);
  // Whole pieces; a block is read by two ranks at most.
  const std::int64_t least = std::max(layout.block_size, slab_values / std::max<std::int64_t>(1, columns));
  const std::int64_t slab = (least + piece_rows - 1) / piece_rows * piece_rows;
  const int packing = std::min(world.size(), most_packing);
  std::optional<h5::File> file;
  std::vector<h5::Dataset> datasets;
  world.on_root([&] {
    file.emplace(h5::File::create_at(aside, path));
    datasets = lay_out(*file, header, layout.samples);
  });
  Rows rows(layout, header.columns.size(), read);
  for (std::int64_t first = 0; columns > 0 && first < layout.samples; first += packing * slab) {
    parallel::Words mine;
    const std::int64_t begin = first + world.rank() * slab, end = std::min(layout.samples, begin + slab);
    for (std::int64_t at = begin; world.rank() < packing && at < end; at += piece)
      for (const std::string& one : pieces_of(rows(at, std::min(at + piece, end)), piece, header.columns))
        append(mine, one);
    const std::vector<parallel::Words> all = world.gather(mine);
    world.on_root([&] {
      std::int64_t row = first;
      for (const parallel::Words& words : all)
        for (std::size_t at = 0; at < words.size(); row += piece)
          for (h5::Dataset& dataset : datasets)
            dataset.write_piece(static_cast<std::uint64_t>(row), next_text(words, at));
    });
  }
  world.on_root([&] {
    datasets.clear();
    file->close();
    publish_durably(aside, path);
  });
}

SampleReader::SampleReader(const std::filesystem::path& path, Closing closing)
    : file_(std::make_shared<const h5::File>(h5::File::open(path, closing))) {
  const h5::Group root = file_->root();
  provenance_ = read_provenance(root, samples_format);
  const h5::Group samples = root.open_group("samples");
  for (const std::string& name : samples.names()) {
    if (name == "sample") continue;
    const h5::Dataset dataset = samples.open_dataset(name);
    const auto rows = static_cast<std::int64_t>(dataset.rows());
    if (columns_.empty()) rows_ = rows;
    if (rows != rows_)
      throw Error(fmt::format("{} cannot be used (its column {} has {} rows, and {} has {}): run the sweep again",
                              path.string(), name, rows, columns_.front().name, rows_),
                  Exit::data);
    columns_.push_back(column_of(name, dataset));
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
