#include "study/sweep_size.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/error_text.hpp"

namespace freestand::study::sweep_size_test {
namespace {

using freestand::test::error_text;
using testing::HasSubstr;

// 19.4 GB fit into 25.3 GB once, not twice.
TEST(SweepSizeTest, TheRanksOfANodeShareItsMemory) {
  SweepSize size;
  size.memory_bytes = 19.4e9;
  EXPECT_NO_THROW(refuse_too_large(size, {1, 25.3e9}));
  EXPECT_THAT(error_text(Exit::usage,
                         [&] {
                           refuse_too_large(size, {2, 25.3e9});
                         }),
              HasSubstr("takes 19.4 GB in each rank, and a node with 2 of them has 25.3 GB"));
  EXPECT_NO_THROW(refuse_too_large(size, {2, 50.6e9}));
  EXPECT_THAT(error_text(Exit::usage, [&] { refuse_too_large(size, {1, 16e9}); }), HasSubstr("has 16 GB"));
}

}  // namespace
}  // namespace freestand::study::sweep_size_test
