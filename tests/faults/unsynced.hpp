// What a process has changed below a folder and not synced, and what is left of it where the machine dies. After POSIX a write is safe
// once its file is synced, a new name or a rename once its folder is. Each that is not is kept, undone or, a write, spoilt, as a number
// drawn from the seed says: the same calls and seed leave the same.
#pragma once

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

class Unsynced {
 public:
  // aside: where files that a rename replaces are kept, beside it on the same disk.
  explicit Unsynced(std::string aside) : aside_(std::move(aside)) {}

  void write(const std::string& path, std::int64_t offset, std::int64_t size) {
    const std::lock_guard lock(mutex_);
    changes_.push_back({What::write, path, "", offset, size});
  }

  void make(const std::string& path) {
    const std::lock_guard lock(mutex_);
    changes_.push_back({What::make, path, "", 0, 0});
  }

  // Before the rename is done.
  void rename(const std::string& from, const std::string& to) {
    const std::lock_guard lock(mutex_);
    const std::string replaced =
        aside_ + "." + std::to_string(::getpid()) + "." + std::to_string(changes_.size()) + ".replaced";
    const bool is_there =
        ::syscall(SYS_linkat, AT_FDCWD, to.c_str(), AT_FDCWD, replaced.c_str(), 0) == 0;  // a second name of it
    for (Change& change : changes_)
      if (change.path == from) change.path = to;
    changes_.push_back({What::rename, to, from, 0, 0, is_there ? replaced : ""});
  }

  // The writes of a file, or the names in a folder.
  void sync(const std::string& path) {
    const std::lock_guard lock(mutex_);
    std::erase_if(changes_, [&](const Change& change) {
      const bool safe = change.what == What::write ? change.path == path : folder_of(change.path) == path;
      if (safe && !change.replaced.empty()) remove(change.replaced);
      return safe;
    });
  }

  // The last first.
  void lose(std::uint64_t seed) {
    const std::lock_guard lock(mutex_);
    while (!changes_.empty()) {
      const Change change = changes_.back();
      changes_.pop_back();
      const std::uint64_t dice = next(seed) % 3;
      if (change.what == What::write && dice > 0) overwrite(change, dice == 2 ? next(seed) : 0);
      if (change.what == What::make && dice == 1) remove(change.path);
      if (change.what == What::rename && dice == 1) {
        move(change.path, change.from);
        for (Change& earlier : changes_)
          if (earlier.path == change.path) earlier.path = change.from;
        if (!change.replaced.empty()) move(change.replaced, change.path);
      } else if (!change.replaced.empty()) {
        remove(change.replaced);
      }
    }
  }

 private:
  enum class What { write, make, rename };
  struct Change {
    What what;
    std::string path, from;
    std::int64_t offset, size;
    std::string replaced = {};
  };

  static std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

  // splitmix64, by S. Vigna.
  static std::uint64_t next(std::uint64_t& state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  // By the kernel's own calls: those of the C library are counted.
  static void remove(const std::string& path) { ::syscall(SYS_unlinkat, AT_FDCWD, path.c_str(), 0); }
  static void move(const std::string& from, const std::string& to) {
    ::syscall(SYS_renameat2, AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0);
  }

  // Zeros (seed 0), as where a disk has not got them, or what is neither; cut off where the write was the last of its file.
  static void overwrite(const Change& change, std::uint64_t seed) {
    const long file = ::syscall(SYS_openat, AT_FDCWD, change.path.c_str(), O_RDWR, 0);
    if (file < 0) return;
    struct stat facts {};
    ::fstat(static_cast<int>(file), &facts);
    if (seed == 0 && facts.st_size == change.offset + change.size) {
      ::syscall(SYS_ftruncate, file, change.offset);
    } else {
      std::vector<unsigned char> bytes(static_cast<std::size_t>(change.size), 0);
      if (seed != 0)
        for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(next(seed));
      ::syscall(SYS_pwrite64, file, bytes.data(), bytes.size(), change.offset);
    }
    ::syscall(SYS_close, file);
  }

  const std::string aside_;
  std::mutex mutex_;
  std::vector<Change> changes_;
};
