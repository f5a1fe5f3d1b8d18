#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/durable_file.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"
#include "support/trouble.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using nlohmann::json;
using test::error_text;
using testing::AllOf;
using testing::HasSubstr;

FolderLock::Settings quick() { return {.beat_s = 0.02, .silence_s = 0.3}; }

json lock_in(const fs::path& folder) { return json::parse(read_whole(folder / lock_name)); }
void put_lock(const fs::path& folder, const std::string& text) { std::ofstream(folder / lock_name) << text; }

// As another machine would have written it: its processes cannot be looked up here.
std::string lock_of_another_machine() {
  return json{{"format", "freestand-lock/1"},
              {"host", "node7"},
              {"process", 1234},
              {"process_started", "5"},
              {"process_table", "elsewhere"},
              {"job", "88"},
              {"since", "2026-01-31T12:00:00Z"},
              {"word", "0123456789abcdef"}}
      .dump();
}

// Ends as kill -9 does, with the lock in its hand.
void die_with_the_lock(const fs::path& folder) {
  test::in_child([] {},
                 [&] {
                   const FolderLock lock(folder);
                   ::_exit(0);
                 });
}

TEST(FolderLock, ASecondIsRefusedAndToldWhoHoldsIt) {
  const test::Scratch scratch("lock");
  ::setenv("SLURM_JOB_ID", "4711", 1);
  const FolderLock first(scratch.folder());
  ::unsetenv("SLURM_JOB_ID");
  EXPECT_THAT(error_text(Exit::usage, [&] { FolderLock second(scratch.folder()); }),
              AllOf(HasSubstr(scratch.folder().string()), HasSubstr("in use"), HasSubstr(std::to_string(::getpid())),
                    HasSubstr("job 4711"), HasSubstr("choose another folder")));
  EXPECT_NO_THROW(first.confirm());
}

TEST(FolderLock, IsGivenBackAtTheEndAndOnErrors) {
  const test::Scratch scratch("lock");
  { const FolderLock lock(scratch.folder()); }
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
  try {
    const FolderLock lock(scratch.folder());
    throw Error("trouble");
  } catch (const Error&) {
  }
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
  FolderLock lock(scratch.folder());
  lock.release();
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

// Whatever lies under the name of a lock is watched like one whose holder cannot be looked up.
TEST(FolderLock, WhatIsNoLockIsTakenOverAfterASilence) {
  for (const char* text :
       {"", "no JSON", "[1]", R"({"process_table": 5})", R"({"host": 5, "process": "many", "job": {}, "since": [1]})",
        R"({"host": "node7", "process": 1e300})", R"({"host": "node7", "process": -1, "process_table": null})"}) {
    const test::Scratch scratch("lock");
    put_lock(scratch.folder(), text);
    EXPECT_NO_THROW(FolderLock(scratch.folder(), quick())) << text;
  }
}

// As one of another user in a folder where everybody removes his own alone: it was tried for ever, without a word.
TEST(FolderLock, OneThatCannotBeRemovedIsTold) {
  const test::Scratch scratch("lock");
  fs::create_directory(scratch / lock_name);
  EXPECT_THAT(error_text(Exit::cure, [&] { FolderLock(scratch.folder(), quick()); }),
              AllOf(HasSubstr("cannot be removed here (Is a directory)"), HasSubstr("remove it")));
  fs::remove(scratch / lock_name);
  die_with_the_lock(scratch.folder());
  fs::create_directory(scratch / ".freestand.lock.taken_over.part");
  EXPECT_THAT(error_text(Exit::cure, [&] { FolderLock(scratch.folder(), quick()); }),
              HasSubstr("taken_over.part was left by a run that died and cannot be removed here"));
}

// Whoever died while it took a lock over keeps nobody out for longer than a holder may be silent, and leaves a file that others remove.
TEST(FolderLock, WhatATakerLeftKeepsNobodyOut) {
  const test::Scratch scratch("lock");
  die_with_the_lock(scratch.folder());
  const fs::path turn = scratch / ".freestand.lock.taken_over.part";
  std::ofstream(turn) << "";
  EXPECT_TRUE(is_aside_name(turn));
  EXPECT_NO_THROW(FolderLock(scratch.folder(), {.silence_s = 0.3}));
  EXPECT_FALSE(fs::exists(turn));
}

// As an entry of a catalogue does that is ended where it stands, within the lock of the catalogue.
TEST(FolderLock, AllOfAProcessAreGivenBackTogether) {
  const test::Scratch outer("lock"), inner("inner_lock");
  const FolderLock first(outer.folder());
  { const FolderLock gone(inner.folder()); }
  const FolderLock second(inner.folder());
  FolderLock::release_all();
  EXPECT_TRUE(fs::is_empty(outer.folder()));
  EXPECT_TRUE(fs::is_empty(inner.folder()));
}

TEST(FolderLock, OfAProcessThatIsGoneIsTakenOverAtOnce) {
  const test::Scratch scratch("lock");
  die_with_the_lock(scratch.folder());
  const auto start = std::chrono::steady_clock::now();
  const FolderLock lock(scratch.folder());
  EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);  // the silence would be 60 s
  EXPECT_EQ(lock_in(scratch.folder())["process"], ::getpid());
}

