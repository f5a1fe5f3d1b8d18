// A library that is loaded before the C library (LD_PRELOAD): of the calls by which a process changes files below a folder,
// one fails, or the process dies there. What it is to do stands in the environment:
//   FAULT_FOLDER   only files below it count
//   FAULT_NAME     only calls of this name count: write, rename, ...; all where it is not there
//   FAULT_CALL     which of the calls, from 1
//   FAULT_KIND     enospc, edquot, erofs, eio, estale, etimedout, eintr: the call fails with that error (a close is done all the same); short: a write does half; renamed: a rename is done
//                  and tells ENOENT, as one that a network file system has sent twice; killed: the process dies
//                  before the call; torn: it dies when half of a write is done; lost: it dies before the call, and with it the
//                  machine: of what was not synced each write, new name and rename is kept, gone or spoilt (unsynced.hpp), and the
//                  other ranks die before their next call, with what they have not synced;
//                  listed: none fails, and the name of each is a line of FAULT_TOLD
//   FAULT_SEED     of what becomes of that
//   FAULT_LASTING  1: every call from then on, not that one alone
//   FAULT_RANK     only the process of this rank under mpirun
//   FAULT_TOLD     a file that is made when the call is reached
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

#include "unsynced.hpp"

namespace {

enum class Kind {
  none,
  enospc,
  edquot,
  erofs,
  eio,
  estale,
  etimedout,
  eintr,
  short_write,
  renamed,
  killed,
  torn,
  lost,
  listed
};

const char* setting(const char* name) {
  const char* text = std::getenv(name);
  return text ? text : "";
}

// Does it strike this process, not only the machine under it?
bool is_rank() {
  const char* rank = std::getenv("FAULT_RANK");
  return !rank || std::strcmp(rank, setting("OMPI_COMM_WORLD_RANK")) == 0;
}

Kind kind_in_environment() {
  if (!is_rank() && std::strcmp(setting("FAULT_KIND"), "lost") != 0) return Kind::none;
  constexpr const char* names[] = {"none",  "enospc", "edquot",  "erofs",  "eio",  "estale", "etimedout",
                                   "eintr", "short",  "renamed", "killed", "torn", "lost",   "listed"};
  for (std::size_t i = 1; i < std::size(names); ++i)
    if (std::strcmp(setting("FAULT_KIND"), names[i]) == 0) return static_cast<Kind>(i);
  return Kind::none;
}

bool is_below(const char* path) {
  const char* folder = setting("FAULT_FOLDER");
  return path && *folder && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

std::string path_of(int descriptor) {
  char name[64], path[PATH_MAX] = {};
  std::snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
  return ::readlink(name, path, sizeof path - 1) > 0 ? path : "";
}
bool is_below(int descriptor) { return is_below(path_of(descriptor).c_str()); }
std::string path_in(int folder, const char* name) {
  return folder == AT_FDCWD || *name == '/' ? name : path_of(folder) + '/' + name;
}

Unsynced& unsynced() {
  static Unsynced all(setting("FAULT_TOLD"));
  return all;
}

// Is what is not synced kept in mind?
template <class Where>
bool minded(Where where) {
  static const bool lost = kind_in_environment() == Kind::lost;
  return lost && is_below(where);
}

void list(const char* name) {
  const std::string line = std::string(name) + '\n';
  const long told = ::syscall(SYS_openat, AT_FDCWD, setting("FAULT_TOLD"), O_CREAT | O_WRONLY | O_APPEND, 0666);
  ::syscall(SYS_write, told, line.data(), line.size());
  ::syscall(SYS_close, told);
}

// Is this call, which changes a file of the folder, to fail?
bool fails(const char* name) {
  static const bool strikes = is_rank();
  if (!strikes) return ::access(setting("FAULT_TOLD"), F_OK) == 0;  // the machine has died
  static std::atomic<long> calls{0};
  static const char* const only = setting("FAULT_NAME");
  if (*only && std::strcmp(only, name) != 0) return false;
  static const long wanted = std::atol(setting("FAULT_CALL"));
  static const bool lasting = *setting("FAULT_LASTING") == '1';
  const long call = ++calls;
  if (call == wanted)
    ::syscall(SYS_close, ::syscall(SYS_openat, AT_FDCWD, setting("FAULT_TOLD"), O_CREAT | O_WRONLY, 0666));
  return call == wanted || (lasting && call > wanted);
}

// What the call of that name is to do, if it changes a file of the folder.
template <class Where>
Kind fault(const char* name, Where where) {
  static const Kind kind = kind_in_environment();
  if (kind == Kind::none || !is_below(where)) return Kind::none;
  if (kind == Kind::listed) list(name);
  if (kind == Kind::listed || !fails(name)) return Kind::none;
  if (kind == Kind::lost)
    unsynced().lose(std::strtoul(setting("FAULT_SEED"), nullptr, 10) +
                    1000 * std::strtoul(setting("OMPI_COMM_WORLD_RANK"), nullptr, 10));
  if (kind == Kind::killed || kind == Kind::lost) ::kill(::getpid(), SIGKILL);
  return kind;
}

// Does the call fail by its error alone? Interrupted are only calls that may be.
bool fails_at_once(Kind kind, bool may_be_interrupted) {
  const auto with = [](int error) {
    errno = error;
    return true;
  };
  switch (kind) {
    case Kind::enospc:
      return with(ENOSPC);
    case Kind::edquot:
      return with(EDQUOT);
    case Kind::erofs:
      return with(EROFS);
    case Kind::eio:
      return with(EIO);
    case Kind::estale:
      return with(ESTALE);
    case Kind::etimedout:
      return with(ETIMEDOUT);
    case Kind::eintr:
      return may_be_interrupted && with(EINTR);
    default:
      return false;
  }
}

template <class Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(::dlsym(RTLD_NEXT, name));
}

// offset: -1 where the file is.
template <class Write>
ssize_t written(const char* name, int descriptor, off_t offset, size_t size, const Write& write) {
  const Kind kind = fault(name, descriptor);
  if (fails_at_once(kind, true)) return -1;
  if ((kind != Kind::short_write && kind != Kind::torn) || size < 2) {
    const ssize_t done = write(size);
    if (done > 0 && minded(descriptor))
      unsynced().write(path_of(descriptor), offset >= 0 ? offset : ::lseek(descriptor, 0, SEEK_CUR) - done, done);
    return done;
  }
  const ssize_t half = write(size / 2);
  if (kind == Kind::torn) ::kill(::getpid(), SIGKILL);
  return half;
}

// Pieces are written by the first alone where a part is asked for.
template <class Write>
ssize_t pieces_written(const char* name, int descriptor, off_t offset, const iovec* pieces, int count,
                       const Write& write) {
  return written(name, descriptor, offset, static_cast<size_t>(2 * count), [&](size_t twice) {
    return twice == static_cast<size_t>(2 * count) || count == 1 ? write(pieces, count)
                                                                 : write(pieces, static_cast<int>(twice / 2));
  });
}

bool opens_for_writing(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0; }

template <class Open>
int opened(const char* path, int flags, const Open& open) {
  if (!opens_for_writing(flags)) return open();
  if (fails_at_once(fault("open", path), true)) return -1;
  const bool made = minded(path) && ::access(path, F_OK) != 0;
  const int descriptor = open();
  if (made && descriptor >= 0) unsynced().make(path);
  return descriptor;
}

template <class Sync>
int synced(int descriptor, const Sync& sync) {
  if (fails_at_once(fault("fsync", descriptor), true)) return -1;
  const int result = sync();
  if (result == 0 && minded(descriptor)) unsynced().sync(path_of(descriptor));
  return result;
}

template <class Where, class Call>
int done(const char* name, Where where, bool may_be_interrupted, const Call& call) {
  if (fails_at_once(fault(name, where), may_be_interrupted)) return -1;
  return call();
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  return written(__func__, descriptor, -1, size, [&](size_t part) { return real(descriptor, data, part); });
}
ssize_t pwrite(int descriptor, const void* data, size_t size, off_t offset) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return written(__func__, descriptor, offset, size, [&](size_t part) { return real(descriptor, data, part, offset); });
}
ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t offset) {
  return pwrite(descriptor, data, size, offset);
}
ssize_t writev(int descriptor, const iovec* pieces, int count) {
  static const auto real = next<ssize_t (*)(int, const iovec*, int)>("writev");
  return pieces_written(__func__, descriptor, -1, pieces, count,
                        [&](const iovec* some, int n) { return real(descriptor, some, n); });
}
ssize_t pwritev(int descriptor, const iovec* pieces, int count, off_t offset) {
  static const auto real = next<ssize_t (*)(int, const iovec*, int, off_t)>("pwritev");
  return pieces_written(__func__, descriptor, offset, pieces, count,
                        [&](const iovec* some, int n) { return real(descriptor, some, n, offset); });
}
ssize_t pwritev64(int descriptor, const iovec* pieces, int count, off64_t offset) {
  return pwritev(descriptor, pieces, count, offset);
}

