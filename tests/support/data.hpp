// Where the real records are, for tests that use them when they are there.
#pragma once

#include <filesystem>

namespace freestand::test {

inline std::filesystem::path data_dir() { return FREESTAND_DATA_DIR; }
inline std::filesystem::path records_dir() { return data_dir() / "records"; }
inline std::filesystem::path source_dir() { return FREESTAND_SOURCE_DIR; }

}  // namespace freestand::test

// Skips the test, saying so, when the real records are not there.
#define FREESTAND_NEEDS_RECORDS()                                                            \
  if (!std::filesystem::exists(freestand::test::records_dir()))                              \
  GTEST_SKIP() << "real records are not there (no folder " << freestand::test::records_dir() \
               << "): set FREESTAND_DATA_DIR to run this test"
