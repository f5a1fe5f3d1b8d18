// Files of the project, cut short and with bytes changed, and those of corpus/: read, or refused in words.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "motion/record.hpp"
#include "spoilt_files/target.hpp"
#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::spoilt_files {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// (target, file) of seeds.txt, of what is there.
std::vector<std::pair<std::string, std::filesystem::path>> seeds() {
  std::vector<std::pair<std::string, std::filesystem::path>> all;
  std::ifstream in(std::filesystem::path(FREESTAND_SOURCE_DIR) / "tests/spoilt_files/seeds.txt");
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    const std::string glob = line.substr(space + 1);
    if (line.starts_with('#')) continue;
    for (const auto& file : motion::expand_glob(glob, FREESTAND_SOURCE_DIR))
      all.emplace_back(line.substr(0, space), file);
  }
  return all;
}

TEST(Corpus, FilesThatWereOnceWrongAreReadOrRefused) {
  int files = 0;
  for (const Target& target : targets()) {
    const std::filesystem::path folder =
        std::filesystem::path(FREESTAND_SOURCE_DIR) / "tests/spoilt_files/corpus" / target.name;
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      EXPECT_NO_THROW(target.take(content(entry.path()))) << target.name << ' ' << entry.path();
      ++files;
    }
  }
  EXPECT_GT(files, 0);
}

TEST(Corpus, SpoiltFilesOfTheProjectAreReadOrRefused) {
  std::uint64_t key = 0;
  for (const auto& [name, seed] : seeds()) {
    const Target& target = spoilt_files::target(name);
    const std::string whole = content(seed).substr(0, 4000);
    EXPECT_NO_THROW(target.take(whole)) << target.name << ' ' << seed;
    for (int i = 0; i < 20; ++i) {
      test::KeyedRandom random(7, ++key);
      const auto place = [&](std::size_t end) {
        return static_cast<std::size_t>(random.unit() * static_cast<double>(end));
      };
      std::string spoilt = whole.substr(0, 1 + place(whole.size()));
      for (int k = 0; k < 3; ++k) spoilt[place(spoilt.size())] = static_cast<char>(place(256));
      EXPECT_NO_THROW(target.take(spoilt)) << target.name << ' ' << seed << ", change " << key;
    }
  }
}

std::string drawn_edits(std::uint64_t key) {
  test::KeyedRandom random(8, key);
  std::string edits(1 + static_cast<std::size_t>(random.unit() * 60), '\0');
  for (char& byte : edits) byte = static_cast<char>(random.unit() * 256);
  return edits;
}

// Of every result file. FREESTAND_REPEATS for more.
TEST(Corpus, EditedResultFilesAreReadOrRefused) {
  std::uint64_t key = 0;
  for (const Target& target : edited_targets())
    for (int i = 0; i < test::repeats_asked(40); ++i) EXPECT_NO_THROW(target.take(drawn_edits(++key))) << target.name << ", edits " << key;
}

// A capacity and an intensity that are no number were taken.
TEST(Corpus, EditsThatWereOnceTakenAreRefused) {
  const auto targets = edited_targets();
  const auto fragility = std::find_if(targets.begin(), targets.end(), [](const Target& target) {
    return std::string_view(target.name) == "edited_fragility";
  });
  ASSERT_NE(fragility, targets.end());
  for (const std::uint64_t key : {111, 145}) EXPECT_NO_THROW(fragility->take(drawn_edits(key))) << key;
}

// Nothing, lines without end, and what begins as HDF5 and is none.
TEST(Corpus, FilesOfNoKindAreReadOrRefused) {
  const std::string none[] = {"",
                              "\n",
                              std::string(100'000, ','),
                              std::string(5'000, '['),
                              std::string(64, '\0'),
                              std::string("\x89HDF\r\n\x1a\n", 8) + std::string(4'000, '\0')};
  for (const Target& target : targets())
    for (const std::string& bytes : none) EXPECT_NO_THROW(target.take(bytes)) << target.name << ' ' << bytes.size();
}

}  // namespace
}  // namespace freestand::spoilt_files
