// A component for pelicun by hand, and the rules of its capacities.
#include "exports/csv_rows.hpp"
#include "made_results.hpp"

namespace freestand::exports::test::pelicun_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<File> files(const Model& model) { return find("pelicun").write(model, "fragility.csv"); }

Model discrete(const std::vector<double>& values) {
  fragility::Result result = without_curves();
  for (std::size_t b = 0; b < values.size(); ++b) set_surface(result.edps[1], b, values[b]);
  Request wanted = request({"overturned=falls"});
  return model("pelicun", wanted, result);
}

TEST(Pelicun, ALognormalGoesOutAsOne) {
  const auto written = files(model("pelicun", request({"peak_slip_m:0.05", "overturned"})));
  ASSERT_EQ(written.size(), 2u);
  EXPECT_EQ(written[0].text,
            "ID,Incomplete,Demand-Type,Demand-Unit,Demand-Offset,Demand-Directional,LS1-Family,LS1-Theta_0,LS1-Theta_1,"
            "LS1-DamageStateWeights,LS2-Family,LS2-Theta_0,LS2-Theta_1,LS2-DamageStateWeights\n"
            "fridge,0,Peak Floor Acceleration,g,0,1,lognormal,0.5,0.4,,lognormal,1.4,0.4,\n");
  EXPECT_EQ(written[1].name, "fragility.json");
  EXPECT_THAT(written[1].text,
              AllOf(HasSubstr("\"RoundUpToIntegerQuantity\": \"True\""), HasSubstr("overturned: overturned")));
}

TEST(Pelicun, AMultilinearCapacityRisesStrictlyFromZeroToOne) {
  // Zeroes but the last are left out, so is the middle of a plateau, and 1 is reached far away.
  EXPECT_THAT(files(discrete({0, 0, 0.1, 0.3, 0.6}))[0].text, HasSubstr(",\"0.3,0.6,1,1.6,1600000|0,0.1,0.3,0.6,1\","));
  EXPECT_THAT(files(discrete({0, 0.25, 0.25, 0.25, 0.6}))[0].text,
              HasSubstr(",\"0.1,0.3,1,1.6,1600000|0,0.25,0.250001,0.6,1\","));
  EXPECT_THAT(files(discrete({0, 0.25, 1, 1, 1}))[0].text, HasSubstr(",\"0.1,0.3,0.6|0,0.25,1\","));
  EXPECT_THAT(files(discrete({0.2, 0.25, 0.3, 0.4, 0.4}))[0].text,
              HasSubstr(",\"0,0.1,0.3,0.6,1,1.6,1600000|0,0.2,0.25,0.3,0.4,0.400001,1\","));
  // What is below 1e-7 is 0, what is next to 1 is 1; pelicun cannot tell 1e-9 from 0.
  EXPECT_THAT(files(discrete({1e-12, 1e-9, 0.5, 0.9999999, 1}))[0].text, HasSubstr(",\"0.3,0.6,1|0,0.5,1\","));
  EXPECT_THAT(files(discrete({0, 0.5, 0.999999, 0.999999, 1}))[0].text,
              HasSubstr(",\"0.1,0.3,0.6,1|0,0.5,0.999999,1\","));
  EXPECT_THAT(files(discrete({2e-7, 2.2e-7, 2.4e-7, 0.1, 0.2}))[0].text,
              HasSubstr(",\"0,0.1,0.6,1,1.6,1600000|0,2e-07,3e-07,0.1,0.2,1\","));
  // 0.1000001 is 0.1 in six digits.
  EXPECT_THAT(files(discrete({0, 0.1, 0.1000001, 0.3, 0.6}))[0].text,
              HasSubstr(",\"0.1,0.3,0.6,1,1.6,1600000|0,0.1,0.100001,0.3,0.6,1\","));
}

TEST(Pelicun, SaysFromWhereACurveIsBeyondTheSweep) {
  EXPECT_THAT(discrete({0, 0, 0.1, 0.3, 0.6}).notes,
              testing::Contains(HasSubstr("falls: from 1.6 g on the curve is beyond the sweep")));
  // A curve that reached 1 within the sweep ends there.
  EXPECT_THAT(discrete({0, 0.25, 1, 1, 1}).notes, testing::Not(testing::Contains(HasSubstr("beyond the sweep"))));
}

TEST(Pelicun, RefusesWhatItCannotHold) {
  const auto why = [](const Model& model) { return error_of([&] { find("pelicun").refuse(model); }); };
  Model bad = model("pelicun");
  bad.id = "E-20";
  EXPECT_THAT(why(bad), AllOf(HasSubstr("E-20"), HasSubstr("at every -")));
  EXPECT_THAT(why(discrete({0, 0, 0, 0, 0})), HasSubstr("falls never happened"));
  EXPECT_THAT(why(model("pelicun", request(), made_results(), {"housner_m", "m"})),
              HasSubstr("no demand for the intensity"));
}

