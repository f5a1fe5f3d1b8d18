#include "io/output_folder.hpp"

#include <fstream>
#include <set>

#include "base/durable_file.hpp"
#include "io/own_files.hpp"
#include "io/written_files.hpp"
#include "parallel/block_log.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"
#include "support/trouble.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;
using test::error_text;
using testing::AllOf;
using testing::HasSubstr;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

void put(const fs::path& path) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << (path.filename() == "surface.csv" ? "im,edp,capacity,probability\n" : "x");
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const test::Scratch scratch("out");
  prepare_output_folder(scratch / "a" / "b", Existing::refuse);
  EXPECT_TRUE(fs::is_directory(scratch / "a" / "b"));
  EXPECT_TRUE(fs::is_empty(scratch / "a" / "b"));
  prepare_output_folder(scratch / "a" / "b", Existing::refuse);
}

TEST(OutputFolder, WithSomethingInItIsRefused) {
  const test::Scratch scratch("out");
  put(scratch / "thesis.txt");
  EXPECT_THAT(error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), Existing::refuse); }),
              AllOf(HasSubstr(scratch.folder().string()), HasSubstr("not empty"), HasSubstr("--overwrite")));
  EXPECT_EQ(names_in(scratch.folder()), std::set<std::string>{"thesis.txt"});
}

TEST(OutputFolder, AnInterruptedSweepIsToldAsThat) {
  const test::Scratch scratch("out");
  const auto refused = [&] {
    return error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), Existing::refuse); });
  };
  put(scratch / begun_name);
  EXPECT_THAT(refused(), AllOf(HasSubstr("has finished nothing"), HasSubstr("--overwrite starts again")));
  parallel::BlockLog log(scratch / "blocks", "study");
  log.begin({});
  log.write(1, {1, {0.5}});
  EXPECT_THAT(refused(), HasSubstr("--resume goes on, --overwrite throws 1 finished block away"));
  log.write(7, {1, {0.5}});
  EXPECT_THAT(refused(), HasSubstr("--resume goes on, --overwrite throws 2 finished blocks away"));
  put(scratch / "samples.h5");  // to which samples were being added
  EXPECT_THAT(refused(), HasSubstr("--resume goes on, --overwrite throws 2 finished blocks away"));
  std::filesystem::remove_all(scratch / "blocks");
  std::filesystem::remove(scratch / begun_name);
  EXPECT_THAT(refused(),
              AllOf(HasSubstr("name another folder"), HasSubstr("--resume adds what the same study has more")));
}

TEST(OutputFolder, OverwriteRemovesResultsAndNothingElse) {
  const test::Scratch scratch("out");
  for (const char* name : {"surface.csv", ".samples.h5.part", "thesis.txt", "blocks/run-0001.node-000000.log"})
    put(scratch / name);
  prepare_output_folder(scratch.folder(), Existing::overwrite);
  EXPECT_EQ(names_in(scratch.folder()), std::set<std::string>{"thesis.txt"});
  put(scratch / "blocks/mine.txt");
  put(scratch / "blocks/run-0001.node-000000.log");
  prepare_output_folder(scratch.folder(), Existing::overwrite);
  EXPECT_EQ(names_in(scratch.folder()), (std::set<std::string>{"thesis.txt", "blocks", "blocks/mine.txt"}));
}

// Of whichever verb: beside the new results they would be taken for theirs.
TEST(OutputFolder, OverwriteLeavesNoResultOfAnEarlierRun) {
  const test::Scratch scratch("out");
  for (const char* name : {"ranking.csv", "risk.csv", "figure_4_1.csv", "words.json"})
    write_result(scratch / name, "only the list tells whose it is\n");
  for (const char* name : {"study.yaml", "fitted.yaml", "fitted_draws.csv", "case.yaml", "proposed_law.yaml"})
    write_text(scratch / name, signed_text("x: 1\n"));
  write_text(scratch / "fridge.xml", "<nrml/>\n");
  write_text(scratch / "lab.xml", "<nrml/>\n");
  write_text(scratch / "certificate.json",
             "{\n  \"format\": \"freestand-certificate/1\",\n  \"files\": {\"fridge.xml\": {\"hash\": \"" +
                 hash_text("<nrml/>\n") + "\"}, \"lab.xml\": {\"hash\": \"0123456789abcdef\"}}\n}\n");
  write_text(scratch / "dataset.yaml", signed_text("name: bench\n"));  // what was imported is no result
  put(scratch / "hazard.csv");
  fs::create_directory(scratch / "figures");
  for (const char* name : {"surface.svg", "mine.svg"}) write_result(scratch / "figures" / name, "<svg/>\n");
  write_text(scratch / "figures" / "mine.svg", "<svg>coloured</svg>\n");
  prepare_output_folder(scratch.folder(), Existing::overwrite);
  EXPECT_EQ(names_in(scratch.folder()),
            (std::set<std::string>{"dataset.yaml", "hazard.csv", "lab.xml", "figures", "figures/mine.svg"}));
}

