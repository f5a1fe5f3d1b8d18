#include "io/h5.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>

#include "base/durable_file.hpp"
#include "io/closing_line.hpp"
#include "io/packed.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"
#include "support/trouble.hpp"

namespace freestand::io::h5 {
namespace {

namespace fs = std::filesystem;
using test::error_text;
using testing::AllOf;
using testing::HasSubstr;

bool empty(const fs::path& folder) { return fs::directory_iterator(folder) == fs::directory_iterator(); }

TEST(H5, AttributesComeBack) {
  const test::Scratch scratch("h5");
  const std::string longer_than_64_kib(300000, 'y');
  {
    File file = File::create(scratch / "x.h5");
    Group root = file.root();
    root.attribute("text", "études");
    root.attribute("long", longer_than_64_kib);
    root.attribute("none", "");
    root.attribute("whole", std::numeric_limits<std::int64_t>::min());
    root.attribute("real", 0.1);
    root.attribute("wholes", std::vector<std::int64_t>{1, -2});
    root.attribute("no_texts", std::vector<std::string>{});
    file.finish();
  }
  const Group root = File::open(scratch / "x.h5").root();
  EXPECT_EQ(root.text_attribute("text"), "études");
  EXPECT_EQ(root.text_attribute("long"), longer_than_64_kib);
  EXPECT_EQ(root.text_attribute("none"), "");
  EXPECT_EQ(root.integer_attribute("whole"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(root.real_attribute("real"), 0.1);
  EXPECT_EQ(root.integers_attribute("wholes"), (std::vector<std::int64_t>{1, -2}));
  EXPECT_TRUE(root.has_attribute("no_texts"));
  EXPECT_FALSE(root.has_attribute("other"));
}

TEST(H5, ValuesComeBackToTheBit) {
  const test::Scratch scratch("h5");
  const std::vector<double> values{0.1, -0.0, 1e-310, INFINITY, NAN, -1e308};
  {
    File file = File::create(scratch / "x.h5");
    Group root = file.root();
    root.put("real", values, {2, 3});
    root.put("flags", std::vector<std::uint8_t>{0, 255});
    root.put("texts", std::vector<std::string>{"", "a b", "é"});
    root.put("nothing", std::vector<double>{});
    root.put("nothing_wide", std::vector<double>{}, {0, 4});
    file.finish();
  }
  const Group root = File::open(scratch / "x.h5").root();
  const Dataset real = root.open_dataset("real");
  EXPECT_EQ(real.dimensions(), (Dimensions{2, 3}));
  EXPECT_EQ(real.type(), Type::real);
  const std::vector<double> back = real.read();
  ASSERT_EQ(back.size(), values.size());
  EXPECT_EQ(std::memcmp(back.data(), values.data(), values.size() * sizeof(double)), 0);
  EXPECT_EQ(root.open_dataset("flags").read(), (std::vector<double>{0, 255}));
  EXPECT_EQ(root.open_dataset("flags").type(), Type::flag);
  EXPECT_EQ(root.open_dataset("texts").read_texts(), (std::vector<std::string>{"", "a b", "é"}));
  EXPECT_EQ(root.open_dataset("nothing").read(), std::vector<double>{});
  EXPECT_EQ(root.open_dataset("nothing_wide").dimensions(), (Dimensions{0, 4}));
  EXPECT_EQ(root.names(), (std::vector<std::string>{"real", "flags", "texts", "nothing", "nothing_wide"}));
  EXPECT_TRUE(root.has("flags"));
  EXPECT_FALSE(root.has("flag"));
}

// Pieces of four rows, the last of which has two; written in any order.
TEST(H5, RowsAreReadFromPieces) {
  const test::Scratch scratch("h5");
  const std::filesystem::path aside = scratch / "aside.h5";
  std::vector<std::int32_t> rows{0, 1, 2, 3, 4, 5, 6, 7, 8, -9, 0, 0};
  {
    File file = File::create_at(aside, scratch / "x.h5");
    Dataset dataset = file.root().make_in_pieces("rows", Type::integer, 10, 4);
    for (const std::size_t first : {4, 0, 8})
      dataset.write_piece(first, packed(std::as_bytes(std::span(rows).subspan(first, 4)), 4));
    file.close();
  }
  const File file = File::open(aside);
  const Dataset there = file.root().open_dataset("rows");
  EXPECT_EQ(there.rows(), 10U);
  EXPECT_EQ(there.read_rows(2, 8), (std::vector<double>{2, 3, 4, 5, 6, 7, 8, -9}));
  EXPECT_EQ(there.read_rows(4, 0), std::vector<double>{});
  EXPECT_THROW(there.read_rows(8, 3), Error);
}

TEST(H5, AFileThatIsNotClosedIsGone) {
  const test::Scratch scratch("h5");
  { File::create_at(scratch / "aside.h5", scratch / "x.h5").root().make_in_pieces("rows", Type::real, 10, 4); }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
}

TEST(H5, TheSameContentGivesTheSameBytes) {
  const test::Scratch scratch("h5");
  for (const char* name : {"a.h5", "b.h5"}) {
    File file = File::create(scratch / name);
    Group group = file.root().make_group("group");
    group.put("scale", std::vector<double>{1, 2}).scale("scale");
    group.put("texts", std::vector<std::string>{"a", "b"}).attribute("text", "c");
    group.put("values", std::vector<double>{1, 2}).attach(0, group.open_dataset("scale")).describe("m", "what");
    file.finish();
    ::usleep(name[0] == 'a' ? 1100000 : 0);  // time stamps have a second
  }
  EXPECT_EQ(read_whole(scratch / "a.h5"), read_whole(scratch / "b.h5"));
}

TEST(H5, WhatIsNotFinishedLeavesNothing) {
  const test::Scratch scratch("h5");
  const fs::path old = scratch / "x.h5";
  std::ofstream(old) << "the old one";
  {
    File file = File::create(old);
    file.root().put("values", std::vector<double>(1000, 1.0));
  }
  EXPECT_EQ(read_whole(old), "the old one");
  fs::remove(old);
  EXPECT_TRUE(empty(scratch.folder()));
}

TEST(H5, WhatIsNoHdf5SaysSo) {
  const test::Scratch scratch("h5");
  std::ofstream(scratch / "text.h5") << "not at all";
  EXPECT_THAT(error_text(Exit::data, [&] { File::open(scratch / "text.h5"); }), HasSubstr("text.h5"));
  EXPECT_THAT(error_text(Exit::data, [&] { File::open(scratch.folder()); }), HasSubstr(scratch.folder().string()));
}

TEST(H5, AMissingFileSaysSo) {
  const test::Scratch scratch("h5");
  EXPECT_THAT(error_text(Exit::data, [&] { File::open(scratch / "none.h5"); }),
              AllOf(HasSubstr("none.h5"), HasSubstr("No such file")));
}

TEST(H5, AFileCutShortIsNoticed) {
  const test::Scratch scratch("h5");
  {
    File file = File::create(scratch / "x.h5");
    file.root().put("values", std::vector<double>(10000, 1.0));
    file.finish();
  }
  const std::string whole = read_whole(scratch / "x.h5");
  for (const std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{50}}) {
    std::ofstream(scratch / "cut.h5", std::ios::binary) << whole.substr(0, length);
    EXPECT_THAT(error_text(Exit::data, [&] { File::open(scratch / "cut.h5"); }), HasSubstr("cut.h5")) << length;
  }
}

// Numbers that lie there unpacked, the texts beside them, and everything that HDF5 goes by: each byte counts.
TEST(H5, AByteThatHasChangedIsNoticed) {
  const test::Scratch scratch("h5");
  {
    File file = File::create(scratch / "x.h5");
    file.root().put("values", std::vector<double>(20, 1.0)).describe("m", "what");
    file.finish();
  }
  const std::string whole = read_whole(scratch / "x.h5");
  std::fstream spoilt(scratch / "x.h5", std::ios::binary | std::ios::in | std::ios::out);
  std::size_t unnoticed = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    spoilt.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(whole[at] ^ 1)).flush();
    try {
      File::open(scratch / "x.h5");
      ++unnoticed;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::data);
      EXPECT_THAT(error.what(), AllOf(HasSubstr("x.h5"), HasSubstr("make it again")));
    }
    spoilt.seekp(static_cast<std::streamoff>(at)).put(whole[at]).flush();
  }
  EXPECT_EQ(unnoticed, 0U) << "of " << whole.size();
  EXPECT_NO_THROW(File::open(scratch / "x.h5"));
}

