// A sweep or a fit at work in its folder: others are kept out, and a request to stop is answered, whatever it is doing.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <freestand/error.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/folder_lock.hpp"
#include "io/output_folder.hpp"
#include "parallel/communicator.hpp"
#include "parallel/stop.hpp"

namespace freestand::study {

// Batch systems give 30 s and more between the request and the end.
inline constexpr double patience_s = 7;

class RunFolder {
 public:
  // Makes the folder, takes its lock, and then does with what is in it as `existing` says. `go_on`: what the user is told
  // to do after a stop ("go on with --resume"). A run that has not ended patience_s after it was asked to stop is ended where
  // it stands. Collective, as all below. Throws Error as io::FolderLock and io::prepare_output_folder do, and where the folder is
  // another one for some rank (Exit::usage): local to its node.
  RunFolder(const parallel::Communicator&, const std::filesystem::path& folder, io::Existing existing,
            std::string go_on, const io::CommandFiles& files = {});

  const std::filesystem::path& path() const { return folder_; }

  // The work begins: what is finished by now is noted in the folder. A run that is stopped before it comes here notes it as
  // it stops, so that runs whose time ends while they start are told from runs that get on; one that is refused notes nothing.
  void begin();

  // Throws Error if the lock was lost.
  void confirm() const;

  // Throws the Error of a run that was asked to stop, if any rank was: Exit::resumable, or Exit::cure where neither this
  // run nor the one before it finished anything, so that another would not either.
  void leave_if_asked();
  [[noreturn]] void leave();

  // All is done: there is nothing to go on with.
  void end() const;

 private:
  void refuse_other_folders() const;
  void note_start();
  Error stopped();
  void overdue();

  const parallel::Communicator world_;
  const std::filesystem::path folder_;
  const std::string go_on_;
  std::optional<io::FolderLock> lock_;  // on the root
  std::atomic<bool> ready_ = false;     // what is in the folder is this run's to change
  std::mutex noting_;                   // of the three below: a run that is overdue ends from another thread
  bool noted_ = false;                  // on the root, as the next two
  std::int64_t finished_ = -1;          // when the work began
  bool fruitless_before_ = false;       // the run before began with as much
  parallel::StopOnSignal stop_on_signal_;
};

}  // namespace freestand::study
