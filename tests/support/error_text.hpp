// The text of the Error that something throws.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <freestand/error.hpp>
#include <string>

namespace freestand::test {

template <class Work>
std::string error_text(Exit expected, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), expected) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace freestand::test
