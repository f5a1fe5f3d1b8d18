#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <functional>
#include <numeric>

#include "io/h5_internal.hpp"

namespace freestand::io::h5 {
namespace {

std::size_t count_of(const Dimensions& dimensions) {
  return std::accumulate(dimensions.begin(), dimensions.end(), std::size_t{1}, std::multiplies<>());
}

std::string name_of(Id dataset) {
  char text[256] = {};
  H5Iget_name(dataset, text, sizeof text);
  return text;
}

Handle space_of(Id dataset, const std::string& file) {
  return checked(H5Dget_space(dataset), H5Sclose, file, "shape of a dataset", Doing::reading);
}

template <class T>
void write_all(Id dataset, const std::string& file, const Dimensions& dimensions, const std::vector<T>& values) {
  if (values.size() != count_of(dimensions))
    throw Error(fmt::format("cannot write {} ({} values for {} [{}]): report this", file, values.size(),
                            name_of(dataset), fmt::join(dimensions, ", ")),
                Exit::data);
  const std::string name = name_of(dataset);  // before the call: asking for it afterwards would clear HDF5's errors
  if (!values.empty() && H5Dwrite(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw failure(file, name, Doing::writing);
}

// Memory and file spaces of a run of rows; nothing selected for no rows.
struct RowSpaces {
  Handle memory, file;

  RowSpaces(Id dataset, const std::string& name, std::uint64_t first, std::uint64_t count)
      : file(space_of(dataset, name)) {
    const hsize_t start = first, length = count;
    memory = checked(H5Screate_simple(1, &length, nullptr), H5Sclose, name, "rows of a dataset", Doing::writing);
    if (count == 0) {
      H5Sselect_none(file.id());
      H5Sselect_none(memory.id());
    } else {
      H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, &start, nullptr, &length, nullptr);
    }
  }
};

// deflate makes a thousandth of what is all alike (1032 to 1, as zlib's page says), and nothing less: a dataset of more values than that
// is none that was written.
constexpr double most_packed = 1032;

// A piece is unpacked as a whole: none is larger than the dataset.
void expect_small_pieces(Id dataset, const std::string& file, const Dimensions& dimensions) {
  const Handle how =
      checked(H5Dget_create_plist(dataset), H5Pclose, file, "layout of " + name_of(dataset), Doing::reading);
  if (H5Pget_layout(how.id()) != H5D_CHUNKED) return;
  std::vector<hsize_t> piece(dimensions.size());
  H5Pget_chunk(how.id(), static_cast<int>(piece.size()), piece.data());
  for (std::size_t i = 0; i < piece.size(); ++i)
    if (piece[i] > std::max<hsize_t>(1, dimensions[i]))
      throw failure(file,
                    fmt::format("{} has pieces of {} rows, and {} rows", name_of(dataset), piece[i], dimensions[i]),
                    Doing::reading);
}

// How many values the dataset has. Throws where the file cannot hold them.
std::size_t held_count(Id dataset, const std::string& file, const Dimensions& dimensions) {
  expect_small_pieces(dataset, file, dimensions);
  const Handle type = checked(H5Dget_type(dataset), H5Tclose, file, "type of a dataset", Doing::reading);
  double bytes = static_cast<double>(H5Tget_size(type.id()));
  for (const std::uint64_t extent : dimensions) bytes *= static_cast<double>(extent);
  const auto stored = static_cast<double>(std::min(H5Dget_storage_size(dataset), file_bytes(dataset)));
  if (bytes > most_packed * stored)
    throw failure(file,
                  fmt::format("{} is to have {:.4g} bytes, of which {:.4g} are there", name_of(dataset), bytes, stored),
                  Doing::reading);
  return count_of(dimensions);
}

template <class T>
std::vector<T> read_all(Id id, const std::string& file, const Dimensions& dimensions) {
  std::vector<T> values(held_count(id, file, dimensions));
  const std::string name = name_of(id);
  if (!values.empty() && H5Dread(id, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw failure(file, name, Doing::reading);
  return values;
}

template <class T>
std::vector<T> counted(std::vector<T> values, std::size_t count, Id dataset, const std::string& file) {
  if (values.size() == count) return values;
  throw failure(file, fmt::format("{} holds {} values, and {} belong there", name_of(dataset), values.size(), count),
                Doing::reading);
}

}  // namespace

Dimensions Dataset::dimensions() const {
  const Handle space = space_of(id(), *file_);
  if (H5Sget_simple_extent_type(space.id()) == H5S_NULL) return {0};  // made without any values
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

std::size_t Dataset::rows() const {
  const Dimensions extent = dimensions();
  if (extent.size() != 1)
    throw failure(*file_, fmt::format("{} has {} dimensions instead of one", name_of(id()), extent.size()),
                  Doing::reading);
  return held_count(id(), *file_, extent);
}

Type Dataset::type() const {
  const Handle type = checked(H5Dget_type(id()), H5Tclose, *file_, "type of a dataset", Doing::reading);
  const H5T_class_t kind = H5Tget_class(type.id());
  const std::size_t bytes = H5Tget_size(type.id());
  if (kind == H5T_FLOAT && bytes == 8) return Type::real;
  if (kind == H5T_INTEGER && bytes == 8) return Type::integer64;
  if (kind == H5T_INTEGER && bytes == 4) return Type::integer;
  if (kind == H5T_INTEGER && bytes == 1) return Type::flag;
  throw failure(*file_, name_of(id()) + " is of a type that freestand does not write", Doing::reading);
}

void Dataset::write(const std::vector<double>& values) { write_all(id(), *file_, dimensions(), values); }
void Dataset::write(const std::vector<std::int64_t>& values) { write_all(id(), *file_, dimensions(), values); }
void Dataset::write(const std::vector<std::int32_t>& values) { write_all(id(), *file_, dimensions(), values); }
void Dataset::write(const std::vector<std::uint8_t>& values) { write_all(id(), *file_, dimensions(), values); }

std::vector<double> Dataset::read() const { return read_all<double>(id(), *file_, dimensions()); }
std::vector<double> Dataset::read(std::size_t count) const { return counted(read(), count, id(), *file_); }
std::vector<std::int64_t> Dataset::read_integers() const { return read_all<std::int64_t>(id(), *file_, dimensions()); }
std::vector<std::int64_t> Dataset::read_integers(std::size_t count) const {
  return counted(read_integers(), count, id(), *file_);
}

std::vector<std::string> Dataset::read_texts() const {
  std::vector<char*> texts(held_count(id(), *file_, dimensions()), nullptr);
  if (texts.empty()) return {};
  const Handle type = text_type(*file_);
  const Handle space = space_of(id(), *file_);
  const std::string name = name_of(id());
  if (H5Dread(id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) < 0)
    throw failure(*file_, name, Doing::reading);
  std::vector<std::string> values;
  for (const char* text : texts) values.emplace_back(text ? text : "");
  H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, texts.data());
  return values;
}

std::vector<std::string> Dataset::read_texts(std::size_t count) const {
  return counted(read_texts(), count, id(), *file_);
}

void Dataset::write_piece(std::uint64_t first, const std::string& packed) {
  const hsize_t at = first;
  const std::string name = name_of(id());
  if (H5Dwrite_chunk(id(), H5P_DEFAULT, 0, &at, packed.size(), packed.data()) < 0)
    throw failure(*file_, name, Doing::writing);
}

std::vector<double> Dataset::read_rows(std::uint64_t first, std::uint64_t count) const {
  const std::string name = name_of(id());
  if (count == 0) return {};
  if (first + count > rows())
    throw failure(*file_, fmt::format("{} ends before row {}", name, first + count), Doing::reading);
  std::vector<double> values(count);
  const RowSpaces spaces(id(), *file_, first, count);
  if (H5Dread(id(), H5T_NATIVE_DOUBLE, spaces.memory.id(), spaces.file.id(), H5P_DEFAULT, values.data()) < 0)
    throw failure(*file_, fmt::format("rows {} to {} of {}", first, first + count, name), Doing::reading);
  return values;
}

Dataset& Dataset::scale(const std::string& name) {
  if (H5DSset_scale(id(), name.c_str()) < 0) throw failure(*file_, "dimension scale " + name, Doing::writing);
  return *this;
}

Dataset& Dataset::attach(unsigned dimension, const Dataset& scale) {
  const std::string name = name_of(id());
  if (H5DSattach_scale(id(), scale.id(), dimension) < 0)
    throw failure(*file_, "dimension scale of " + name, Doing::writing);
  return *this;
}

Dataset& Dataset::describe(const std::string& unit, const std::string& description) {
  if (!unit.empty()) {
    attribute("unit", unit);
    attribute("units", unit);
  }
  if (!description.empty()) attribute("description", description);
  return *this;
}

}  // namespace freestand::io::h5
