// A small C++ face of the HDF5 C library: files, groups, datasets, attributes, dimension scales.
//
// Everything throws freestand::Error naming the file; HDF5's own error printing is switched off. A new file is written
// aside and gets its name when it is finished, so under its name it is whole; its last line (closing_line.hpp) tells whether it still is
// when it is read. Identifiers of HDF5 are 64-bit integers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/closing_line.hpp"

namespace freestand::io::h5 {

using Id = std::int64_t;
using Dimensions = std::vector<std::uint64_t>;

// One identifier, closed when it goes. Empty when moved from.
class Handle {
 public:
  using Closer = int (*)(Id);
  Handle() = default;
  Handle(Id id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { close(); }

  Id id() const { return id_; }
  void close();
  Id release() { return std::exchange(id_, -1); }  // no longer closed

 private:
  Id id_ = -1;
  Closer closer_ = nullptr;
};

// Anything that carries attributes. Text attributes are variable-length UTF-8 (Python sees str), of any length.
class Object {
 public:
  void attribute(const std::string& name, const std::string& value);
  void attribute(const std::string& name, const char* value) { attribute(name, std::string(value)); }
  void attribute(const std::string& name, double value);
  void attribute(const std::string& name, std::int64_t value);
  void attribute(const std::string& name, int value) { attribute(name, static_cast<std::int64_t>(value)); }
  void attribute(const std::string& name, const std::vector<double>& values);
  void attribute(const std::string& name, const std::vector<std::int64_t>& values);
  void attribute(const std::string& name, const std::vector<std::string>& values);

  bool has_attribute(const std::string& name) const;
  // Throw Error (Exit::data) if there is none or it is of another type.
  std::string text_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;
  double real_attribute(const std::string& name) const;
  std::vector<std::int64_t> integers_attribute(const std::string& name) const;
  std::vector<std::string> texts_attribute(const std::string& name) const;

  const std::string& file_path() const { return *file_; }

 protected:
  Object(Handle handle, std::shared_ptr<const std::string> file) : handle_(std::move(handle)), file_(std::move(file)) {}
  Id id() const { return handle_.id(); }

  Handle handle_;
  std::shared_ptr<const std::string> file_;
};

enum class Type { real, integer, flag, integer64 };  // float64, int32, uint8, int64, little endian

class Dataset : public Object {
 public:
  Dimensions dimensions() const;
  std::size_t rows() const;  // of a dataset of one dimension; Exit::data if it has another number of them
  Type type() const;         // Exit::data if it is none of these

  // Whole dataset, row-major. The count must be that of the dataset; values are converted from the C++ type to the type
  // of the file by HDF5.
  void write(const std::vector<double>& values);
  void write(const std::vector<std::int64_t>& values);
  void write(const std::vector<std::int32_t>& values);
  void write(const std::vector<std::uint8_t>& values);
  // Read whole, row-major; with a count, that many or Error (Exit::data). What the file does not hold takes no memory.
  std::vector<double> read() const;
  std::vector<double> read(std::size_t count) const;
  std::vector<std::int64_t> read_integers() const;
  std::vector<std::int64_t> read_integers(std::size_t count) const;
  std::vector<std::string> read_texts() const;
  std::vector<std::string> read_texts(std::size_t count) const;

  // Rows first .. first+count-1 of a one-dimensional dataset.
  std::vector<double> read_rows(std::uint64_t first, std::uint64_t count) const;

  // Of a dataset in pieces: the one that begins at this row, as packed() makes it, of the whole length also at the end.
  void write_piece(std::uint64_t first, const std::string& packed);

  // Makes it a dimension scale of this name; attaches a scale to a dimension.
  Dataset& scale(const std::string& name);
  Dataset& attach(unsigned dimension, const Dataset& scale);
  // Attributes `unit`, also as `units` for xarray, and `description`; empty ones are left out.
  Dataset& describe(const std::string& unit, const std::string& description);

 private:
  friend class Group;
  using Object::Object;
};

class Group : public Object {
 public:
  Group make_group(const std::string& name);
  Group open_group(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  // of what is in it, in the order of creation

  // A dataset of one dimension that is written in pieces of so many rows, packed (packed.hpp).
  Dataset make_in_pieces(const std::string& name, Type type, std::uint64_t rows, std::uint64_t piece);

  // A dimension whose places have no values of their own, as netCDF-4 has it: a scale of this name that takes no room.
  Dataset make_dimension(const std::string& name, std::uint64_t length);
  Dataset open_dataset(const std::string& name) const;

  // A dataset with its values.
  Dataset put(const std::string& name, const std::vector<double>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::int64_t>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::int32_t>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::uint8_t>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::string>& values);

 protected:
  friend class File;
  Dataset make_dataset(const std::string& name, Type type, const Dimensions& dimensions, std::uint64_t piece);
  template <class T>
  Dataset put_values(const std::string& name, const std::vector<T>& values, Dimensions dimensions);
  using Object::Object;
};

class File {
 public:
  // A new file, by this process alone. It has its name after finish(); without finish() nothing is left.
  static File create(const std::filesystem::path& path);

  // A new file at `aside`, which messages call `path`, for datasets that are written in pieces. It is there, for whoever renames it,
  // after close(); without close() nothing is left.
  static File create_at(const std::filesystem::path& aside, const std::filesystem::path& path);
  void close();

  // An existing file, to read. Any number of processes at once. Throws Error (Exit::data) if it is not what was written.
  static File open(const std::filesystem::path& path, Closing = Closing::check);

  Group root() const;
  void finish();  // of a file that create() has made

  ~File();
  File(File&&) noexcept;
  File(const File&) = delete;
  File& operator=(const File&) = delete;

 private:
  struct State;
  explicit File(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace freestand::io::h5
