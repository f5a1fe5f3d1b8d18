// What a long run tells about itself: one line that is rewritten on a terminal, one plain line every ten seconds elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace freestand::parallel {

// Samples done, and of them overturned, and failed (painleve, step_limit, not_finite).
struct Counts {
  std::int64_t samples = 0, overturned = 0, failed = 0;

  Counts& operator+=(const Counts& more);
  bool operator==(const Counts&) const = default;
};

// "12,288/200,000 samples (6.1 %), 1,530/s, 2 min 3 s left, 12.3 % overturned, 0 failed"
// done: since the clock started. `before` of the total were there by then (resumed runs): they count as done, but neither
// for the speed nor among those that overturned or failed.
std::string progress_line(const Counts& done, std::int64_t total, std::int64_t before, double elapsed_s);

// "45 s", "2 min 3 s", "1 h 5 min", "3 d 2 h"; seconds >= 0.
std::string duration_text(double seconds);

// Writes to a log or a terminal. One that cannot be written (a full disk, a pipe that nobody reads) ends no run.
void tell(const std::string& text, std::FILE* stream = stderr);

// Is the standard error of this run, mpirun's where it was started by mpirun, a terminal?
bool on_terminal();

class Progress {
 public:
  struct Settings {
    std::FILE* stream = stderr;
    bool terminal = on_terminal();
    double terminal_interval_s = 0.2;
    double log_interval_s = 10;
    bool quiet = false;  // say nothing
  };

  // total: samples of the whole run; before: how many of them are already there.
  explicit Progress(std::int64_t total, std::int64_t before = 0) : Progress(total, before, Settings{}) {}
  Progress(std::int64_t total, std::int64_t before, const Settings& settings);

  // done: since the start of this run, `before` not included. Prints when it is time for it.
  void show(const Counts& done);
  // Is it time for show()?
  bool due() const;
  // The last line, always printed. Not called: the line is ended by the destructor.
  void finish(const Counts& done);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  void print(const Counts& done);
  double elapsed_s() const;

  std::int64_t total_;
  std::int64_t before_;
  Settings settings_;
  Clock::time_point start_, last_;
  bool line_open_ = false;
};

}  // namespace freestand::parallel
