#include "io/written_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/durable_file.hpp"
#include "base/random.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view head =
    "# What freestand wrote here, by a hash. A file of these that was changed since is yours, and is never replaced.\n";
constexpr std::size_t digits = 16;  // of a hash, a blank behind them

struct Line {
  std::string hash, name;
};

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<Line> lines_in(const fs::path& folder) {
  std::vector<Line> lines;
  if (!is_there(folder / written_name)) return lines;
  const std::string text = read_whole(folder / written_name);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    if (text[from] != '#' && to - from > digits + 1)
      lines.push_back({text.substr(from, digits), text.substr(from + digits + 1, to - from - digits - 1)});
    from = to + 1;
  }
  return lines;
}

fs::path folder_of_result(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

}  // namespace

std::string hash_text(std::string_view content) { return fmt::format("{:016x}", random::stable_hash(content)); }

Written written(const fs::path& file) {
  std::string found;
  for (const Line& line : lines_in(folder_of_result(file))) {
    if (line.name != file.filename() || !is_there(file)) continue;
    if (found.empty()) found = hash_text(read_whole(file));
    if (line.hash == found) return Written::unchanged;
  }
  return found.empty() ? Written::unknown : Written::changed;
}

std::vector<std::string> written_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (Line& line : lines_in(folder)) names.push_back(std::move(line.name));
  return names;
}

void write_result(const fs::path& file, std::string_view text) {
  const fs::path folder = folder_of_result(file);
  const std::string name = file.filename().string(), hash = hash_text(text);
  const std::string before = is_there(file) ? hash_text(read_whole(file)) : hash;
  std::string list(head);
  for (const Line& line : lines_in(folder))
    if (line.name != name || (line.hash == before && before != hash))
      list += fmt::format("{} {}\n", line.hash, line.name);
  list += fmt::format("{} {}\n", hash, name);
  write_durably(folder / written_name, list);
  write_durably(file, text);
}

}  // namespace freestand::io
