#include "base/folder.hpp"

#include <string>
#include <system_error>

#include "base/durable_file.hpp"
#include "base/shown_text.hpp"

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

// In words, of what could not be opened.
std::string why_unreadable(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::directory) return "it is a folder";
  if (type == fs::file_type::not_found) return "no such file";
  return error && error != std::errc::permission_denied ? error.message() : "no permission";
}

}  // namespace

bool is_there(const fs::path& path) { return type_of(path) != fs::file_type::not_found; }
bool is_file(const fs::path& path) { return type_of(path) == fs::file_type::regular; }
bool is_folder(const fs::path& path) { return type_of(path) == fs::file_type::directory; }

std::ifstream open_to_read(const fs::path& file, Exit exit) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || is_folder(file))
    throw Error(shown(file.string(), longest_path) + " cannot be read (" + why_unreadable(file) + "): check the path",
                exit);
  return stream;
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
