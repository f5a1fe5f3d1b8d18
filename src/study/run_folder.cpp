#include "study/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include "base/folder.hpp"
#include "io/own_files.hpp"
#include "parallel/finished_blocks.hpp"
#include "study/sweep.hpp"

namespace freestand::study {
namespace {

namespace fs = std::filesystem;

// mpirun ends all ranks when the first one has gone: the root, which speaks for all, goes first.
constexpr double patience_of_others_s = patience_s + 1;

// What is finished, as a number that is another one when there is more, and 0 where there is nothing: by how long the logs of blocks are, what is
// counted, and when samples.h5 was written (less than 0 for the clock of some libraries).
std::int64_t finished_in(const fs::path& folder) {
  std::error_code error;
  std::int64_t finished = 0;
  if (fs::exists(samples_path(folder), error))
    finished = fs::last_write_time(samples_path(folder), error).time_since_epoch().count();
  return finished + parallel::bytes_of_logs(blocks_path(folder)) + parallel::count_summed_blocks(blocks_path(folder));
}

fs::path note_path(const fs::path& folder) { return folder / io::begun_name; }

}  // namespace

RunFolder::RunFolder(const parallel::Communicator& world, const fs::path& folder, io::Existing existing,
                     std::string go_on, const io::CommandFiles& files)
    : world_(world),
      folder_(folder),
      go_on_(std::move(go_on)),
      stop_on_signal_({world.is_root() ? patience_s : patience_of_others_s, [this] { overdue(); }}) {
  std::signal(SIGPIPE, SIG_IGN);  // who read the progress may leave; the run goes on
  world_.on_root([&] {
    io::make_output_folder(folder_, existing, files);
    lock_.emplace(folder_, io::FolderLock::Settings{.lost = parallel::request_stop});
    io::prepare_output_folder(folder_, existing, files);
    ready_ = true;
  });
  refuse_other_folders();
}

// The root's lock is there for all, word for word, or this is not its folder: a lock of a run that died may lie in another one. A network file
// system may show it late.
void RunFolder::refuse_other_folders() const {
  const auto text = [this] {
    std::error_code ignored;
    const fs::directory_iterator refreshed(folder_, ignored);
    std::ostringstream words;
    words << std::ifstream(folder_ / io::lock_name).rdbuf();
    return words.str();
  };
  const std::string roots = world_.broadcast(world_.is_root() ? text() : std::string());
  bool seen = false;
  for (int tries = 0; tries < 200 && !seen; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    seen = text() == roots;
  }
  const auto all = world_.gather({seen});
  world_.on_root([&] {
    const auto other = std::find(all.begin(), all.end(), parallel::Words{0});
    if (other != all.end())
      throw Error(
          fmt::format("{} is not the same folder on every node (rank {} does not see what rank 0 has written there): "
                      "name one on a file system that all nodes share",
                      folder_.string(), other - all.begin()));
  });
}

void RunFolder::begin() {
  world_.on_root([&] {
    const std::lock_guard guard(noting_);
    remove_asides(folder_);
    note_start();
  });
}

void RunFolder::note_start() {
  finished_ = finished_in(folder_);
  std::ifstream note(note_path(folder_));
  std::string signature;
  std::int64_t before = -1;
  std::getline(note, signature) >> before;
  fruitless_before_ = before == finished_;
  io::write_text(note_path(folder_), io::signed_text(fmt::format("{}\n", finished_)));
  noted_ = true;
}

void RunFolder::confirm() const {
  world_.on_root([&] { lock_->confirm(); });
}

Error RunFolder::stopped() {
  const std::lock_guard guard(noting_);
  try {
    if (ready_ && !noted_) note_start();
  } catch (const Error& error) {  // as of a full disk
    return error;
  }
  if (noted_ && fruitless_before_ && finished_in(folder_) == finished_)
    return Error(fmt::format("stopped in {} before anything more was finished, as was the run before (its time is too "
                             "short): give it more time, or a smaller block_size, and {}",
                             folder_.string(), go_on_),
                 Exit::cure);
  return Error(fmt::format("stopped early (on request): {} in {}; {}",
                           finished_in(folder_) != 0 ? "what is finished is kept" : "nothing was finished",
                           folder_.string(), go_on_),
               Exit::resumable);
}

void RunFolder::leave() {
  parallel::request_stop();  // of a rank that was not asked itself, too: the signal may still be on its way to it
  world_.on_root([&] {
    lock_->confirm();
    throw stopped();
  });
  std::abort();  // on_root has thrown
}

void RunFolder::leave_if_asked() {
  if (world_.any(parallel::stop_requested())) leave();
}

void RunFolder::end() const {
  world_.on_root([&] {
    std::error_code ignored;
    fs::remove(note_path(folder_), ignored);
  });
}

void RunFolder::overdue() {
  const Error error = stopped();
  io::FolderLock::release_all();  // that of a catalogue around it, too
  parallel::end_run(world_, error);
  std::_Exit(static_cast<int>(error.exit()));
}

}  // namespace freestand::study
