// Opens result files with the Python libraries that people use.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace freestand::test {

struct PythonRun {
  int exit = -1;  // 77: a library is not there
  std::string output;
};

// tests/io/check_files.py WHAT PATH
inline PythonRun check_with_python(const std::string& what, const std::filesystem::path& path) {
  const std::string script = std::string(FREESTAND_SOURCE_DIR) + "/tests/io/check_files.py";
  const std::string command = "/usr/bin/python3 '" + script + "' " + what + " '" + path.string() + "' 2>&1";
  PythonRun run;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return run;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) run.output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) run.exit = WEXITSTATUS(status);
  return run;
}

}  // namespace freestand::test

#define FREESTAND_CHECK_WITH_PYTHON(what, path)                                            \
  {                                                                                        \
    const freestand::test::PythonRun run = freestand::test::check_with_python(what, path); \
    if (run.exit == 77 || run.exit == 127) GTEST_SKIP() << "not checked: " << run.output;  \
    EXPECT_EQ(run.exit, 0) << run.output;                                                  \
  }