const std::string head =
    "ID,Incomplete,Demand-Type,Demand-Unit,Demand-Offset,Demand-Directional,LS1-Family,LS1-Theta_0,LS1-Theta_1,"
    "LS1-DamageStateWeights\n";
const std::string words =
    R"({"_GeneralInformation": {"ShortName": "a", "Description": "a", "Version": "1", "ComponentGroups": []},
        "a": {"Description": "", "Comments": "", "SuggestedComponentBlockSize": "1 EA", "RoundUpToIntegerQuantity": "True",
        "LimitStates": {"LS1": {}}}})";

ReadBack read(const std::string& row, const std::string& json = words, const Intensity& im = pga) {
  const Folder folder;
  folder.write("fragility.json", json);
  return check_of("pelicun").open(folder.write("fragility.csv", head + row + "\n"), im);
}

TEST(PelicunCheck, TakesUnitsAndSixDigits) {
  const ReadBack velocity = read("a,0,Peak Floor Velocity,mps,0,1,lognormal,0.724,0.5,", words, {"pgv_mps", "m/s"});
  EXPECT_NEAR(velocity.probability(0, 0.724), 0.5, 1e-15);
  EXPECT_NEAR(velocity.probability(0, 0.724 * std::exp(0.5)), 0.8413447460685429, 1e-12);
  // 1 g and 2 g are 9.80665 and 19.6133 m/s^2, both six digits; 1.234567 is 1.23457 behind %g, times g 12.1069.
  const ReadBack levels = read("a,0,Peak Floor Acceleration,g,0,1,multilinear_CDF,\"1,2|0,1\",,");
  EXPECT_NEAR(levels.probability(0, 1.25), 0.25, 1e-12);
  EXPECT_EQ(levels.probability(0, 0.5), 0);
  EXPECT_EQ(levels.probability(0, 2.5), 1);
  const ReadBack rounded = read("a,0,Peak Floor Acceleration,mps2,0,1,multilinear_CDF,\"0,12.34567|0,1\",,");
  EXPECT_NEAR(rounded.probability(0, 1 / 9.80665), 1 / 12.3457, 1e-12);
  EXPECT_GE(rounded.rounds_by, 5e-6);
}

TEST(PelicunCheck, HoldsFilesToTheRules) {
  const std::string good = "a,0,Peak Floor Acceleration,g,0,1,multilinear_CDF,\"1,2,3|0,0.5,1\",,";
  EXPECT_EQ(error_of([&] { read(good); }), "");
  const auto why = [&](const std::string& old, const std::string& next) {
    return error_of([&] { read(edited(good, old, next)); });
  };
  EXPECT_THAT(why("|0,0.5", "|0.001,0.5"), HasSubstr("begins at exactly 0"));
  EXPECT_THAT(why("0.5,1", "0.5,0.9"), HasSubstr("ends at exactly 1"));
  EXPECT_THAT(why("0,0.5,1", "0,0.9999999,1"), HasSubstr("rise strictly"));
  EXPECT_THAT(why("1,2,3", "1,1.0000001,3"), HasSubstr("rise strictly"));
  EXPECT_THAT(why("0,0.5,1", "0,1"), HasSubstr("as many x as y"));
  EXPECT_THAT(why("a,0", "a-b,0"), HasSubstr("holds no -"));
  EXPECT_THAT(why(",0,1,", ",1,1,"), HasSubstr("own floor"));
  EXPECT_THAT(why(",g,", ",mps,"), HasSubstr("is the demand that was fitted"));
  EXPECT_THAT(why("\"1,2,3|0,0.5,1\"", "\"1,2,3|0,0.5,1"), HasSubstr("is no table"));
  EXPECT_THAT(error_of([&] { read(good, edited(words, "\"True\"", "true")); }), HasSubstr("is a text"));
  EXPECT_THAT(error_of([&] { read(good, edited(words, "\"Comments\"", "\"Author\"")); }), HasSubstr("these keys only"));
  EXPECT_THAT(error_of([&] { read(good, edited(words, "\"a\": {\"Desc", "\"b\": {\"Desc")); }),
              HasSubstr("words of this component"));
  EXPECT_THAT(error_of([&] { read(good, edited(words, "\"Version\"", "\"Edition\"")); }), HasSubstr("has Version"));
}

TEST(CsvTable, ReadsQuotedCells) {
  const Folder folder;
  EXPECT_THAT(csv_rows(folder.write("a.csv", "a,\"b,\"\"c\"\"\",\n1,,x\n")),
              ElementsAre(ElementsAre("a", "b,\"c\"", ""), ElementsAre("1", "", "x")));
  EXPECT_THAT(error_of([&] { CsvTable(folder.write("b.csv", "a,b\n1\n")); }), HasSubstr("a row of 1 cells"));
}

}  // namespace
}  // namespace freestand::exports::test::pelicun_test
