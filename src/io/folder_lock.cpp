#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <freestand/error.hpp>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <vector>

#include "base/durable_file.hpp"
#include "base/file_calls.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

// Names the table in which a process number means something: this start of this machine, and the container in it.
std::string process_table() {
  std::error_code error;
  const std::string space = fs::read_symlink("/proc/self/ns/pid", error).string();
  const std::string start = first_line("/proc/sys/kernel/random/boot_id");
  return start.empty() || space.empty() ? "" : start + " " + space;
}

struct ProcessState {
  char state = '?';
  std::string started;  // ticks since the start of the machine
};

// From /proc/NUMBER/stat: "number (name) state parent ...", the start is the 22nd field.
std::optional<ProcessState> process_state(int number) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", number));
  const auto end_of_name = line.rfind(')');
  if (end_of_name == std::string::npos) return {};
  std::istringstream fields(line.substr(end_of_name + 1));
  ProcessState found;
  fields >> found.state;
  for (int field = 4; field <= 22; ++field) fields >> found.started;
  return found;
}

std::string job() {
  for (const char* variable : {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "JOB_ID"})
    if (const char* number = std::getenv(variable)) return number;
  return "";
}

std::string description_of_ours() {
  char host[256] = "unknown";
  ::gethostname(host, sizeof host - 1);
  std::random_device random;
  const auto own = process_state(::getpid());
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const Json json{{"format", "freestand-lock/1"},
                  {"host", host},
                  {"process", ::getpid()},
                  {"process_started", own ? own->started : ""},
                  {"process_table", process_table()},
                  {"job", job()},
                  {"since", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
                  {"word", fmt::format("{:08x}{:08x}", random(), random())}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// A lock as it lies there.
struct Found {
  std::string text;
  timespec touched;

  bool operator==(const Found& other) const {
    return text == other.text && touched.tv_sec == other.touched.tv_sec && touched.tv_nsec == other.touched.tv_nsec;
  }
};

std::optional<Found> look_at(const fs::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return {};
    throw file_error("read", path, errno);
  }
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return Found{text.str(), status.st_mtim};
}

enum class Holder { alive, dead, out_of_sight };

Holder holder_of(const Json& json) {
  const std::string table = json.value("process_table", "");
  if (table.empty() || table != process_table()) return Holder::out_of_sight;
  const int process = json.value("process", 0);
  if (process <= 0 || (::kill(process, 0) != 0 && errno == ESRCH)) return Holder::dead;
  const auto found = process_state(process);
  if (!found) return Holder::alive;
  const bool ended = found->state == 'Z' || found->state == 'X';
  return ended || found->started != json.value("process_started", "") ? Holder::dead : Holder::alive;
}

// What a lock tells of its holder, where it is of the kind that is meant: whatever else lies under its name tells nothing.
Json parsed(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  Json known = Json::object();
  if (!json.is_object()) return known;
  for (const auto& [key, value] : json.items()) {
    const bool number = value.is_number_integer() && value >= 0 && value <= std::numeric_limits<int>::max();
    if (key == "process" ? number : value.is_string()) known[key] = value;
  }
  return known;
}

std::string description(const Json& json) {
  if (!json.contains("host")) return "somebody who left no name";
  const std::string number = json.value("job", "");
  return fmt::format("process {} on {}{}, since {}", json.value("process", 0), json.value("host", ""),
                     number.empty() ? "" : ", job " + number, json.value("since", ""));
}

// Of another user, say, or a folder: whoever may has to.
void take_away(const fs::path& path) {
  if (::unlink(path.c_str()) == 0 || errno == ENOENT) return;
  throw Error(
      fmt::format("{} was left by a run that died and cannot be removed here ({}): remove it, or have its owner do so",
                  path.string(), std::strerror(errno)),
      Exit::cure);
}

Error refusal(const fs::path& path, const Json& json) {
  return Error(fmt::format("{} is in use ({} works in it): wait for its end, or choose another folder",
                           path.parent_path().string(), description(json)));
}

}  // namespace

struct FolderLock::Held {
  std::mutex mutex;
  std::vector<FolderLock*> locks;
};

FolderLock::Held& FolderLock::held_here() {
  static Held held;
  return held;
}

FolderLock::FolderLock(const fs::path& folder, Settings settings)
    : path_(folder / lock_name), settings_(std::move(settings)) {
  const auto silence = std::chrono::duration<double>(settings_.silence_s);
  std::optional<Found> watched;
  Clock::time_point since;
  while (!create()) {
    const auto found = look_at(path_);
    if (!found) continue;
    const Json json = parsed(found->text);
    const Holder holder = holder_of(json);
    const bool touched_again = watched && watched->text == found->text && !(*watched == *found);
    if (holder == Holder::alive || touched_again) throw refusal(path_, json);
    if (holder == Holder::out_of_sight && watched != found) {
      watched = found;
      since = Clock::now();
      std::fputs(fmt::format("{} may be in use ({}): watching it for {:g} s\n", folder.string(), description(json),
                             settings_.silence_s)
                     .c_str(),
                 stderr);
    }
    if (holder == Holder::dead || Clock::now() - since > silence)
      take_over(found->text);
    else
      std::this_thread::sleep_for(std::min(silence / 20, std::chrono::duration<double>(0.5)));
  }
  heart_ = std::thread([this] { beat(); });
  const std::lock_guard guard(held_here().mutex);
  held_here().locks.push_back(this);
}

FolderLock::~FolderLock() {
  {
    const std::lock_guard guard(held_here().mutex);
    std::erase(held_here().locks, this);
  }
  release();
  {
    const std::lock_guard guard(mutex_);
    wake_.notify_all();
  }
  if (heart_.joinable()) heart_.join();
  ::close(descriptor_);
}

// False: there is one already.
bool FolderLock::create() {
  descriptor_ = uninterrupted([&] { return ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644); });
  if (descriptor_ < 0 && errno == EEXIST) return false;
  if (descriptor_ < 0) throw file_error("write", path_, errno);
  const std::string text = description_of_ours();
  if (all_done(std::span(text),
               [&](auto part, std::size_t) { return ::write(descriptor_, part.data(), part.size()); }) &&
      (uninterrupted([&] { return ::fsync(descriptor_); }) == 0 || errno == EINVAL))
    return true;
  const int error_number = errno;
  ::unlink(path_.c_str());
  ::close(descriptor_);
  throw file_error("write", path_, error_number);
}

