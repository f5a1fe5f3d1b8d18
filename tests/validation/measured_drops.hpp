// The measured drops where they are, read once.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "support/data.hpp"
#include "support/square_drops.hpp"

namespace freestand::test {

inline std::filesystem::path drops_dir() { return data_dir() / "measurements" / "planar_square_drops"; }

inline const Drops& drops() {
  static const Drops read = read_square_drops(drops_dir());
  return read;
}

inline const std::vector<Blow>& blows() {
  static const std::vector<Blow> found = clean_blows(drops());
  return found;
}

}  // namespace freestand::test

// Skips the test, saying so, when the measured drops are not there.
#define FREESTAND_NEEDS_DROPS()                                                              \
  if (!std::filesystem::exists(freestand::test::drops_dir()))                                \
  GTEST_SKIP() << "measured drops are not there (no folder " << freestand::test::drops_dir() \
               << "): set FREESTAND_DATA_DIR to run this test"