TEST(FolderLock, AProcessThatOnlyHasTheSameNumberDoesNotHoldIt) {
  const test::Scratch scratch("lock");
  json text;
  {
    const FolderLock lock(scratch.folder());
    text = lock_in(scratch.folder());
  }
  text["process_started"] = "1";  // this process did not start with the machine
  put_lock(scratch.folder(), text.dump());
  const FolderLock lock(scratch.folder());
  EXPECT_NE(lock_in(scratch.folder())["word"], text["word"]);
}

TEST(FolderLock, OfAnotherMachineIsTakenOverAfterASilence) {
  const test::Scratch scratch("lock");
  for (const std::string& text : {lock_of_another_machine(), std::string("half a lo"), std::string()}) {
    put_lock(scratch.folder(), text);
    const auto start = std::chrono::steady_clock::now();
    const FolderLock lock(scratch.folder(), quick());
    EXPECT_GE(std::chrono::steady_clock::now() - start, 300ms);
    EXPECT_NO_THROW(lock.confirm());
  }
}

TEST(FolderLock, OfAnotherMachineWhoseHeartBeatsIsRefused) {
  const test::Scratch scratch("lock");
  put_lock(scratch.folder(), lock_of_another_machine());
  std::atomic<bool> over = false;
  std::thread heart([&] {
    while (!over) {
      std::this_thread::sleep_for(50ms);
      fs::last_write_time(scratch / lock_name, fs::file_time_type::clock::now());
    }
  });
  EXPECT_THAT(error_text(Exit::usage, [&] { FolderLock lock(scratch.folder(), quick()); }),
              AllOf(HasSubstr("process 1234 on node7"), HasSubstr("job 88")));
  over = true;
  heart.join();
  EXPECT_TRUE(fs::exists(scratch / lock_name));
}

TEST(FolderLock, TheHolderTouchesIt) {
  const test::Scratch scratch("lock");
  const FolderLock lock(scratch.folder(), quick());
  const auto before = fs::last_write_time(scratch / lock_name);
  for (int tries = 0; tries < 500 && fs::last_write_time(scratch / lock_name) == before; ++tries)
    std::this_thread::sleep_for(10ms);
  EXPECT_GT(fs::last_write_time(scratch / lock_name), before);
}

TEST(FolderLock, AHolderThatSleptNoticesThatItLostIt) {
  const test::Scratch scratch("lock");
  std::atomic<bool> told = false;
  {
    auto settings = quick();
    settings.lost = [&] { told = true; };
    const FolderLock lock(scratch.folder(), settings);
    fs::remove(scratch / lock_name);
    put_lock(scratch.folder(), lock_of_another_machine());
    for (int tries = 0; tries < 500 && !told; ++tries) std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(told);
    EXPECT_THAT(error_text(Exit::usage, [&] { lock.confirm(); }), HasSubstr("node7"));
  }
  EXPECT_EQ(read_whole(scratch / lock_name), lock_of_another_machine());
}

// Processes that all find a dead holder, again and again, each dying with the lock: at no time do two hold it.
TEST(FolderLock, OfManyThatTakeOverOnlyOneGetsIt) {
  const test::Scratch scratch("lock");
  const fs::path inside = scratch / "inside";
  die_with_the_lock(scratch.folder());
  std::vector<pid_t> children;
  for (int child = 0; child < 8; ++child) {
    const pid_t number = ::fork();
    if (number != 0) {
      children.push_back(number);
      continue;
    }
    int held = 0;
    const auto start = std::chrono::steady_clock::now();
    while (held < 5 && std::chrono::steady_clock::now() - start < 20s) {
      try {
        const FolderLock lock(scratch.folder());
        const int marker = ::open(inside.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
        if (marker < 0) ::_exit(1);  // another is inside
        ::close(marker);
        ::usleep(1000);
        ::unlink(inside.c_str());
        if (++held == 5) ::_exit(0);  // dies with it
      } catch (const Error&) {
        ::usleep(500);
      }
    }
    ::_exit(2);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
}

TEST(FolderLock, OnAFullDiskNothingIsLeft) {
  const test::Scratch scratch("lock");
  const test::SmallDisk disk(scratch / "disk", "16k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system here";
  std::ofstream(disk.folder() / "filler") << std::string(100000, 'x') << std::flush;
  EXPECT_THAT(error_text(Exit::cure, [&] { FolderLock lock(disk.folder()); }), HasSubstr("No space left"));
  EXPECT_FALSE(fs::exists(disk.folder() / lock_name));
}

TEST(FolderLock, WithoutRightsOrFolderItSaysWhatToDo) {
  const test::Scratch scratch("lock");
  const auto told = test::without_rights(scratch.folder(), [&] { FolderLock lock(scratch.folder()); });
  EXPECT_EQ(told.exit, 2);
  EXPECT_THAT(told.text, HasSubstr("choose a folder"));
  EXPECT_THAT(error_text(Exit::usage, [&] { FolderLock lock(scratch / "none"); }), HasSubstr("check the path"));
}

}  // namespace
}  // namespace freestand::io
