#include "io/provenance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::io {
namespace {

TEST(Provenance, TellsVersionsHostAndTime) {
  const Provenance here = provenance_here("freestand run x.yaml -o out", 3);
  EXPECT_THAT(here.version, testing::MatchesRegex(R"([0-9]+\.[0-9]+\.[0-9]+)"));
  EXPECT_THAT(here.git_commit, testing::MatchesRegex("(unknown|[0-9a-f]{7,40}(-dirty)?)"));
  EXPECT_THAT(here.created_utc, testing::MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z"));
  EXPECT_FALSE(here.compiler.empty());
  EXPECT_FALSE(here.host.empty());
  EXPECT_EQ(here.ranks, 3);
  const auto libraries = nlohmann::json::parse(here.libraries);
  for (const char* name : {"MPI", "HDF5", "SUNDIALS", "GSL", "FFTW", "Eigen"}) {
    ASSERT_TRUE(libraries.contains(name)) << name;
    EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(libraries[name].get<std::string>().back()))) << name;
  }
}

TEST(Provenance, ComesBackFromAFile) {
  const test::Scratch scratch("provenance");
  Provenance from = provenance_here("freestand run", 5);
  from.study = "seed: 1\n";
  from.study_name = "x";
  from.seed = 0xfedcba9876543210u;  // more than a signed word holds
  from.samples = 12;
  {
    h5::File file = h5::File::create(scratch / "x.h5");
    h5::Group root = file.root();
    write_provenance(root, "some/1", from);
    file.finish();
  }
  const Provenance back = read_provenance(h5::File::open(scratch / "x.h5").root(), "some/1");
  EXPECT_EQ(back.version, from.version);
  EXPECT_EQ(back.git_commit, from.git_commit);
  EXPECT_EQ(back.compiler, from.compiler);
  EXPECT_EQ(back.libraries, from.libraries);
  EXPECT_EQ(back.host, from.host);
  EXPECT_EQ(back.created_utc, from.created_utc);
  EXPECT_EQ(back.command, from.command);
  EXPECT_EQ(back.ranks, 5);
  EXPECT_EQ(back.study, from.study);
  EXPECT_EQ(back.study_name, from.study_name);
  EXPECT_EQ(back.seed, from.seed);
  EXPECT_EQ(back.samples, 12);
  EXPECT_THROW(read_provenance(h5::File::open(scratch / "x.h5").root(), "some/2"), Error);
}

TEST(CommandLine, QuotesWhatAShellWouldTakeApart) {
  const char* argv[] = {"freestand", "run", "my study.yaml", "it's", "", "records/*.AT2", "-o", "out"};
  EXPECT_EQ(command_line(8, argv), R"(freestand run 'my study.yaml' 'it'\''s' '' 'records/*.AT2' -o out)");
}

}  // namespace
}  // namespace freestand::io
