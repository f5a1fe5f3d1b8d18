#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <freestand/error.hpp>
#include <system_error>

#include "base/durable_file.hpp"
#include "io/h5_internal.hpp"

namespace freestand::io::h5 {
namespace {

namespace fs = std::filesystem;

// Before anything else: no printing of error stacks, and no closing of files at the end of the program (files are
// closed by finish(); after an error on one rank a collective close would wait for ever).
void start_library() {
  static const bool started = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(started);
}

struct Reasons {
  std::string innermost;
  int error_number = 0;
};

herr_t collect(unsigned, const H5E_error2_t* error, void* into) {
  auto& reasons = *static_cast<Reasons*>(into);
  const std::string text = error->desc ? error->desc : "";
  if (reasons.innermost.empty()) reasons.innermost = text;
  constexpr std::string_view key = "errno = ";
  const auto at = text.find(key);
  if (at != std::string::npos && !reasons.error_number)
    std::from_chars(text.data() + at + key.size(), text.data() + text.size(), reasons.error_number);
  if (text.find("NO_SPACE") != std::string::npos && !reasons.error_number) reasons.error_number = ENOSPC;
  return 0;
}

enum class Access { reading, making, writing };

// A file that is written is closed with all that is open in it; one that is read lives as long as anything in it. A new one is
// made in memory, where nothing fails.
Handle file_access(Access how, const std::string& name) {
  Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, name, "file access settings", Doing::writing);
  H5Pset_fclose_degree(access.id(), how == Access::reading ? H5F_CLOSE_WEAK : H5F_CLOSE_STRONG);
  H5Pset_file_locking(access.id(), true, true);
  H5Pset_sieve_buf_size(access.id(), 0);  // data that waits for its dataset's end is lost where writing it fails there
  if (how == Access::making) H5Pset_fapl_core(access.id(), 1U << 20, false);
  return access;
}

}  // namespace

Error failure(const std::string& file, const std::string& what, Doing doing) {
  Reasons reasons;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &reasons);
  H5Eclear2(H5E_DEFAULT);
  const char* verb = doing == Doing::writing ? "write" : "read";
  if (reasons.error_number && doing == Doing::writing) return file_error(verb, file, reasons.error_number);
  if (reasons.error_number)
    return Error(fmt::format("cannot read {} ({}): check the path and its permissions", file,
                             std::generic_category().message(reasons.error_number)),
                 Exit::data);
  const char* advice = doing == Doing::writing
                           ? "check the disk and start again (a sweep keeps what it has finished)"
                           : "make the file again, or name one that freestand has written";
  return Error(fmt::format("cannot {} {} ({}{}{}): {}", verb, file, what, reasons.innermost.empty() ? "" : ": ",
                           reasons.innermost, advice),
               doing == Doing::writing ? Exit::cure : Exit::data);
}

hsize_t file_bytes(Id object) {
  const Handle file(H5Iget_file_id(object), H5Fclose);
  hsize_t bytes = 0;
  H5Fget_filesize(file.id(), &bytes);
  return bytes;
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this == &other) return *this;
  close();
  id_ = std::exchange(other.id_, -1);
  closer_ = other.closer_;
  return *this;
}

void Handle::close() {
  if (id_ >= 0 && closer_) closer_(id_);
  id_ = -1;
}

Handle group_properties(const std::string& file, bool for_file) {
  Handle properties = checked(H5Pcreate(for_file ? H5P_FILE_CREATE : H5P_GROUP_CREATE), H5Pclose, file,
                              "settings of a group", Doing::writing);
  H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_attr_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties.id(), false);
  return properties;
}

namespace {

// Closes a file of which all that matters is written. What HDF5 still holds for it may not fit on a full disk, and HDF5
// (1.10) does not survive a close that fails, not even until the end of MPI: the rest goes into memory instead.
void close_without_writing(Handle& file) {
  void* descriptor = nullptr;
  if (file.id() >= 0 && H5Fget_vfd_handle(file.id(), H5P_DEFAULT, &descriptor) >= 0 && descriptor) {
    const int memory = ::memfd_create("freestand", MFD_CLOEXEC);
    if (memory >= 0) {
      ::dup2(memory, *static_cast<int*>(descriptor));
      ::close(memory);
    }
  }
  file.close();
}

}  // namespace

struct File::State {
  Handle file;
  fs::path aside, path;  // aside is empty but for a file that create_at() has made
  std::shared_ptr<const std::string> name;

  ~State() {
    if (aside.empty()) return;
    close_without_writing(file);
    ::unlink(aside.c_str());
  }
};

File::File(std::unique_ptr<State> state) : state_(std::move(state)) {}
File::File(File&&) noexcept = default;
File::~File() = default;

File File::create(const fs::path& path) {
  start_library();
  auto state = std::make_unique<State>();
  state->path = path;
  state->name = std::make_shared<const std::string>(path.string());
  const Handle access = file_access(Access::making, *state->name);
  const Handle creation = group_properties(*state->name, true);
  state->file = checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose, *state->name,
                        "the file cannot be made", Doing::writing);
  return File(std::move(state));
}

File File::create_at(const fs::path& aside, const fs::path& path) {
  start_library();
  auto state = std::make_unique<State>();
  state->path = path;
  state->name = std::make_shared<const std::string>(path.string());
  const Handle access = file_access(Access::writing, *state->name);
  const Handle creation = group_properties(*state->name, true);
  state->file = checked(H5Fcreate(aside.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose, *state->name,
                        "the file cannot be made", Doing::writing);
  state->aside = aside;
  return File(std::move(state));
}

File File::open(const fs::path& path, Closing closing) {
  if (closing == Closing::check) check_closing_line(path);
  start_library();
  auto state = std::make_unique<State>();
  state->path = path;
  state->name = std::make_shared<const std::string>(path.string());
  const Handle access = file_access(Access::reading, *state->name);
  state->file = checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, *state->name,
                        "no HDF5 file, or cut short", Doing::reading);
  return File(std::move(state));
}

Group File::root() const {
  Handle group =
      checked(H5Gopen2(state_->file.id(), "/", H5P_DEFAULT), H5Gclose, *state_->name, "no root group", Doing::reading);
  return Group(std::move(group), state_->name);
}

void File::close() {
  if (H5Fflush(state_->file.id(), H5F_SCOPE_GLOBAL) < 0)
    throw failure(*state_->name, "not all is written", Doing::writing);
  close_without_writing(state_->file);
  append_closing_line(state_->aside, state_->path);
  state_->aside.clear();
}

void File::finish() {
  const Id id = state_->file.id();
  const std::string& name = *state_->name;
  if (H5Fflush(id, H5F_SCOPE_GLOBAL) < 0) throw failure(name, "not all is written", Doing::writing);
  const ssize_t size = H5Fget_file_image(id, nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(id, bytes.data(), bytes.size()) != size)
    throw failure(name, "it cannot be copied out of memory", Doing::writing);
  write_durably(state_->path, bytes + closing_line(bytes));
}

}  // namespace freestand::io::h5
