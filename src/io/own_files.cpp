#include "io/own_files.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>
#include <fstream>

#include "base/durable_file.hpp"
#include "io/h5.hpp"
#include "io/written_files.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view maker_of_page = "<meta name=\"generator\" content=\"freestand\">";

constexpr std::string_view signed_by = "# Written by freestand (";

std::string signature(std::string_view text) {
  return fmt::format("{}{}). Changed in any way it is yours, and is never replaced.\n", signed_by, hash_text(text));
}

bool is_signed(std::string_view content) {
  const std::size_t rest = std::min(content.find('\n'), content.size() - 1) + 1;
  return content.substr(0, rest) == signature(content.substr(rest));
}

bool has_own_format(const fs::path& path) {
  const h5::File file = h5::File::open(path);
  const h5::Group root = file.root();
  return root.has_attribute("format") && root.text_attribute("format").starts_with("freestand-");
}

std::string beginning(const fs::path& path) {
  std::string text(4096, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

// Columns that stand side by side in the header of a result, and hardly anywhere else.
bool has_own_columns(const std::string& text) {
  const std::string_view header = std::string_view(text).substr(0, text.find('\n'));
  for (const std::string_view columns :
       {"edp,unit,im", "edp,capacity,probability", "edp,unit,capacity,axis", "edp,rank,im", "rotation_rate_radps,mode",
        "id,width_m,height_m", "id,intensity,demand,capacity", "parameter,share,share_se",
        "annual_rate,annual_rate_lower", "figure,series,"})
    if (header.find(columns) != std::string_view::npos) return true;
  return false;
}

}  // namespace

std::string signed_text(std::string_view text) { return signature(text).append(text); }

bool is_own(const fs::path& path) {
  const std::string kind = path.extension().string();
  if (!fs::is_regular_file(path)) return false;
  try {
    if (kind == ".h5") return has_own_format(path);
    if (const Written listed = written(path); listed != Written::unknown) return listed == Written::unchanged;
    if (kind == ".csv" && has_own_columns(beginning(path))) return true;
    if (kind == ".json") return beginning(path).find("\"format\": \"freestand-") != std::string::npos;
    if (kind == ".html") return beginning(path).find(maker_of_page) != std::string::npos;
    return is_signed(read_whole(path));
  } catch (const Error&) {
    return false;
  }
}

bool was_changed(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored) || is_own(path)) return false;
  return written(path) == Written::changed || beginning(path).starts_with(signed_by);
}

void refuse_others(const fs::path& folder, const std::vector<std::string>& names) {
  std::string found;
  std::error_code ignored;
  for (const std::string& name : names)
    if (fs::exists(fs::symlink_status(folder / name, ignored)) && !is_own(folder / name))
      found += (found.empty() ? "" : ", ") + (folder / name).string();
  if (found.empty()) return;
  throw Error(
      fmt::format("{} would be replaced (freestand did not write it, or it was changed since): name another "
                  "folder, or move it away",
                  found));
}

}  // namespace freestand::io