TEST(H5, AFileInPiecesIsClosedAlike) {
  const test::Scratch scratch("h5");
  {
    File file = File::create_at(scratch / "aside.h5", scratch / "x.h5");
    const std::vector<std::int32_t> rows{1, 2};
    file.root().make_in_pieces("rows", Type::integer, 2, 2).write_piece(0, packed(std::as_bytes(std::span(rows)), 4));
    file.close();
  }
  const std::string whole = read_whole(scratch / "aside.h5");
  EXPECT_EQ(whole.substr(whole.size() - closing_line("").size()),
            closing_line(std::string_view(whole).substr(0, whole.size() - closing_line("").size())));
  std::ofstream(scratch / "aside.h5", std::ios::binary | std::ios::app) << '\n';
  EXPECT_THAT(error_text(Exit::data, [&] { File::open(scratch / "aside.h5"); }),
              HasSubstr("does not end with the line"));
}

TEST(H5, WhatIsNotThereIsNamedWithTheFile) {
  const test::Scratch scratch("h5");
  {
    File file = File::create(scratch / "x.h5");
    file.root().attribute("number", 1.5);
    file.finish();
  }
  const Group root = File::open(scratch / "x.h5").root();
  EXPECT_THAT(error_text(Exit::data, [&] { root.open_dataset("nowhere"); }),
              AllOf(HasSubstr("x.h5"), HasSubstr("nowhere")));
  EXPECT_THAT(error_text(Exit::data, [&] { root.open_group("nowhere"); }),
              AllOf(HasSubstr("x.h5"), HasSubstr("nowhere")));
  EXPECT_THAT(error_text(Exit::data, [&] { root.text_attribute("none"); }),
              AllOf(HasSubstr("x.h5"), HasSubstr("none")));
  EXPECT_THAT(error_text(Exit::data, [&] { root.text_attribute("number"); }), HasSubstr("another type"));
}