// One at a time looks again whether the dead lock is still there, and takes it away: none takes a new one for it. Who does not get that done
// for as long as a holder may be silent is dead.
void FolderLock::take_over(const std::string& text) const {
  const fs::path turn = path_.parent_path() / fmt::format(".{}.taken_over.part", lock_name);  // is_aside_name()
  const auto end = Clock::now() + std::chrono::duration<double>(settings_.silence_s);
  int descriptor = -1;
  while ((descriptor =
              uninterrupted([&] { return ::open(turn.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644); })) < 0) {
    if (errno != EEXIST) throw file_error("take over", path_, errno);
    if (Clock::now() > end) take_away(turn);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::close(descriptor);
  const struct Turn {
    const fs::path& file;
    ~Turn() { ::unlink(file.c_str()); }
  } ours{turn};
  if (const auto there = look_at(path_); there && there->text == text) take_away(path_);
}

bool FolderLock::is_ours() const {
  struct stat ours = {}, there = {};
  if (::fstat(descriptor_, &ours) != 0) return false;
  if (::stat(path_.c_str(), &there) != 0) return errno != ENOENT;
  return ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

void FolderLock::beat() {
  const std::chrono::duration<double> interval(settings_.beat_s);
  std::unique_lock guard(mutex_);
  while (!wake_.wait_for(guard, interval, [this] { return released_.load(); })) {
    if (!is_ours()) {
      settings_.lost();
      return;
    }
    ::futimens(descriptor_, nullptr);
  }
}

void FolderLock::confirm() const {
  if (is_ours()) return;
  const auto found = look_at(path_);
  throw refusal(path_, parsed(found ? found->text : ""));
}

void FolderLock::release() {
  if (!released_.exchange(true) && is_ours()) ::unlink(path_.c_str());
}

void FolderLock::release_all() {
  const std::lock_guard guard(held_here().mutex);
  for (FolderLock* lock : held_here().locks) lock->release();
}

}  // namespace freestand::io
