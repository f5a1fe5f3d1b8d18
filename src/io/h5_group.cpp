#include <fmt/format.h>

#include <array>
#include <freestand/error.hpp>
#include <numeric>

#include "io/h5_internal.hpp"
#include "io/packed.hpp"

namespace freestand::io::h5 {
namespace {

Id file_type(Type type) {
  switch (type) {
    case Type::real:
      return H5T_IEEE_F64LE;
    case Type::integer:
      return H5T_STD_I32LE;
    case Type::flag:
      return H5T_STD_U8LE;
    case Type::integer64:
      return H5T_STD_I64LE;
  }
  return -1;
}

template <class T>
constexpr Type type_for() {
  if constexpr (std::is_same_v<T, double>) return Type::real;
  if constexpr (std::is_same_v<T, std::int64_t>) return Type::integer64;
  if constexpr (std::is_same_v<T, std::int32_t>) return Type::integer;
  if constexpr (std::is_same_v<T, std::uint8_t>) return Type::flag;
}

Handle dataset_properties(const std::string& file) {
  Handle properties = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file, "settings of a dataset", Doing::writing);
  H5Pset_attr_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties.id(), false);
  return properties;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* into) {
  static_cast<std::vector<std::string>*>(into)->emplace_back(name);
  return 0;
}

// A link to another file may lead to a device that never ends, and one within this file is none that freestand writes.
void expect_no_link(Id group, const std::string& name, const std::string& file) {
  H5L_info_t info;
  if (H5Lget_info(group, name.c_str(), &info, H5P_DEFAULT) >= 0 && info.type != H5L_TYPE_HARD)
    throw failure(file, name + " is a link to elsewhere", Doing::reading);
}

// Nor do its values lie in another file.
void expect_own_values(Id dataset, const std::string& name, const std::string& file) {
  const Handle how = checked(H5Dget_create_plist(dataset), H5Pclose, file, "layout of " + name, Doing::reading);
  if (H5Pget_external_count(how.id()) != 0 || H5Pget_layout(how.id()) == H5D_VIRTUAL)
    throw failure(file, "the values of " + name + " lie elsewhere", Doing::reading);
}

}  // namespace

Handle text_type(const std::string& file) {
  Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, file, "type of a text", Doing::writing);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Group Group::make_group(const std::string& name) {
  const Handle properties = group_properties(*file_, false);
  Handle group = checked(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT), H5Gclose, *file_,
                         "group " + name + " cannot be made", Doing::writing);
  return Group(std::move(group), file_);
}

Group Group::open_group(const std::string& name) const {
  expect_no_link(id(), name, *file_);
  Handle group =
      checked(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose, *file_, "no group " + name, Doing::reading);
  return Group(std::move(group), file_);
}

bool Group::has(const std::string& name) const { return H5Lexists(id(), name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> Group::names() const {
  std::vector<std::string> names;
  hsize_t at = 0;
  if (H5Literate(id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, &at, collect_name, &names) >= 0) return names;
  names.clear();
  at = 0;
  if (H5Literate(id(), H5_INDEX_NAME, H5_ITER_INC, &at, collect_name, &names) < 0)
    throw failure(*file_, "a group cannot be listed", Doing::reading);
  return names;
}

Dataset Group::make_dataset(const std::string& name, Type type, const Dimensions& dimensions, std::uint64_t piece) {
  const std::string what = "dataset " + name + " cannot be made";
  const std::vector<hsize_t> extent(dimensions.begin(), dimensions.end());
  const Handle space = checked(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose,
                               *file_, what, Doing::writing);
  const Handle properties = dataset_properties(*file_);
  if (piece > 0) {
    const hsize_t rows = piece;
    H5Pset_chunk(properties.id(), 1, &rows);
    H5Pset_shuffle(properties.id());
    H5Pset_deflate(properties.id(), packing_level);
  }
  Handle dataset =
      checked(H5Dcreate2(id(), name.c_str(), file_type(type), space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
              H5Dclose, *file_, what, Doing::writing);
  return Dataset(std::move(dataset), file_);
}

Dataset Group::make_in_pieces(const std::string& name, Type type, std::uint64_t rows, std::uint64_t piece) {
  return make_dataset(name, type, {rows}, rows > 0 ? piece : 0);
}

// The name is that by which readers of netCDF-4 know such a dimension (dim_without_variable of its library).
Dataset Group::make_dimension(const std::string& name, std::uint64_t length) {
  Dataset dimension = make_dataset(name, Type::flag, {length}, 0);
  dimension.scale(fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", length));
  return dimension;
}

Dataset Group::open_dataset(const std::string& name) const {
  expect_no_link(id(), name, *file_);
  Handle dataset =
      checked(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose, *file_, "no dataset " + name, Doing::reading);
  expect_own_values(dataset.id(), name, *file_);
  return Dataset(std::move(dataset), file_);
}

template <class T>
Dataset Group::put_values(const std::string& name, const std::vector<T>& values, Dimensions dimensions) {
  if (dimensions.empty()) dimensions = {values.size()};
  Dataset dataset = make_dataset(name, type_for<T>(), dimensions, 0);
  dataset.write(values);
  return dataset;
}

Dataset Group::put(const std::string& name, const std::vector<double>& values, Dimensions dimensions) {
  return put_values(name, values, std::move(dimensions));
}
Dataset Group::put(const std::string& name, const std::vector<std::int64_t>& values, Dimensions dimensions) {
  return put_values(name, values, std::move(dimensions));
}
Dataset Group::put(const std::string& name, const std::vector<std::int32_t>& values, Dimensions dimensions) {
  return put_values(name, values, std::move(dimensions));
}
Dataset Group::put(const std::string& name, const std::vector<std::uint8_t>& values, Dimensions dimensions) {
  return put_values(name, values, std::move(dimensions));
}

Dataset Group::put(const std::string& name, const std::vector<std::string>& values) {
  const std::string what = "dataset " + name + " cannot be made";
  const hsize_t extent = values.size();
  const Handle type = text_type(*file_);
  const Handle space = checked(H5Screate_simple(1, &extent, nullptr), H5Sclose, *file_, what, Doing::writing);
  const Handle properties = dataset_properties(*file_);
  Handle dataset =
      checked(H5Dcreate2(id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
              H5Dclose, *file_, what, Doing::writing);
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  if (!texts.empty() && H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) < 0)
    throw failure(*file_, "dataset " + name, Doing::writing);
  return Dataset(std::move(dataset), file_);
}

}  // namespace freestand::io::h5
