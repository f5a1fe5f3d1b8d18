// The figure that a user goes by: it is small for what is written, and large for what was spoilt.
#include <algorithm>
#include <set>

#include "made_results.hpp"

namespace freestand::exports::test {
namespace {

using testing::HasSubstr;

struct Case {
  const char* format;
  std::optional<Form> form;
};

Model model_of(const Case& one, const fragility::Result& result = made_results()) {
  Request wanted = request();
  wanted.form = one.form;
  return model(one.format, wanted, result);
}

TEST(Certificate, EveryFormatInEveryFormIsReadAsItIsHeld) {
  for (const Format& format : all())
    for (const Form form : format.forms) {
      const Folder folder;
      const Model held = model_of({format.name.c_str(), form});
      const Certified certified = certify(held, format, folder.write(format.write(held, format.file)));
      EXPECT_LE(certified.difference, certified.allowed) << format.name;
      if (format.name != "pelicun" || form != Form::discrete) {  // which rounds
        EXPECT_LT(certified.difference, 1e-6) << format.name << " " << name(form);
      }
      EXPECT_EQ(certified.json["limit_states"].size(), held.states.size());
      EXPECT_EQ(certified.json["im_to"], 1.9);
      EXPECT_EQ(certified.json["limit_states"][0]["beyond_sweep_from"],
                form == Form::parts || format.table ? 1.6 : 1.9);
      // The table alone holds bands; of the others it is said.
      EXPECT_EQ(certified.json["bands_in_file"], format.name == "csv");
      EXPECT_EQ(certified.json["notes"].dump().find("best estimate alone") == std::string::npos, format.name == "csv")
          << format.name;
    }
}

// One digit of a number changed: the certificate must see it.
TEST(Certificate, SeesAChangedDigit) {
  struct Spoilt {
    Case of;
    const char *old, *next;
  };
  const std::vector<Spoilt> spoilt = {
      {{"openquake", Form::lognormal}, "mean=\"0.541643", "mean=\"0.541743"},
      {{"openquake", Form::discrete}, "0 0 0.1 0.3 0.6", "0 0 0.1001 0.3 0.6"},
      {{"openquake", Form::discrete}, ">0.1 0.3 0.6 1 1.6<", ">0.1 0.3 0.6001 1 1.6<"},
      {{"openquake-vulnerability", Form::discrete}, "0 0 0 0.1 0.3", "0 0 0 0.1 0.3001"},
      {{"pelicun", Form::lognormal}, "0.5,0.4", "0.5001,0.4"},
      {{"pelicun", Form::discrete}, "0.1,0.3,0.6,1\"", "0.1001,0.3,0.6,1\""},
      {{"incore", Form::lognormal}, "(-0.6931", "(-0.6932"},
      {{"incore", Form::parts}, "0.6, 1, 1.6], [1, 1, 0.5", "0.6, 1, 1.6], [1, 1, 0.5001"},
      {{"csv", Form::discrete}, "g,0.6,", "g,0.6001,"}};
  for (const Spoilt& one : spoilt) {
    const Folder folder;
    const Format& format = find(one.of.format);
    const Model held = model_of(one.of, one.of.form == Form::discrete ? without_curves() : made_results());
    std::vector<File> files = format.write(held, format.file);
    files.front().text = edited(files.front().text, one.old, one.next);
    // A rule that is broken is as good as a difference.
    const auto path = folder.write(files);
    Certified certified;
    const std::string why = error_of([&] { certified = certify(held, format, path); });
    EXPECT_TRUE(!why.empty() || certified.difference > 1e-6)
        << one.of.format << ": " << one.next << " " << certified.difference;
  }
}

TEST(Certificate, NoticesAMissingLimitStateAndANumberThatIsNone) {
  const Folder folder;
  const Format& csv = find("csv");
  Model held = model_of({"csv", {}});
  const auto path = folder.write(csv.write(held, "a.csv"));
  held.states[1].name = "another";
  EXPECT_THAT(error_of([&] { certify(held, csv, path); }), HasSubstr("lacks the limit state another"));
  held = model_of({"csv", {}});
  held.states[1].curve.points[2].probability = std::nan("");
  EXPECT_EQ(certify(held, csv, path).difference, 1);
}

TEST(Formats, EachHasItsFileAndItsCheck) {
  std::set<std::string> files, names, checked;
  for (const auto& entry : std::filesystem::directory_iterator(FREESTAND_SOURCE_DIR "/src/exports")) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".cpp" && stem.starts_with("check_")) files.insert(stem.substr(6));
  }
  for (const Format& format : all()) {
    std::string file = format.name;
    std::replace(file.begin(), file.end(), '-', '_');
    names.insert(file);
    EXPECT_TRUE(std::filesystem::exists(FREESTAND_SOURCE_DIR "/src/exports/" + file + ".cpp")) << file;
    EXPECT_EQ(check_of(format.name).name, format.name);
  }
  EXPECT_EQ(files, names);
  EXPECT_THAT(error_of([] { find("xls"); }), HasSubstr("csv, incore, openquake, openquake-vulnerability, pelicun"));
  EXPECT_THAT(error_of([] { check_of("xls"); }), HasSubstr("has no check"));
}

TEST(Csv, IsOnePlainTableOfAnyIntensity) {
  fragility::Result result = made_results();
  result.im_name = "report";
  result.im_unit = "1";
  result.im[0] = -0.2;
  set_surface(result.edps[1], 3, 0.05);  // falls, and stays so
  const Model held = model("csv", request({"overturned"}), result, {"report", "1"});
  const std::string text = find("csv").write(held, "a.csv").front().text;
  EXPECT_THAT(
      text,
      testing::StartsWith(
          "limit_state,demand,capacity,capacity_unit,im,im_unit,im_value,probability,lower,upper,counted,n,"
          "median,median_se,dispersion,dispersion_se,off_by,adequate\n"
          "overturned,overturned,,1,report,1,-0.2,0,-0.02,0.02,0,1000,1.4,0.013999999999999999,0.4,0.02,0.03,yes\n"));
  EXPECT_THAT(text, HasSubstr("report,1,1,0.05,"));
  const Folder folder;
  EXPECT_LT(certify(held, find("csv"), folder.write("a.csv", text)).difference, 1e-12);
}

}  // namespace
}  // namespace freestand::exports::test
