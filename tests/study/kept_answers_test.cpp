// A computation that goes on from what its jobs have answered before.
#include "study/kept_answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "study/spread_jobs.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::kept_answers_test {
namespace {

using Answers = std::vector<std::vector<double>>;

// Two calls of three jobs each, the second with what the first has answered. `ends_after`: the machine dies in the job after so many.
struct Work {
  int done = 0;
  Answers run(const std::filesystem::path& folder, const std::string& from, int ends_after) {
    const parallel::Communicator alone;
    const Jobs jobs = spread_jobs(alone, true, {}, std::make_shared<KeptAnswers>(alone, folder, from));
    const auto job = [&](double base) {
      return [&, base](std::size_t i) {
        if (done == ends_after) throw std::runtime_error("killed");
        ++done;
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
        return i == 1 ? std::vector<double>{} : std::vector<double>{base + 0.1 * static_cast<double>(i), 1.0 / 3};
      };
    };
    const Answers first = jobs("first", 3, job(1));
    return jobs("second", 3, job(first[2][0]));
  }
};

TEST(KeptAnswers, AreNotFoundAgain) {
  const freestand::test::Scratch scratch("kept_answers");
  Work whole, killed, resumed;
  const Answers expected = whole.run(scratch / "a", "study", -1);
  ASSERT_EQ(whole.done, 6);
  EXPECT_THROW(killed.run(scratch / "b", "study", 4), std::runtime_error);
  EXPECT_EQ(resumed.run(scratch / "b", "study", -1), expected);
  EXPECT_EQ(resumed.done, 2);
}

TEST(KeptAnswers, OfAnotherStudyAreRefused) {
  const freestand::test::Scratch scratch("kept_answers");
  Work killed;
  EXPECT_THROW(killed.run(scratch / "a", "study", 4), std::runtime_error);
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { Work().run(scratch / "a", "another", -1); }),
              testing::HasSubstr("another study"));
}

// What is lost or spoilt is found again.
TEST(KeptAnswers, WhatIsDamagedIsFoundAgain) {
  const freestand::test::Scratch scratch("kept_answers");
  Work killed, resumed;
  EXPECT_THROW(killed.run(scratch / "a", "study", 5), std::runtime_error);
  for (const auto& file : std::filesystem::directory_iterator(scratch / "a"))
    std::filesystem::resize_file(file.path(), 2 * 4096);
  EXPECT_EQ(resumed.run(scratch / "a", "study", -1), Work().run(scratch / "b", "study", -1));
  EXPECT_EQ(resumed.done, 4);
}

}  // namespace
}  // namespace freestand::study::kept_answers_test
