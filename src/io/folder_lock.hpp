// One job at a time in a folder of results.
//
// The holder makes FOLDER/freestand.lock, which fails where it is there already (O_EXCL, also between the machines of a
// cluster), and touches it every few seconds. It holds, as JSON: host, process and job of the holder, since when, and a
// word that no other lock has.
#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace freestand::io {

inline constexpr const char* lock_name = "freestand.lock";

class FolderLock {
 public:
  struct Settings {
    double beat_s = 10;     // how often the holder touches its lock
    double silence_s = 60;  // a holder that does not do so for that long is dead
    // Called once, from another thread, when the lock is found to be another's: this process slept longer than that.
    std::function<void()> lost = [] {};
  };

  // Takes the lock of an existing folder. Throws Error (Exit::usage), naming the holder, where another has it. A lock
  // whose holder is dead is taken over: at once where its process can be looked up and is gone (same machine since the
  // same start), else after a silence, which this waits for. Clocks are not compared.
  explicit FolderLock(const std::filesystem::path& folder) : FolderLock(folder, Settings{}) {}
  FolderLock(const std::filesystem::path& folder, Settings);
  ~FolderLock();  // gives it back
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // Throws Error (Exit::usage) if the lock has become another's: before what two may not do at the same time.
  void confirm() const;

  // Gives it back before the end of its life. Safe to call from any thread.
  void release();
  // The same of all that this process holds, before it ends where it stands.
  static void release_all();

 private:
  struct Held;  // by this process
  static Held& held_here();
  bool create();
  void take_over(const std::string& text) const;
  bool is_ours() const;
  void beat();

  std::filesystem::path path_;
  Settings settings_;
  int descriptor_ = -1;  // of the lock that was made here, whoever's file now has its name
  std::atomic<bool> released_ = false;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::thread heart_;
};

}  // namespace freestand::io
