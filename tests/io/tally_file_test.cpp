#include "io/tally_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "io/samples_file.hpp"
#include "support/error_text.hpp"
#include "support/sample_blocks.hpp"
#include "support/scratch.hpp"

namespace freestand::io {
namespace {

TEST(TallyFile, ReadsBackToTheBit) {
  const test::Scratch scratch;
  TallyContent content{
      provenance_here("freestand run", 3), "0123abcd", {0, -1, std::numeric_limits<std::int64_t>::max()}};
  content.provenance.samples = std::int64_t{1} << 40;
  write_tally(scratch.folder() / "tally.h5", content);
  const TallyContent again = read_tally(scratch.folder() / "tally.h5");
  EXPECT_EQ(again.words, content.words);
  EXPECT_EQ(again.fingerprint, content.fingerprint);
  EXPECT_EQ(again.provenance.samples, content.provenance.samples);
  EXPECT_EQ(again.provenance.created_utc, content.provenance.created_utc);
}

TEST(TallyFile, AnotherFormatIsRefused) {
  const test::Scratch scratch;
  const auto path = scratch.folder() / "samples.h5";
  write_samples({}, path, test::small_header(), {4, 4}, [](std::int64_t) { return test::small_rows(0, 4); });
  EXPECT_THAT(test::error_text(Exit::data, [&] { read_tally(path); }), testing::HasSubstr("freestand-tally/2"));
}

}  // namespace
}  // namespace freestand::io
