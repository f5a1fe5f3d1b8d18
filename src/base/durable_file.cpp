#include "base/durable_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/file_calls.hpp"

namespace freestand {
namespace {

namespace fs = std::filesystem;

struct Advice {
  const char* what;
  Exit exit;
};

Advice advice(int error_number) {
  switch (error_number) {
    case ENOSPC:
      return {"free some space and start again (a sweep keeps what it has finished)", Exit::cure};
    case EDQUOT:
      return {"free some of your quota and start again (a sweep keeps what it has finished)", Exit::cure};
    case EFBIG:
      return {"raise the file size limit (ulimit -f) and start again (a sweep keeps what it has finished)",
              Exit::cure};
    case EIO:
      return {"check the disk or the network file system and start again (a sweep keeps what it has finished)",
              Exit::cure};
    case EROFS:
      return {"have it mounted for writing and start again, or choose another folder", Exit::cure};
    case EACCES:
    case EPERM:
      return {"choose a folder that you may write to, or change its permissions", Exit::usage};
    case EINTR:
    case ESTALE:  // and others of a file server that was away
    case ETIMEDOUT:
    case ENOTCONN:
    case ESHUTDOWN:
      return {"start again (a sweep keeps what it has finished)", Exit::resumable};
    case ENOENT:
    case ENOTDIR:
      return {"check the path", Exit::usage};
    default:
      return {"check the path and the disk and start again (a sweep keeps what it has finished)", Exit::cure};
  }
}

int sync_descriptor(int descriptor) {
  return uninterrupted([&] { return ::fsync(descriptor); });
}

// An open file that goes away unless it is kept.
class AsideFile {
 public:
  explicit AsideFile(const fs::path& path, const fs::path& final_path) : path_(path), final_path_(final_path) {
    descriptor_ = uninterrupted([&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666); });
    if (descriptor_ < 0) throw file_error("write", final_path, errno);
  }
  ~AsideFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  AsideFile(const AsideFile&) = delete;
  AsideFile& operator=(const AsideFile&) = delete;

  void write(std::span<const std::byte> bytes) {
    if (!all_done(bytes, [&](auto part, std::size_t) { return ::write(descriptor_, part.data(), part.size()); }))
      throw file_error("write", final_path_, errno);
  }

  void sync() const {
    if (sync_descriptor(descriptor_) != 0 && errno != EINVAL) throw file_error("write", final_path_, errno);
  }

  void close() {
    const int result = ::close(descriptor_);
    descriptor_ = -1;
    if (result != 0) throw file_error("write", final_path_, errno);
  }

  void keep() { path_.clear(); }

 private:
  fs::path path_, final_path_;
  int descriptor_ = -1;
};

void sync_path(const fs::path& path, int flags) {
  const int descriptor = uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC); });
  if (descriptor < 0) throw file_error("open", path, errno);
  const int result = sync_descriptor(descriptor);
  const int error_number = errno;
  ::close(descriptor);
  if (result != 0 && error_number != EINVAL) throw file_error("write", path, error_number);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// By which a file system knows a file, whatever its name; 0 where there is none.
std::int64_t file_number(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? static_cast<std::int64_t>(status.st_ino) : 0;
}

// A network file system that has sent a rename twice says that there is nothing to rename, and has done it.
void rename_and_sync(const fs::path& aside, const fs::path& path) {
  const std::int64_t number = file_number(aside);
  if (::rename(aside.c_str(), path.c_str()) != 0 && (errno != ENOENT || number == 0 || file_number(path) != number))
    throw file_error("write", path, errno);
  sync_path(folder_of(path), O_RDONLY | O_DIRECTORY);
}

std::string host_name() {
  char text[256] = {};
  if (::gethostname(text, sizeof text - 1) != 0) return "host";
  return text;
}

constexpr const char* aside_ending = ".part";

}  // namespace

Error file_error(const std::string& action, const fs::path& path, int error_number) {
  const Advice what = advice(error_number);
  return Error("cannot " + action + " " + path.string() + " (" + std::generic_category().message(error_number) +
                   "): " + what.what,
               what.exit);
}

fs::path aside_name(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.parent_path() / ("." + name + "." + host_name() + "." + std::to_string(::getpid()) + aside_ending);
}

bool is_aside_name(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with(".") && name.ends_with(aside_ending);
}

void write_durably(const fs::path& path, std::span<const std::span<const std::byte>> pieces) {
  const fs::path aside = aside_name(path);
  AsideFile file(aside, path);
  for (const auto& piece : pieces) file.write(piece);
  file.sync();
  file.close();
  rename_and_sync(aside, path);
  file.keep();
}

void write_durably(const fs::path& path, std::string_view text) {
  const std::span<const std::byte> piece = std::as_bytes(std::span(text.data(), text.size()));
  write_durably(path, std::span(&piece, 1));
}

void publish_durably(const fs::path& aside, const fs::path& path) {
  sync_path(aside, O_RDWR);
  rename_and_sync(aside, path);
}

std::string read_whole(const fs::path& path) {
  const auto reject = [&](int error_number, const char* advice) {
    throw Error("cannot read " + path.string() + " (" + std::generic_category().message(error_number) + "): " + advice,
                Exit::data);
  };
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) reject(errno, "check the path and its permissions");
  std::string text;
  std::array<char, 65536> part;
  for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), file)) > 0;) text.append(part.data(), count);
  const int error_number = std::ferror(file) ? errno : 0;
  std::fclose(file);
  if (error_number) reject(error_number, "check the path and the disk");
  return text;
}

}  // namespace freestand
