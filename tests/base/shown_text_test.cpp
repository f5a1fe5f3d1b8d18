// What a message shows of text out of a file.
#include "base/shown_text.hpp"

#include <gtest/gtest.h>

namespace freestand {
namespace {

TEST(ShownText, PrintableTextStaysAsItIs) {
  for (const char* text : {"", "slip_m", "Gerät 3 – μ", "C:\\x1b", "\xf0\x9f\x9a\x80"}) EXPECT_EQ(shown(text), text);
}

TEST(ShownText, ControlCharactersAreWrittenOut) {
  EXPECT_EQ(shown("\x1b[31mred\a"), "\\x1b[31mred\\x07");
  EXPECT_EQ(shown("a\nb\tc"), "a\\x0ab\\x09c");
  EXPECT_EQ(shown("\xc2\x9b"
                  "31m"),
            "\\xc2\\x9b31m");  // the same as ESC [ to a terminal
  EXPECT_EQ(shown("\xe2\x80\xae"
                  "cba"),
            "\\xe2\\x80\\xae"
            "cba");  // turns the direction of what follows
  EXPECT_EQ(shown(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
}

// Cut short, overlong, a surrogate, beyond the last code point, no lead byte.
TEST(ShownText, BytesThatAreNoUtf8AreWrittenOut) {
  EXPECT_EQ(shown("a\xe2\x82"), "a\\xe2\\x82");
  EXPECT_EQ(shown("\xc0\xaf"), "\\xc0\\xaf");
  EXPECT_EQ(shown("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(shown("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(shown("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(shown("\x89PNG"), "\\x89PNG");
}

TEST(ShownText, LongTextIsCutBetweenCharacters) {
  EXPECT_EQ(shown("abcdef", 6), "abcdef");
  EXPECT_EQ(shown("abcdef", 5), "abcde...");
  EXPECT_EQ(shown("μμμ", 2), "μμ...");
  EXPECT_EQ(shown(std::string(1000000, '\x01')).size(), 4 * longest_shown + 3);
}

TEST(ShownText, AMessageKeepsItsLinesAndIsNotEscapedTwice) {
  const std::string once = printable("one\x1b\ntwo", Lines::keep);
  EXPECT_EQ(once, "one\\x1b\ntwo");
  EXPECT_EQ(printable(once, Lines::keep), once);
}

}  // namespace
}  // namespace freestand
