#include <fstream>

#include "spoilt_files/target.hpp"
#include "support/scratch.hpp"

namespace freestand::spoilt_files {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> all_kinds = study_targets();
    for (const auto& more : {file_targets(), edited_targets()})
      all_kinds.insert(all_kinds.end(), more.begin(), more.end());
    return all_kinds;
  }();
  return all;
}

const Target& target(const std::string& name) {
  std::string names;
  for (const Target& each : targets()) {
    if (each.name == name) return each;
    names += (names.empty() ? "" : ", ") + each.name;
  }
  throw std::invalid_argument("no target is called \"" + name + "\": " + names);
}

std::filesystem::path written(std::string_view bytes, const std::string& name) {
  static const test::Scratch folder("spoilt_files");
  const std::filesystem::path file = folder / name;
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

}  // namespace freestand::spoilt_files
