// A file that is read and written at given places, by several processes at once.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <utility>

#include "base/file_calls.hpp"

namespace freestand {

class OpenFile {
 public:
  // flags: of open(2). Not open if that fails; errno then tells why, as after all below.
  OpenFile(const std::filesystem::path& path, int flags)
      : descriptor_(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, 0666); })) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  explicit operator bool() const { return descriptor_ >= 0; }
  std::int64_t size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? status.st_size : 0;
  }

  // Are all bytes read, or written? Offsets in bytes.
  bool read(std::span<std::byte> bytes, std::int64_t offset) const {
    return all_done(bytes, [&](auto part, std::size_t done) {
      return ::pread(descriptor_, part.data(), part.size(), offset + static_cast<std::int64_t>(done));
    });
  }
  bool write(std::span<const std::byte> bytes, std::int64_t offset) const {
    return all_done(bytes, [&](auto part, std::size_t done) {
      return ::pwrite(descriptor_, part.data(), part.size(), offset + static_cast<std::int64_t>(done));
    });
  }
  bool sync() const {
    return uninterrupted([&] { return ::fsync(descriptor_); }) == 0 || errno == EINVAL;  // which pipes and devices say
  }
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR; }

 private:
  int descriptor_;
};

}  // namespace freestand
