#include "parallel/progress.hpp"

#include <gtest/gtest.h>

#include <string>

namespace freestand::parallel {
namespace {

std::string written(std::FILE* stream) {
  std::rewind(stream);
  std::string text;
  for (int c; (c = std::fgetc(stream)) != EOF;) text += static_cast<char>(c);
  return text;
}

Progress::Settings settings_for(std::FILE* stream, bool terminal) {
  Progress::Settings settings;
  settings.stream = stream;
  settings.terminal = terminal;
  return settings;
}

TEST(Progress, LineTellsSpeedAndTimeLeft) {
  EXPECT_EQ(progress_line({12288, 1511, 2}, 200000, 0, 8.0),
            "12,288/200,000 samples (6.1 %), 1,536/s, 2 min 2 s left, 12.3 % overturned, 2 failed");
}

TEST(Progress, WhatWasThereBeforeCountsNeitherForTheSpeedNorForTheShares) {
  EXPECT_EQ(progress_line({100, 5, 0}, 1000, 500, 10.0),
            "600/1,000 samples (60.0 %), 10/s, 40 s left, 5.0 % overturned, 0 failed");
}

TEST(Progress, ALogOnAFullDiskEndsNoRun) {
  std::FILE* full = std::fopen("/dev/full", "w");
  ASSERT_TRUE(full);
  std::setvbuf(full, nullptr, _IONBF, 0);
  {
    Progress progress(100, 0, settings_for(full, false));
    EXPECT_NO_THROW(progress.finish({100, 0, 0}));
  }
  std::fclose(full);
}

TEST(Progress, NothingDoneYetHasNoSpeed) {
  EXPECT_EQ(progress_line({}, 1000, 0, 0.0), "0/1,000 samples (0.0 %), 0.0 % overturned, 0 failed");
  EXPECT_EQ(progress_line({}, 0, 0, 1.0), "0/0 samples (0.0 %), 0.0 % overturned, 0 failed");
}

TEST(Progress, TheEndTellsHowLongItTook) {
  EXPECT_EQ(progress_line({1000, 0, 0}, 1000, 0, 4000.0),
            "1,000/1,000 samples (100.0 %), 0.25/s, took 1 h 6 min, 0.0 % overturned, 0 failed");
}

TEST(Progress, DurationsAreReadable) {
  EXPECT_EQ(duration_text(0), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 0 s");
  EXPECT_EQ(duration_text(3599), "59 min 59 s");
  EXPECT_EQ(duration_text(90061), "1 d 1 h");
}

TEST(Progress, OnATerminalTheLineIsRewritten) {
  std::FILE* stream = std::tmpfile();
  Progress::Settings settings = settings_for(stream, true);
  settings.terminal_interval_s = 0;
  {
    Progress progress(10, 0, settings);
    progress.show({5, 0, 0});
    progress.finish({10, 0, 0});
  }
  const std::string text = written(stream);
  std::fclose(stream);
  EXPECT_EQ(text.find("\r5/10 samples"), 0u) << text;
  EXPECT_NE(text.find("\x1b[K\r10/10 samples"), std::string::npos) << text;
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(text.find('\n'), text.size() - 1);
}

TEST(Progress, InALogNothingIsPrintedBeforeAMinuteButTheEnd) {
  std::FILE* stream = std::tmpfile();
  {
    Progress progress(10, 0, settings_for(stream, false));
    EXPECT_FALSE(progress.due());
    for (int i = 1; i < 10; ++i) progress.show({i, 0, 0});
    progress.finish({10, 0, 0});
  }
  const std::string text = written(stream);
  std::fclose(stream);
  EXPECT_EQ(text.find("10/10 samples"), 0u) << text;
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, AnAbandonedTerminalLineIsEnded) {
  std::FILE* stream = std::tmpfile();
  {
    Progress::Settings settings = settings_for(stream, true);
    settings.terminal_interval_s = 0;
    Progress progress(10, 0, settings);
    progress.show({5, 0, 0});
  }
  EXPECT_EQ(written(stream).back(), '\n');
  std::fclose(stream);
}

TEST(Progress, QuietSaysNothing) {
  std::FILE* stream = std::tmpfile();
  Progress::Settings settings = settings_for(stream, true);
  settings.quiet = true;
  {
    Progress progress(10, 0, settings);
    progress.finish({10, 0, 0});
  }
  EXPECT_EQ(written(stream), "");
  std::fclose(stream);
}

}  // namespace
}  // namespace freestand::parallel
