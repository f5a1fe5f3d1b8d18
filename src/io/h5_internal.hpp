// What the sources of the HDF5 face share. The only files that see hdf5.h are those that include this one.
#pragma once

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "io/h5.hpp"

namespace freestand::io::h5 {

static_assert(std::is_same_v<hid_t, Id>, "identifiers of HDF5 are 64-bit integers");

enum class Doing { reading, writing };

// Why the last call failed, by HDF5's error stack, as an Error: errors of the system (full disk, no right) as
// file_error() makes them; otherwise `what` with HDF5's own words.
Error failure(const std::string& file, const std::string& what, Doing doing);

inline Handle checked(Id id, Handle::Closer closer, const std::string& file, const std::string& what, Doing doing) {
  if (id < 0) throw failure(file, what, doing);
  return Handle(id, closer);
}

template <class T>
Id memory_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

// A whole number from 0 to `most`, or Error (Exit::data).
std::int64_t count_attribute(const Object& object, const std::string& name, std::int64_t most);

// Of the file in which an object lies.
hsize_t file_bytes(Id object);

// Variable-length UTF-8.
Handle text_type(const std::string& file);

// Names in files do not depend on the clock: no time stamps; links and attributes keep their order.
Handle group_properties(const std::string& file, bool for_file);

}  // namespace freestand::io::h5