int open(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) ? va_arg(more, mode_t) : 0;
  va_end(more);
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  return opened(path, flags, [&] { return real(path, flags, mode); });
}
int open64(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) ? va_arg(more, mode_t) : 0;
  va_end(more);
  static const auto real = next<int (*)(const char*, int, ...)>("open64");
  return opened(path, flags, [&] { return real(path, flags, mode); });
}

// Within a folder that is open: so the C++ library removes all that is in it.
int openat(int folder, const char* name, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) ? va_arg(more, mode_t) : 0;
  va_end(more);
  static const auto real = next<int (*)(int, const char*, int, ...)>("openat");
  return opened(path_in(folder, name).c_str(), flags, [&] { return real(folder, name, flags, mode); });
}

int fsync(int descriptor) {
  static const auto real = next<int (*)(int)>("fsync");
  return synced(descriptor, [&] { return real(descriptor); });
}
int fdatasync(int descriptor) {
  static const auto real = next<int (*)(int)>("fdatasync");
  return synced(descriptor, [&] { return real(descriptor); });
}
int ftruncate(int descriptor, off_t size) {
  static const auto real = next<int (*)(int, off_t)>("ftruncate");
  return done(__func__, descriptor, true, [&] { return real(descriptor, size); });
}
int ftruncate64(int descriptor, off64_t size) { return ftruncate(descriptor, size); }

