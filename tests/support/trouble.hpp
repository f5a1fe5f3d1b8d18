// Trouble with files, made on purpose in a child process: a file size limit (the write stops in the middle, as on a
// full disk), and another user without rights.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <freestand/error.hpp>
#include <functional>
#include <string>

namespace freestand::test {

struct Told {
  int exit = -1;     // exit code of the Error, 0: none was thrown, -1: the child died
  std::string text;  // of the Error
};

// Runs `work` in a child process after `before`, and brings back the Error that it threw.
inline Told in_child(const std::function<void()>& before, const std::function<void()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    int code = 0;
    try {
      before();
      work();
    } catch (const Error& error) {
      code = static_cast<int>(error.exit());
      const std::string text = error.what();
      if (::write(ends[1], text.data(), text.size()) < 0) code = 99;
    } catch (...) {
      code = 98;
    }
    ::_exit(code);
  }
  ::close(ends[1]);
  Told told;
  char buffer[4096];
  for (ssize_t n; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;)
    told.text.append(buffer, static_cast<std::size_t>(n));
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) told.exit = WEXITSTATUS(status);
  return told;
}

inline Told with_file_size_limit(rlim_t bytes, const std::function<void()>& work) {
  return in_child(
      [bytes] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
      },
      work);
}

// As a user who may not write to `folder`.
inline Told without_rights(const std::filesystem::path& folder, const std::function<void()>& work) {
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec |
                                           std::filesystem::perms::others_read | std::filesystem::perms::others_exec);
  const Told told = in_child(
      [] {
        if (::geteuid() == 0 && ::setresuid(65534, 65534, 65534) != 0) ::_exit(97);
      },
      work);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  return told;
}

// A small file system of its own, where this machine lets us mount one (root outside of most containers).
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, const std::string& size) : folder_(folder) {
    std::filesystem::create_directories(folder);
    mounted_ =
        std::system(("mount -t tmpfs -o size=" + size + " tmpfs '" + folder.string() + "' 2>/dev/null").c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_ && std::system(("umount '" + folder_.string() + "'").c_str()) != 0) std::perror("umount");
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  bool mounted_ = false;
};

}  // namespace freestand::test
