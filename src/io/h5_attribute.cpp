#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>

#include "io/h5_internal.hpp"

namespace freestand::io::h5 {
namespace {

// count < 0: a scalar.
void write_attribute(Id object, const std::string& file, const std::string& name, Id file_type, Id memory,
                     const void* data, std::int64_t count = -1) {
  const std::string what = "attribute " + name;
  const auto extent = static_cast<hsize_t>(count);
  const Handle space = checked(count < 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr), H5Sclose,
                               file, what, Doing::writing);
  const Handle attribute = checked(H5Acreate2(object, name.c_str(), file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                   H5Aclose, file, what, Doing::writing);
  if (count != 0 && H5Awrite(attribute.id(), memory, data) < 0) throw failure(file, what, Doing::writing);
}

struct OpenAttribute {
  Handle attribute, type, space;
  std::size_t count;
};

OpenAttribute open_attribute(Id object, const std::string& file, const std::string& name, H5T_class_t kind) {
  const std::string what = "no attribute " + name;
  OpenAttribute open;
  open.attribute = checked(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, file, what, Doing::reading);
  open.type = checked(H5Aget_type(open.attribute.id()), H5Tclose, file, what, Doing::reading);
  open.space = checked(H5Aget_space(open.attribute.id()), H5Sclose, file, what, Doing::reading);
  open.count = static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(open.space.id())));
  if (H5Tget_class(open.type.id()) != kind)
    throw failure(file, "attribute " + name + " is of another type than expected", Doing::reading);
  const hsize_t most = file_bytes(object);  // attributes are not packed: all of their values lie there
  if (open.count > most || H5Tget_size(open.type.id()) > most)
    throw failure(file, "attribute " + name + " is to be larger than the file", Doing::reading);
  return open;
}

template <class T>
std::vector<T> read_numbers(Id object, const std::string& file, const std::string& name, H5T_class_t kind) {
  const OpenAttribute open = open_attribute(object, file, name, kind);
  std::vector<T> values(open.count);
  if (!values.empty() && H5Aread(open.attribute.id(), memory_type<T>(), values.data()) < 0)
    throw failure(file, "attribute " + name, Doing::reading);
  return values;
}

template <class T>
T only(const std::vector<T>& values, const std::string& file, const std::string& name) {
  if (values.size() != 1) throw failure(file, "attribute " + name + " is not one number", Doing::reading);
  return values[0];
}

}  // namespace

void Object::attribute(const std::string& name, const std::string& value) {
  const Handle type = text_type(*file_);
  const char* text = value.c_str();
  write_attribute(id(), *file_, name, type.id(), type.id(), &text);
}
void Object::attribute(const std::string& name, double value) {
  write_attribute(id(), *file_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}
void Object::attribute(const std::string& name, std::int64_t value) {
  write_attribute(id(), *file_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}
void Object::attribute(const std::string& name, const std::vector<double>& values) {
  write_attribute(id(), *file_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(),
                  static_cast<std::int64_t>(values.size()));
}
void Object::attribute(const std::string& name, const std::vector<std::int64_t>& values) {
  write_attribute(id(), *file_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(),
                  static_cast<std::int64_t>(values.size()));
}
void Object::attribute(const std::string& name, const std::vector<std::string>& values) {
  const Handle type = text_type(*file_);
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  write_attribute(id(), *file_, name, type.id(), type.id(), texts.data(), static_cast<std::int64_t>(texts.size()));
}

bool Object::has_attribute(const std::string& name) const { return H5Aexists(id(), name.c_str()) > 0; }

std::string Object::text_attribute(const std::string& name) const {
  const OpenAttribute open = open_attribute(id(), *file_, name, H5T_STRING);
  if (open.count != 1) throw failure(*file_, "attribute " + name + " is not one text", Doing::reading);
  const Handle type = text_type(*file_);
  if (H5Tis_variable_str(open.type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(open.attribute.id(), type.id(), &text) < 0) throw failure(*file_, "attribute " + name, Doing::reading);
    std::string value = text ? text : "";
    H5Dvlen_reclaim(type.id(), open.space.id(), H5P_DEFAULT, &text);
    return value;
  }
  std::string value(H5Tget_size(open.type.id()), '\0');
  if (H5Aread(open.attribute.id(), open.type.id(), value.data()) < 0)
    throw failure(*file_, "attribute " + name, Doing::reading);
  return value.substr(0, value.find('\0'));
}

std::vector<std::string> Object::texts_attribute(const std::string& name) const {
  const OpenAttribute open = open_attribute(id(), *file_, name, H5T_STRING);
  const Handle type = text_type(*file_);
  std::vector<char*> texts(open.count, nullptr);
  if (texts.empty()) return {};
  if (H5Aread(open.attribute.id(), type.id(), texts.data()) < 0)
    throw failure(*file_, "attribute " + name, Doing::reading);
  std::vector<std::string> values;
  for (const char* text : texts) values.emplace_back(text ? text : "");
  H5Dvlen_reclaim(type.id(), open.space.id(), H5P_DEFAULT, texts.data());
  return values;
}

std::vector<std::int64_t> Object::integers_attribute(const std::string& name) const {
  return read_numbers<std::int64_t>(id(), *file_, name, H5T_INTEGER);
}
std::int64_t Object::integer_attribute(const std::string& name) const {
  return only(integers_attribute(name), *file_, name);
}
double Object::real_attribute(const std::string& name) const {
  return only(read_numbers<double>(id(), *file_, name, H5T_FLOAT), *file_, name);
}

std::int64_t count_attribute(const Object& object, const std::string& name, std::int64_t most) {
  const std::int64_t count = object.integer_attribute(name);
  if (count < 0 || count > most)
    throw failure(object.file_path(), fmt::format("attribute {} is {}, and 0 to {} belong there", name, count, most),
                  Doing::reading);
  return count;
}

}  // namespace freestand::io::h5
