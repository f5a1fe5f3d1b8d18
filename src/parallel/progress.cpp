#include "parallel/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace freestand::parallel {
namespace {

std::string grouped(std::int64_t value) {
  std::string text = fmt::format("{}", value);
  for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
    text.insert(static_cast<std::size_t>(i), 1, ',');
  return text;
}

double percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string speed_text(double per_s) {
  return per_s >= 100 ? grouped(std::llround(per_s)) : fmt::format("{:.3g}", per_s);
}

}  // namespace

Counts& Counts::operator+=(const Counts& more) {
  samples += more.samples;
  overturned += more.overturned;
  failed += more.failed;
  return *this;
}

std::string duration_text(double seconds) {
  const auto s = static_cast<std::int64_t>(std::llround(std::clamp(seconds, 0.0, 1e12)));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  if (s < 86400) return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
  return fmt::format("{} d {} h", s / 86400, s % 86400 / 3600);
}

std::string progress_line(const Counts& done, std::int64_t total, std::int64_t before, double elapsed_s) {
  const std::int64_t all = before + done.samples;
  const double per_s = elapsed_s > 0 ? static_cast<double>(done.samples) / elapsed_s : 0.0;
  std::string line = fmt::format("{}/{} samples ({:.1f} %)", grouped(all), grouped(total), percent(all, total));
  if (per_s > 0) {
    line += fmt::format(", {}/s", speed_text(per_s));
    line += all < total ? fmt::format(", {} left", duration_text(static_cast<double>(total - all) / per_s))
                        : fmt::format(", took {}", duration_text(elapsed_s));
  }
  return line +
         fmt::format(", {:.1f} % overturned, {} failed", percent(done.overturned, done.samples), grouped(done.failed));
}

void tell(const std::string& text, std::FILE* stream) {
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

bool on_terminal() {
  if (::isatty(STDERR_FILENO)) return true;
  if (!std::getenv("OMPI_COMM_WORLD_RANK")) return false;
  // mpirun takes the standard error of its ranks through a pipe: what counts is where its own goes.
  std::error_code error;
  const auto target = std::filesystem::read_symlink(fmt::format("/proc/{}/fd/2", ::getppid()), error).string();
  return !error && (target.starts_with("/dev/pts/") || target.starts_with("/dev/tty"));
}

Progress::Progress(std::int64_t total, std::int64_t before, const Settings& settings)
    : total_(total), before_(before), settings_(settings), start_(Clock::now()), last_(start_) {}

double Progress::elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

bool Progress::due() const {
  if (settings_.quiet) return false;
  const double interval_s = settings_.terminal ? settings_.terminal_interval_s : settings_.log_interval_s;
  return std::chrono::duration<double>(Clock::now() - last_).count() >= interval_s;
}

void Progress::show(const Counts& done) {
  if (due()) print(done);
}

void Progress::print(const Counts& done) {
  if (settings_.quiet) return;
  last_ = Clock::now();
  const std::string line = progress_line(done, total_, before_, elapsed_s());
  if (settings_.terminal)
    tell("\r" + line + "\x1b[K", settings_.stream);
  else
    tell(line + "\n", settings_.stream);
  line_open_ = settings_.terminal;
}

void Progress::finish(const Counts& done) {
  print(done);
  if (line_open_) tell("\n", settings_.stream);
  line_open_ = false;
}

Progress::~Progress() {
  if (line_open_) std::fputs("\n", settings_.stream);
}

}  // namespace freestand::parallel
