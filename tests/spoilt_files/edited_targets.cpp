// Result files that are sound HDF5 and closed, with other content than any that freestand writes: what no checksum keeps from a reader. The
// input is a list of edits of a good file; HDF5 makes them in memory.
#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstring>
#include <limits>

#include "base/durable_file.hpp"
#include "database/made_database.hpp"
#include "io/closing_line.hpp"
#include "io/database_file.hpp"
#include "io/fragility_file.hpp"
#include "io/h5.hpp"
#include "io/made_fragility.hpp"
#include "io/samples_file.hpp"
#include "io/tally_file.hpp"
#include "spoilt_files/target.hpp"
#include "support/sample_blocks.hpp"

namespace freestand::spoilt_files {
namespace {

using io::h5::Handle;

constexpr ssize_t most_image = 1 << 20;
constexpr std::size_t most_bytes = 1 << 16;  // that an edit writes; what is to hold more is left without values
constexpr double most_attribute =
    60'000;  // bytes: HDF5 refuses what is larger, and crashes where it then deletes another

// What is left of the input; behind its end zeros.
class Input {
 public:
  explicit Input(std::string_view bytes) : bytes_(bytes) {}
  bool over() const { return bytes_.empty(); }
  std::string take(std::size_t count) {
    std::string taken(bytes_.substr(0, count));
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  template <class T>
  T value() {
    T value{};
    const std::string bytes = take(sizeof value);
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }
  std::size_t below(std::size_t end) { return value<std::uint8_t>() % end; }
  std::string text() { return take(below(40)); }
  double number() {
    constexpr double some[] = {0,
                               -1,
                               1,
                               3,
                               1e300,
                               -1e300,
                               0x1p31,
                               0x1p62,
                               std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()};
    const std::size_t which = below(std::size(some) + 2);
    return which < std::size(some) ? some[which] : value<double>();
  }

 private:
  std::string_view bytes_;
};

struct Place {
  std::string object, attribute;  // without an attribute: the object itself
};

struct Good {
  std::string bytes;
  std::vector<Place> places;
};

herr_t collect_attribute(hid_t object, const char* attribute, const H5A_info_t*, void* into) {
  char name[1000] = {};
  H5Iget_name(object, name, sizeof name);
  static_cast<Good*>(into)->places.push_back({name, attribute});
  return 0;
}

herr_t collect(hid_t root, const char* name, const H5O_info_t*, void* into) {
  static_cast<Good*>(into)->places.push_back({std::string("/") + name, {}});
  const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  return H5Aiterate2(object.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect_attribute, into);
}

Handle opened(std::string& bytes) {
  return {H5LTopen_file_image(bytes.data(), bytes.size(), H5LT_FILE_IMAGE_OPEN_RW), H5Fclose};
}

template <class Write>
Good good(const Write& write) {
  const std::filesystem::path path = written("", "good.h5");
  write(path);
  Good made{read_whole(path), {}};
  made.bytes.resize(made.bytes.size() - io::closing_line("").size());
  const Handle file = opened(made.bytes);
  H5Ovisit(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, collect, &made);
  return made;
}

Handle some_type(Input& input) {
  const auto text = [&](std::size_t size) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), size);
    H5Tset_cset(type.id(), input.below(2) ? H5T_CSET_ASCII : H5T_CSET_UTF8);
    return type;
  };
  const hid_t plain[] = {H5T_IEEE_F64LE, H5T_STD_I64LE,  H5T_STD_I32LE, H5T_STD_U8LE,
                         H5T_STD_U64LE,  H5T_IEEE_F32BE, H5T_STD_B16LE, H5T_STD_REF_OBJ};
  const hsize_t three = 3;
  const std::size_t which = input.below(std::size(plain) + 6);
  switch (which) {
    case 0:
      return text(H5T_VARIABLE);
    case 1:
      return text(1 + input.below(200));
    case 2:
      return {H5Tarray_create2(H5T_IEEE_F64LE, 1, &three), H5Tclose};
    case 3:
      return {H5Tcreate(H5T_OPAQUE, 8), H5Tclose};
    case 4:
      return {H5Tenum_create(H5T_STD_I32LE), H5Tclose};
    case 5: {
      Handle pair(H5Tcreate(H5T_COMPOUND, 8), H5Tclose);
      H5Tinsert(pair.id(), "value", 0, H5T_IEEE_F64LE);
      return pair;
    }
    default:
      return {H5Tcopy(plain[which - 6]), H5Tclose};
  }
}