TEST(OutputFolder, OverwriteRemovesNothingThatWasChanged) {
  const test::Scratch scratch("out");
  write_result(scratch / "bins.csv", "edp,unit,im\n1,2,3\n");
  write_result(scratch / "risk.csv", "annual_rate,annual_rate_lower\n");
  write_text(scratch / "study.yaml", signed_text("samples: 3\n"));
  for (const auto& [name, text] :
       {std::pair{"bins.csv", "edp,unit,im\n1,2,4\n"}, std::pair{"risk.csv", "annual_rate,annual_rate_lower\n1,2\n"},
        std::pair{"study.yaml", "# Written by freestand (0123456789abcdef). Changed ...\n"}}) {
    const std::string before = read_whole(scratch / name);
    write_text(scratch / name, text);
    const auto all = names_in(scratch.folder());
    EXPECT_THAT(error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), Existing::overwrite); }),
                AllOf(HasSubstr(name), HasSubstr("changed since")));
    EXPECT_EQ(names_in(scratch.folder()), all);
    write_text(scratch / name, before);
  }
  prepare_output_folder(scratch.folder(), Existing::overwrite);
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

TEST(OutputFolder, OverwriteRemovesNothingThatIsRead) {
  const test::Scratch scratch("out");
  write_text(scratch / "fitted.yaml", signed_text("x: 1\n"));
  write_result(scratch / "comparison.json", "{}\n");
  const std::vector<fs::path> reads = {scratch / "." / "fitted.yaml"};
  EXPECT_THAT(
      error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), Existing::overwrite, {.reads = reads}); }),
      HasSubstr("fitted.yaml is read"));
  EXPECT_TRUE(fs::exists(scratch / "comparison.json"));
  prepare_output_folder(scratch.folder(), Existing::overwrite, {.writes = {"fitted.yaml"}, .reads = reads});
  EXPECT_EQ(names_in(scratch.folder()), std::set<std::string>{"fitted.yaml"});
}

TEST(OutputFolder, OverwriteTakesNoDatabaseForAResult) {
  const test::Scratch scratch("out");
  put(scratch / "database.h5");
  EXPECT_THAT(error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), Existing::overwrite); }),
              HasSubstr("database of many entries"));
}

TEST(OutputFolder, OverwriteReplacesNoFileOfAnyoneElse) {
  const test::Scratch scratch("out");
  for (const char* name : {"summary.json", "study.yaml", "surface.csv"}) put(scratch / name);
  EXPECT_THAT(error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), Existing::overwrite); }),
              HasSubstr("summary.json would be replaced"));
  fs::remove(scratch / "summary.json");
  for (const Existing existing : {Existing::overwrite, Existing::resume})
    EXPECT_THAT(
        error_text(Exit::usage, [&] { prepare_output_folder(scratch.folder(), existing, {.writes = {"study.yaml"}}); }),
        HasSubstr("study.yaml would be replaced"));
  EXPECT_EQ(names_in(scratch.folder()), (std::set<std::string>{"study.yaml", "surface.csv"}));
}

TEST(OutputFolder, ResumeLeavesEverything) {
  const test::Scratch scratch("out");
  put(scratch / "blocks/run-0001.node-000000.log");
  put(scratch / "samples.h5");
  prepare_output_folder(scratch.folder(), Existing::resume);
  EXPECT_EQ(names_in(scratch.folder()),
            (std::set<std::string>{"blocks", "blocks/run-0001.node-000000.log", "samples.h5"}));
}

TEST(OutputFolder, AFileInItsPlaceIsRefused) {
  const test::Scratch scratch("out");
  put(scratch / "file");
  EXPECT_THAT(error_text(Exit::usage, [&] { prepare_output_folder(scratch / "file", Existing::overwrite); }),
              HasSubstr("it is a file"));
  EXPECT_THAT(error_text(Exit::usage, [&] { prepare_output_folder(scratch / "file" / "x", Existing::refuse); }),
              HasSubstr("Not a directory"));
}

TEST(OutputFolder, NoWritePermissionIsSaidBeforeTheWork) {
  const test::Scratch scratch("out");
  const auto inside =
      test::without_rights(scratch.folder(), [&] { prepare_output_folder(scratch.folder(), Existing::refuse); });
  EXPECT_EQ(inside.exit, 2);
  EXPECT_THAT(inside.text, AllOf(HasSubstr("Permission denied"), HasSubstr("choose a folder")));
  const auto making =
      test::without_rights(scratch.folder(), [&] { prepare_output_folder(scratch / "x", Existing::refuse); });
  EXPECT_EQ(making.exit, 2);
  EXPECT_THAT(making.text, HasSubstr("cannot make folder"));
}

TEST(OutputFolder, AFullDiskIsSaidBeforeTheWork) {
  const test::Scratch scratch("out");
  const test::SmallDisk disk(scratch / "disk", "16k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system here";
  std::ofstream(disk.folder() / "filler") << std::string(100000, 'x') << std::flush;
  EXPECT_THAT(error_text(Exit::cure, [&] { prepare_output_folder(disk.folder(), Existing::resume); }),
              HasSubstr("No space left"));
}

TEST(WriteText, ReplacesAWholeFile) {
  const test::Scratch scratch("out");
  write_text(scratch / "x.csv", "old\n");
  write_text(scratch / "x.csv", "new\n");
  EXPECT_EQ(read_whole(scratch / "x.csv"), "new\n");
  EXPECT_EQ(names_in(scratch.folder()), std::set<std::string>{"x.csv"});
  const auto told = test::with_file_size_limit(100, [&] { write_text(scratch / "x.csv", std::string(1000, 'z')); });
  EXPECT_EQ(told.exit, 74);
  EXPECT_EQ(read_whole(scratch / "x.csv"), "new\n");
  EXPECT_EQ(names_in(scratch.folder()), std::set<std::string>{"x.csv"});
}

}  // namespace
}  // namespace freestand::io