// A network file system may tell here what it could not write.
int close(int descriptor) {
  static const auto real = next<int (*)(int)>("close");
  const int flags = ::fcntl(descriptor, F_GETFL);
  const Kind kind = flags >= 0 && (flags & O_ACCMODE) != O_RDONLY ? fault(__func__, descriptor) : Kind::none;
  const int result = real(descriptor);
  return fails_at_once(kind, false) ? -1 : result;
}

int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  const Kind kind = fault(__func__, to);
  if (fails_at_once(kind, false)) return -1;
  if (minded(to)) unsynced().rename(from, to);
  const int result = real(from, to);
  if (kind != Kind::renamed || result != 0) return result;
  errno = ENOENT;
  return -1;
}
int link(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("link");
  return done(__func__, to, false, [&] { return real(from, to); });
}
int unlink(const char* path) {
  static const auto real = next<int (*)(const char*)>("unlink");
  return done(__func__, path, false, [&] { return real(path); });
}
int unlinkat(int folder, const char* name, int flags) {
  static const auto real = next<int (*)(int, const char*, int)>("unlinkat");
  return done(__func__, path_in(folder, name).c_str(), false, [&] { return real(folder, name, flags); });
}
int remove(const char* path) {
  static const auto real = next<int (*)(const char*)>("remove");
  return done(__func__, path, false, [&] { return real(path); });
}
int rmdir(const char* path) {
  static const auto real = next<int (*)(const char*)>("rmdir");
  return done(__func__, path, false, [&] { return real(path); });
}
int futimens(int descriptor, const timespec* times) {
  static const auto real = next<int (*)(int, const timespec*)>("futimens");
  return done(__func__, descriptor, false, [&] { return real(descriptor, times); });
}
int mkdir(const char* path, mode_t mode) {
  static const auto real = next<int (*)(const char*, mode_t)>("mkdir");
  return done(__func__, path, false, [&] { return real(path, mode); });
}

}  // extern "C"