hsize_t some_extent(Input& input) {
  constexpr hsize_t large[] = {1000, hsize_t{1} << 20, hsize_t{1} << 32, hsize_t{1} << 40, hsize_t{1} << 62};
  const std::size_t which = input.below(24 + std::size(large) + 1);
  if (which < 24) return which;
  return which - 24 < std::size(large) ? large[which - 24] : input.value<hsize_t>();
}

struct Shape {
  std::vector<hsize_t> extent, most, piece;
  Handle space;
};

Shape some_shape(Input& input) {
  Shape shape;
  const std::size_t rank = input.below(5);
  if (rank == 4) {
    shape.space = {H5Screate(H5S_NULL), H5Sclose};
    return shape;
  }
  for (std::size_t i = 0; i < rank; ++i) {
    shape.extent.push_back(some_extent(input));
    shape.most.push_back(input.below(4) ? shape.extent.back() : H5S_UNLIMITED);
    shape.piece.push_back(input.below(2) ? std::max<hsize_t>(1, shape.extent.back())
                                         : std::max<hsize_t>(1, some_extent(input)));
  }
  shape.space = {H5Screate_simple(static_cast<int>(rank), shape.extent.data(), shape.most.data()), H5Sclose};
  return shape;
}

// Hands so many values of the type to `write`, or, where they would be too many, none.
template <class WriteValues>
void fill(Input& input, hid_t type, hssize_t count, const WriteValues& write) {
  const std::size_t size = H5Tget_size(type);
  if (count <= 0 || size == 0 || static_cast<std::size_t>(count) > most_bytes / size) return;
  const auto values = static_cast<std::size_t>(count);
  const std::string text = input.text();
  if (H5Tis_variable_str(type) > 0) {
    const std::vector<const char*> texts(values, text.c_str());
    write(texts.data());
    return;
  }
  std::string bytes(values * size, '\0');
  const double number = input.number();
  const auto whole = input.value<std::int64_t>();
  const bool real = H5Tget_class(type) == H5T_FLOAT;
  std::string one(size, '\0');
  if (!text.empty())
    for (std::size_t i = 0; i < size; ++i) one[i] = text[i % text.size()];
  else
    std::memcpy(one.data(), real ? static_cast<const void*>(&number) : &whole, std::min<std::size_t>(size, 8));
  for (std::size_t i = 0; i < values; ++i) bytes.replace(i * size, size, one);
  write(bytes.data());
}

