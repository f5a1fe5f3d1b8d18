#include "io/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <freestand/error.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "build_info.hpp"
#include "git_commit.hpp"
#include "io/h5_internal.hpp"

namespace freestand::io {
namespace {

std::string host_name() {
  char text[256] = {};
  return ::gethostname(text, sizeof text - 1) == 0 ? text : "unknown";
}

std::string now_utc() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

std::string mpi_version() {
#ifdef OMPI_MAJOR_VERSION
  return fmt::format("Open MPI {}.{}.{}", OMPI_MAJOR_VERSION, OMPI_MINOR_VERSION, OMPI_RELEASE_VERSION);
#else
  return fmt::format("MPI standard {}.{}", MPI_VERSION, MPI_SUBVERSION);
#endif
}

std::string library_versions() {
  nlohmann::ordered_json versions;
  const auto add = [&](const char* name, const std::string& version) {
    if (!version.empty()) versions[name] = version;
  };
  add("MPI", mpi_version());
  add("HDF5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE));
  add("SUNDIALS", FREESTAND_SUNDIALS_VERSION);
  add("GSL", FREESTAND_GSL_VERSION);
  add("FFTW", FREESTAND_FFTW_VERSION);
  add("Eigen", FREESTAND_EIGEN_VERSION);
  add("fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  return versions.dump();
}

}  // namespace

Provenance provenance_here(const std::string& command, int ranks) {
  Provenance here;
  here.version = FREESTAND_VERSION;
  here.git_commit = FREESTAND_GIT_COMMIT;
  here.compiler = FREESTAND_COMPILER;
  here.libraries = library_versions();
  here.host = host_name();
  here.created_utc = now_utc();
  here.command = command;
  here.ranks = ranks;
  return here;
}

std::string command_line(int argc, const char* const* argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool quoted = argument.empty() || argument.find_first_of(" \t\n\"'*?$\\;&|<>()") != std::string::npos;
    if (i) line += ' ';
    if (!quoted) {
      line += argument;
      continue;
    }
    line += '\'';
    for (const char c : argument) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

void write_provenance(h5::Group& root, const std::string& format, const Provenance& from) {
  root.attribute("format", format);
  root.attribute("study_name", from.study_name);
  root.attribute("study", from.study);
  root.attribute("effects", from.effects);
  root.attribute("accuracy", from.accuracy);
  root.attribute("doubts", from.doubts);
  root.attribute("seed", static_cast<std::int64_t>(from.seed));
  root.attribute("samples", from.samples);
  if (from.alike) root.attribute("samples_alike", *from.alike);
  root.attribute("kernel", from.kernel);
  root.attribute("version", from.version);
  root.attribute("git_commit", from.git_commit);
  root.attribute("compiler", from.compiler);
  root.attribute("libraries", from.libraries);
  root.attribute("host", from.host);
  root.attribute("created_utc", from.created_utc);
  root.attribute("command", from.command);
  root.attribute("ranks", from.ranks);
}

Provenance read_provenance(const h5::Group& root, const std::string& format) {
  const std::string found = root.has_attribute("format") ? root.text_attribute("format") : "";
  if (found != format)
    throw Error(fmt::format("{} cannot be used (its format is \"{}\", not \"{}\"): name a file that this version of "
                            "freestand has written",
                            root.file_path(), found, format),
                Exit::data);
  Provenance from;
  from.study_name = root.text_attribute("study_name");
  from.study = root.text_attribute("study");
  if (root.has_attribute("effects")) from.effects = root.text_attribute("effects");
  if (root.has_attribute("accuracy")) from.accuracy = root.text_attribute("accuracy");
  if (root.has_attribute("doubts")) from.doubts = root.text_attribute("doubts");
  if (root.has_attribute("kernel")) from.kernel = root.text_attribute("kernel");
  from.seed = static_cast<std::uint64_t>(root.integer_attribute("seed"));
  from.samples = h5::count_attribute(root, "samples", std::numeric_limits<std::int64_t>::max());
  if (root.has_attribute("samples_alike")) from.alike = h5::count_attribute(root, "samples_alike", from.samples);
  from.version = root.text_attribute("version");
  from.git_commit = root.text_attribute("git_commit");
  from.compiler = root.text_attribute("compiler");
  from.libraries = root.text_attribute("libraries");
  from.host = root.text_attribute("host");
  from.created_utc = root.text_attribute("created_utc");
  from.command = root.text_attribute("command");
  from.ranks = static_cast<int>(h5::count_attribute(root, "ranks", std::numeric_limits<int>::max()));
  return from;
}

}  // namespace freestand::io