void write_much(const fs::path& path) {
  File file = File::create(path);
  file.root().put("values", std::vector<double>(200000, 1.0));
  file.finish();
}

TEST(H5, AFileSizeLimitIsResumableAndLeavesNothing) {
  const test::Scratch scratch("h5");
  const auto told = test::with_file_size_limit(100000, [&] { write_much(scratch / "x.h5"); });
  EXPECT_EQ(told.exit, 74);
  EXPECT_THAT(told.text, AllOf(HasSubstr("x.h5"), HasSubstr("ulimit")));
  EXPECT_TRUE(empty(scratch.folder()));
}

TEST(H5, AFullDiskIsResumableAndLeavesNothing) {
  const test::Scratch scratch("h5");
  const test::SmallDisk disk(scratch / "disk", "256k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system here";
  EXPECT_THAT(error_text(Exit::cure, [&] { write_much(disk.folder() / "x.h5"); }),
              AllOf(HasSubstr("x.h5"), HasSubstr("No space left"), HasSubstr("free some space")));
  EXPECT_TRUE(empty(disk.folder()));
}

TEST(H5, NoWritePermissionSaysWhatToDo) {
  const test::Scratch scratch("h5");
  const auto told = test::without_rights(scratch.folder(), [&] { write_much(scratch / "x.h5"); });
  EXPECT_EQ(told.exit, 2);
  EXPECT_THAT(told.text, AllOf(HasSubstr("x.h5"), HasSubstr("Permission denied"), HasSubstr("choose a folder")));
}

}  // namespace
}  // namespace freestand::io::h5
