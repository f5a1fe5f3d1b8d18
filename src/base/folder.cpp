#include "base/folder.hpp"

#include <system_error>

#include "base/durable_file.hpp"

namespace freestand {

namespace fs = std::filesystem;

namespace {

fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::none && error != std::errc::filename_too_long)
    throw file_error("look at", path, error.value());
  return type == fs::file_type::none ? fs::file_type::not_found : type;
}

}  // namespace

bool is_there(const fs::path& path) { return type_of(path) != fs::file_type::not_found; }
bool is_file(const fs::path& path) { return type_of(path) == fs::file_type::regular; }
bool is_folder(const fs::path& path) { return type_of(path) == fs::file_type::directory; }

std::string why_unreadable(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::directory) return "it is a folder";
  if (type == fs::file_type::not_found) return "no such file";
  return error && error != std::errc::permission_denied ? error.message() : "no permission";
}

std::vector<fs::path> paths_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) paths.push_back(i->path());
  if (error && error != std::errc::no_such_file_or_directory) throw file_error("read folder", folder, error.value());
  return paths;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw file_error("make folder", folder, error.value());
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw file_error("remove", path, error.value());
}

void remove_asides(const fs::path& folder) {
  for (const fs::path& path : paths_in(folder))
    if (is_aside_name(path)) remove_file(path);
}

}  // namespace freestand
