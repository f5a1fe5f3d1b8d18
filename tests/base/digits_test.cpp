// How tables and sentences show numbers.
#include "base/digits.hpp"

#include <gtest/gtest.h>

namespace freestand {
namespace {

TEST(Digits, Three) {
  EXPECT_EQ(three_digits(1), "1.00");
  EXPECT_EQ(three_digits(45.78), "45.8");
  EXPECT_EQ(three_digits(99.96), "100");
  EXPECT_EQ(three_digits(123.4), "123");
  EXPECT_EQ(three_digits(-0.046), "-0.0460");
  EXPECT_EQ(three_digits(12345), "1.2e+04");
}

}  // namespace
}  // namespace freestand
