// freestand knows its own files by their content, and takes no others for them.
#include "io/own_files.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/durable_file.hpp"
#include "io/fragility_file.hpp"
#include "io/h5.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class OwnFiles : public testing::Test {
 protected:
  bool own(const std::string& name, const std::string& text) const {
    write_durably(folder_ / name, text);
    return is_own(folder_ / name);
  }
  test::Scratch folder_{"own"};
};

TEST_F(OwnFiles, SignedTextIsOwnUntilItChanges) {
  const std::string text = signed_text("samples: 3\nseed: 1\n");
  EXPECT_THAT(text, HasSubstr("\nsamples: 3\nseed: 1\n"));
  EXPECT_TRUE(own("study.yaml", text));
  EXPECT_TRUE(own("any.name", text));
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = changed[i] == 'x' ? 'y' : 'x';
    EXPECT_FALSE(own("study.yaml", changed)) << i;
  }
  EXPECT_FALSE(own("study.yaml", text + "# mine\n"));
  EXPECT_FALSE(own("study.yaml", text.substr(0, text.find('\n'))));
  EXPECT_FALSE(own("study.yaml", "samples: 3\n"));
  EXPECT_FALSE(own("study.yaml", ""));
}

TEST_F(OwnFiles, ResultsByTheirFormat) {
  h5::File file = h5::File::create(folder_ / "samples.h5");
  file.root().attribute("format", "freestand-samples/1");
  file.finish();
  EXPECT_TRUE(is_own(folder_ / "samples.h5"));
  h5::File other = h5::File::create(folder_ / "other.h5");
  other.finish();
  EXPECT_FALSE(is_own(folder_ / "other.h5"));
  EXPECT_FALSE(own("text.h5", "no HDF5"));
  EXPECT_TRUE(own("summary.json", "{\n  \"format\": \"freestand-summary/1\"\n}\n"));
  EXPECT_FALSE(own("summary.json", "{\"mine\": 1}\n"));
  EXPECT_TRUE(own("bins.csv", bins_csv({})));
  EXPECT_TRUE(own("surface.csv", surface_csv({})));
  EXPECT_TRUE(own("history.csv", history_csv({}, {}, 1)));
  EXPECT_TRUE(own("summary.json", json_text(response_summary({}))));
  EXPECT_FALSE(own("history.csv", "time_s,floor_acceleration_mps2\n"));
  EXPECT_TRUE(own("report.html", "<!DOCTYPE html>\n<meta name=\"generator\" content=\"freestand\">\n"));
  EXPECT_FALSE(own("report.html", "<!DOCTYPE html>\n"));
  EXPECT_FALSE(is_own(folder_.folder()));
}

// FNV-1a, 64 bits, as published.
TEST(HashText, IsTheOneThatPicturesAreListedBy) {
  EXPECT_EQ(hash_text("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(hash_text("foobar"), "85944171f73967e8");
}

// A table that was changed has the header of a result still.
TEST_F(OwnFiles, TablesAsTheyWereWritten) {
  const std::string table = bins_csv({}) + "1,2\n";
  for (const char* name : {"bins.csv", "summary.json", "any.csv"}) {
    write_result(folder_ / name, table);
    write_result(folder_ / name, table + "3,4\n");
    EXPECT_TRUE(is_own(folder_ / name));
    EXPECT_TRUE(own(name, table));  // as before: the run was killed when it had listed what it would write
    EXPECT_FALSE(was_changed(folder_ / name));
    EXPECT_FALSE(own(name, table + "3,5\n"));
    EXPECT_TRUE(was_changed(folder_ / name));
  }
  write_result(folder_ / "any.csv", table);  // by order of the user, say
  EXPECT_TRUE(is_own(folder_ / "any.csv"));
  EXPECT_FALSE(own("any.csv", table + "3,4\n"));  // that one is long gone
}

TEST_F(OwnFiles, OthersAreRefusedByName) {
  own("study.yaml", "samples: 3\n");
  own("summary.json", "{}\n");
  own("case.yaml", signed_text("x: 1\n"));
  std::filesystem::create_symlink("nowhere", folder_ / "bins.csv");
  EXPECT_THAT(
      test::error_text(
          Exit::usage,
          [&] {
            refuse_others(folder_.folder(), {"study.yaml", "summary.json", "case.yaml", "bins.csv", "none.csv"});
          }),
      AllOf(HasSubstr("study.yaml"), HasSubstr("summary.json"), HasSubstr("bins.csv"), Not(HasSubstr("case.yaml")),
            Not(HasSubstr("none.csv"))));
  refuse_others(folder_.folder(), {"case.yaml", "none.csv"});
}

}  // namespace
}  // namespace freestand::io
