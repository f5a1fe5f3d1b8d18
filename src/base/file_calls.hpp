// Calls of the operating system on files, made as often as it takes: a signal interrupts them, on a network file system even
// those that otherwise never wait, and a write may do a part of what it was given.
#pragma once

#include <sys/types.h>

#include <cerrno>
#include <cstddef>
#include <span>

namespace freestand {

// What the call returns, below 0 an error as errno tells.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

// call(part, done) reads or writes what is left, behind `done` bytes, and returns how much it did. Were all done?
template <class Byte, class Call>
bool all_done(std::span<Byte> bytes, const Call& call) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = uninterrupted([&] { return call(bytes.subspan(done), done); });
    if (count == 0) errno = EIO;  // nothing is left to read, or nothing more can be written
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace freestand