void write_attribute(hid_t object, const char* name, Input& input) {
  const Handle type = some_type(input);
  const Shape shape = some_shape(input);
  if (static_cast<double>(H5Sget_simple_extent_npoints(shape.space.id())) *
          static_cast<double>(H5Tget_size(type.id())) >
      most_attribute)
    return;
  H5Adelete(object, name);
  const Handle made(H5Acreate2(object, name, type.id(), shape.space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (made.id() >= 0)
    fill(input, type.id(), H5Sget_simple_extent_npoints(shape.space.id()),
         [&](const void* values) { H5Awrite(made.id(), type.id(), values); });
}

// One value of those that are there, or all of them.
void write_in_place(hid_t file, const std::string& name, Input& input) {
  const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset.id() < 0) return;
  const Handle type(H5Dget_type(dataset.id()), H5Tclose), space(H5Dget_space(dataset.id()), H5Sclose);
  std::vector<hsize_t> at(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  H5Sget_simple_extent_dims(space.id(), at.data(), nullptr);
  for (hsize_t& extent : at) extent = extent ? input.below(255) % extent : 0;
  if (!at.empty() && input.below(2)) H5Sselect_elements(space.id(), H5S_SELECT_SET, 1, at.data());
  const hssize_t count = H5Sget_select_npoints(space.id());
  const auto length = static_cast<hsize_t>(std::max<hssize_t>(0, count));
  const Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose);
  fill(input, type.id(), count,
       [&](const void* values) { H5Dwrite(dataset.id(), type.id(), memory.id(), space.id(), H5P_DEFAULT, values); });
}

// Another dataset of that name, with the attributes that readers ask for.
void write_anew(hid_t file, const std::string& name, Input& input) {
  const Handle type = some_type(input);
  const Shape shape = some_shape(input);
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const std::size_t layout = input.below(5);
  if (layout == 0) H5Pset_layout(how.id(), H5D_COMPACT);
  if (layout == 1) H5Pset_external(how.id(), "/dev/zero", 0, H5F_UNLIMITED);
  if (layout > 2 && !shape.piece.empty()) {
    H5Pset_chunk(how.id(), static_cast<int>(shape.piece.size()), shape.piece.data());
    if (layout == 4) H5Pset_deflate(how.id(), 1);
  }
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const Handle made(H5Dcreate2(file, name.c_str(), type.id(), shape.space.id(), H5P_DEFAULT, how.id(), H5P_DEFAULT),
                    H5Dclose);
  if (made.id() < 0) return;
  for (const char* attribute : {"unit", "fingerprint"}) H5LTset_attribute_string(file, name.c_str(), attribute, "1");
  fill(input, type.id(), H5Sget_simple_extent_npoints(shape.space.id()),
       [&](const void* values) { H5Dwrite(made.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values); });
}

void edit(hid_t file, const std::vector<Place>& places, Input& input) {
  const auto any = [&]() -> const Place& { return places[input.value<std::uint16_t>() % places.size()]; };
  const auto& [object, attribute] = any();
  const char* name = object.c_str();
  if (!attribute.empty()) {
    const Handle owner(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
    if (input.below(4) == 0)
      H5Adelete(owner.id(), attribute.c_str());
    else
      write_attribute(owner.id(), attribute.c_str(), input);
    return;
  }
  const std::size_t what = input.below(12);
  if (what < 4) return write_in_place(file, object, input);
  if (what < 7) return write_anew(file, object, input);
  if (what == 7) {
    const std::string other = object.substr(0, object.rfind('/') + 1) + "x" + input.text();
    H5Lcreate_hard(file, name, file, other.c_str(), H5P_DEFAULT, H5P_DEFAULT);  // HDF5 crashes where it is to copy some
    return;
  }
  H5Ldelete(file, name, H5P_DEFAULT);
  if (what == 8) Handle(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (what == 9) H5Lcreate_soft(any().object.c_str(), file, name, H5P_DEFAULT, H5P_DEFAULT);
  if (what == 10) H5Lcreate_hard(file, any().object.c_str(), file, name, H5P_DEFAULT, H5P_DEFAULT);
  if (what == 11) H5Lcreate_external("/dev/zero", "/", file, name, H5P_DEFAULT, H5P_DEFAULT);
}

// A good file after the edits, as `reader` takes it.
void read_edited(const char* reader, const Good& good, std::string_view bytes) {
  constexpr int most_edits = 8;
  std::string content = good.bytes;
  {
    const Handle file = opened(content);
    Input input(bytes);
    for (int i = 0; i < most_edits && !input.over(); ++i) edit(file.id(), good.places, input);
    H5Fflush(file.id(), H5F_SCOPE_GLOBAL);
    const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
    if (size > most_image) return;  // of a large piece, say: it would take its time, and no other way
    std::string image(static_cast<std::size_t>(std::max<ssize_t>(0, size)), '\0');
    H5Fget_file_image(file.id(), image.data(), image.size());
    H5Eclear2(H5E_DEFAULT);
    content = std::move(image);
  }
  target(reader).take(content + io::closing_line(content));
}

void edited_fragility(std::string_view bytes) {
  static const Good file = good([](const std::filesystem::path& path) {
    fragility::Result result = test::example();
    result.covariance = {{"delta", "slid"}, std::vector<double>(12, 0.5), std::vector<std::int64_t>(12, 9)};
    io::write_fragility(path, test::small_header().provenance, result);
  });
  read_edited("fragility_file", file, bytes);
}

void edited_tally(std::string_view bytes) {
  static const Good file = good([](const std::filesystem::path& path) {
    io::write_tally(path, {test::small_header().provenance, "0123abcd", {0, -1, 7}});
  });
  read_edited("tally_file", file, bytes);
}

void edited_database(std::string_view bytes) {
  static const Good file =
      good([](const std::filesystem::path& path) { io::write_database(path, database::test::made_database()); });
  read_edited("database_file", file, bytes);
}

void edited_samples(std::string_view bytes) {
  static const Good file = good([](const std::filesystem::path& path) {
    io::SamplesHeader header = test::small_header();
    header.provenance.samples = 10;
    io::write_samples({}, path, header, {10, 4}, test::small_blocks({10, 4}));
  });
  read_edited("samples_file", file, bytes);
}

}  // namespace

std::vector<Target> edited_targets() {
  return {
      {"edited_fragility", edited_fragility},
      {"edited_tally", edited_tally},
      {"edited_database", edited_database},
      {"edited_samples", edited_samples},
  };
}

}  // namespace freestand::spoilt_files
