#include "study/paths.hpp"

#include <fmt/format.h>

namespace freestand::study {

std::filesystem::path read_paths_from(Section& section, const std::filesystem::path& file, Files look) {
  const std::filesystem::path folder = file.parent_path();
  if (!section.find("paths_from")) return folder;
  const std::filesystem::path start = folder / section.text("paths_from", "");
  std::error_code ignored;
  if (look == Files::look && !std::filesystem::is_directory(start, ignored))
    section.problem("paths_from",
                    fmt::format("paths_from leads to {} (which is no folder): correct it, or remove it where "
                                "paths start at the study's own folder",
                                start.string()));
  return start;
}

std::string way_between(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto named = [](const std::filesystem::path& folder) { return folder.empty() ? "." : folder; };
  const std::string way = std::filesystem::proximate(named(to), named(from)).generic_string();
  return way == "." ? "" : way;
}

}  // namespace freestand::study
