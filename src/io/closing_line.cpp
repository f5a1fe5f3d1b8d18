#include "io/closing_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <freestand/error.hpp>
#include <span>
#include <system_error>
#include <vector>

#include "base/durable_file.hpp"
#include "base/file_calls.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

using Checksum = uLong;

std::string line_with(Checksum sum) {
  return fmt::format("\nfreestand closed this file, crc32 of all before this line {:08x}\n", sum);
}

const std::size_t line_bytes = line_with(0).size();

Error cannot_read(const fs::path& path, int error_number) {
  return Error(fmt::format("cannot read {} ({}): check the path and its permissions", path.string(),
                           std::generic_category().message(error_number)),
               Exit::data);
}

// An open file, read from its beginning on, a mebibyte at a time.
class Bytes {
 public:
  Bytes(const fs::path& path, int flags)
      : descriptor_(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC); })) {}
  ~Bytes() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

  bool open() const { return descriptor_ >= 0; }

  // How many there are, -1 where that cannot be told.
  off_t size() const {
    struct stat status {};
    return uninterrupted([&] { return ::fstat(descriptor_, &status); }) == 0 ? status.st_size : -1;
  }

  bool read(std::span<char> into, off_t from) const {
    return all_done(into, [&](auto part, std::size_t done) {
      return ::pread(descriptor_, part.data(), part.size(), from + static_cast<off_t>(done));
    });
  }

  bool write(std::string_view text, off_t at) const {
    return all_done(std::span(text), [&](auto part, std::size_t done) {
      return ::pwrite(descriptor_, part.data(), part.size(), at + static_cast<off_t>(done));
    });
  }

  // Of the first so many; false where they cannot be read.
  bool checksum(off_t count, Checksum& sum) const {
    std::vector<char> part(static_cast<std::size_t>(std::min<off_t>(count, 1 << 20)));
    sum = ::crc32(0, nullptr, 0);
    for (off_t at = 0; at < count; at += static_cast<off_t>(part.size())) {
      part.resize(static_cast<std::size_t>(std::min<off_t>(count - at, static_cast<off_t>(part.size()))));
      if (!read(part, at)) return false;
      sum = ::crc32_z(sum, reinterpret_cast<const Bytef*>(part.data()), part.size());
    }
    return true;
  }

 private:
  int descriptor_;
};

}  // namespace

std::string closing_line(std::string_view bytes) {
  return line_with(::crc32_z(::crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void append_closing_line(const fs::path& aside, const fs::path& path) {
  const Bytes file(aside, O_RDWR);
  const off_t size = file.open() ? file.size() : -1;
  Checksum sum = 0;
  if (size < 0 || !file.checksum(size, sum) || !file.write(line_with(sum), size))
    throw file_error("write", path, errno);
}

void check_closing_line(const fs::path& path) {
  const Bytes file(path, O_RDONLY);
  const off_t size = file.open() ? file.size() : -1;
  if (size < 0) throw cannot_read(path, errno);
  const off_t before = std::max<off_t>(0, size - static_cast<off_t>(line_bytes));
  std::string line(static_cast<std::size_t>(size - before), '\0');
  if (!file.read(line, before)) throw cannot_read(path, errno);
  Checksum stated = 0, sum = 0;
  if (line.size() == line_bytes)
    std::from_chars(line.data() + line_bytes - 9, line.data() + line_bytes - 1, stated, 16);
  if (line != line_with(stated))
    throw Error(
        fmt::format("cannot read {} (it does not end with the line by which freestand closes its files: it was cut "
                    "short, changed, or made by an earlier version or another program): remove it, and make it again",
                    path.string()),
        Exit::data);
  if (!file.checksum(before, sum)) throw cannot_read(path, errno);
  if (sum != stated)
    throw Error(
        fmt::format("cannot read {} (it was damaged or changed: the checksum of its bytes is {:08x}, and its last "
                    "line says {:08x}): remove it, and make it again",
                    path.string(), sum, stated),
        Exit::data);
}

}  // namespace freestand::io
