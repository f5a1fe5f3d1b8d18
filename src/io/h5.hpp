// A small C++ face of the HDF5 C library: files, groups, datasets, attributes, dimension scales.
//
// Everything throws freestand::Error naming the file; HDF5's own error printing is switched off. A new file is written
// aside and gets its name when it is finished, so under its name it is whole. Identifiers of HDF5 are 64-bit integers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/durable_file.hpp"

namespace freestand::io::h5 {

using Id = std::int64_t;
using Dimensions = std::vector<std::uint64_t>;

// Ranks of the run as HDF5 sees them: 0 of 1 where MPI was not started.
int world_rank();
int world_size();

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
  Type type() const;  // Exit::data if it is none of these

  // Whole dataset, row-major. The count must be that of the dataset; values are converted from the C++ type to the type
  // of the file by HDF5.
  void write(const std::vector<double>& values);
  void write(const std::vector<std::int64_t>& values);
  void write(const std::vector<std::int32_t>& values);
  void write(const std::vector<std::uint8_t>& values);
  std::vector<double> read() const;
  std::vector<std::string> read_texts() const;

  // Rows first .. first+count-1 of a one-dimensional dataset. In a file opened with open_together, write_rows is
  // collective: every rank calls it, with count 0 where it has nothing.
  void write_rows(std::uint64_t first, const std::vector<double>& values);
  void write_rows(std::uint64_t first, const std::vector<std::int32_t>& values);
  void write_rows(std::uint64_t first, const std::vector<std::uint8_t>& values);
  std::vector<double> read_rows(std::uint64_t first, std::uint64_t count) const;

  // Makes it a dimension scale of this name; attaches a scale to a dimension.
  Dataset& scale(const std::string& name);
  Dataset& attach(unsigned dimension, const Dataset& scale);
  // Attributes `unit`, also as `units` for xarray, and `description`; empty ones are left out.
  Dataset& describe(const std::string& unit, const std::string& description);

 private:
  friend class Group;
  Dataset(Handle handle, std::shared_ptr<const std::string> file, bool together)
      : Object(std::move(handle), std::move(file)), together_(together) {}
  bool together_;
};

class Group : public Object {
 public:
  Group make_group(const std::string& name);
  Group open_group(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  // of what is in it, in the order of creation

  // A dataset without values yet: contiguous, not filled.
  Dataset make_dataset(const std::string& name, Type type, const Dimensions& dimensions);
  Dataset open_dataset(const std::string& name) const;

  // A dataset with its values.
  Dataset put(const std::string& name, const std::vector<double>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::int64_t>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::int32_t>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::uint8_t>& values, Dimensions dimensions = {});
  Dataset put(const std::string& name, const std::vector<std::string>& values);

 protected:
  friend class File;
  template <class T>
  Dataset put_values(const std::string& name, const std::vector<T>& values, Dimensions dimensions);
  Group(Handle handle, std::shared_ptr<const std::string> file, bool together)
      : Object(std::move(handle), std::move(file)), together_(together) {}
  bool together_ = false;
};

class File {
 public:
  // A new file, by this process alone. It has its name after finish(); without finish() nothing is left.
  static File create(const std::filesystem::path& path);

  // A new file by all ranks: `layout` makes groups, datasets and attributes, on rank 0 alone; then every rank holds the
  // file, for Dataset::write_rows. finish() gives it its name. Collective. The file is the same to the byte for any
  // number of ranks. Without mpirun there is one rank.
  template <class Layout>
  static File create_together(const std::filesystem::path& path, const Layout& layout) {
    const std::filesystem::path aside = aside_together(path);
    if (world_rank() == 0) {
      File file = create(path);
      layout(file);
      write_durably(aside, file.image());
    }
    return open_together(aside, path);
  }

  // An existing file, to read. Any number of processes at once. Throws Error (Exit::data) if it is not HDF5.
  static File open(const std::filesystem::path& path);

  Group root() const;
  // Closes, syncs, renames. Collective for a file made together.
  void finish();

  ~File();
  File(File&&) noexcept;
  File(const File&) = delete;
  File& operator=(const File&) = delete;

 private:
  struct State;
  explicit File(std::unique_ptr<State> state);
  static std::filesystem::path aside_together(const std::filesystem::path& path);
  static File open_together(const std::filesystem::path& aside, const std::filesystem::path& path);
  std::string image() const;  // the bytes of a file that is made

  std::unique_ptr<State> state_;
};

}  // namespace freestand::io::h5
