// A fragility set for IN-CORE by hand, and its rules.
#include "made_results.hpp"

namespace freestand::exports::test::incore_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string text(const Model& model) { return find("incore").write(model, "a.json").front().text; }

ReadBack read(const std::string& json, const Intensity& im = pga) {
  const Folder folder;
  return check_of("incore").open(folder.write("a.json", json), im);
}

TEST(InCore, SaysEachFormInItsOwnWords) {
  EXPECT_THAT(text(model("incore")),
              AllOf(HasSubstr("\"scipy.stats.norm.cdf((math.log(PGA) - (-0.6931471805599453)) / (0.4))\""),
                    HasSubstr("\"PGA > 0\""), HasSubstr("\"inventoryType\": \"building\"")));
  Request wanted = request();
  wanted.form = Form::discrete;
  EXPECT_THAT(text(model("incore", wanted, without_curves())),
              HasSubstr("\"numpy.interp(PGA, [0, 0.1, 0.3, 0.6, 1, 1.6], [0, 0, 0, 0.1, 0.3, 0.6])\""));
  const std::string over = "numpy.interp(PGA, [0, 0.1, 0.3, 0.6, 1, 1.6], [0, 0, 0, 0.1, 0.3, 0.6])";
  wanted.form = Form::parts;
  EXPECT_THAT(text(model("incore", wanted)),
              HasSubstr(over + " + (1 - " + over +
                        ") * (1 - numpy.interp(PGA, [0, 0.1, 0.3, 0.6, 1, 1.6], [1, 1, 0.5, 0.1, "
                        "0, 0])) * scipy.stats.norm.cdf((numpy.interp(PGA, "));
}

TEST(InCore, VelocityIsInCentimetresPerSecond) {
  fragility::Result result = made_results();
  result.im_name = "pgv_mps";
  result.im_unit = "m/s";
  const std::string json = text(model("incore", request(), result, {"pgv_mps", "m/s"}));
  EXPECT_THAT(json, AllOf(HasSubstr("\"cm/s\""), HasSubstr("math.log(PGV) - (3.912023005428146)")));
  EXPECT_NEAR(read(json, {"pgv_mps", "m/s"}).probability(0, 0.5), 0.5, 1e-10);
  EXPECT_THAT(text(model("incore", request(), made_results(), {"sa_g", "g", 0.2})),
              HasSubstr("\"fullName\": \"0.2 SA\""));
}

TEST(InCore, WantsAsManyLimitStatesAsItsInventoryHas) {
  const auto why = [](const std::vector<std::string>& states, const std::string& category) {
    Request wanted = request(states);
    wanted.asset_category = category;
    return error_of([&] { find("incore").refuse(model("incore", wanted)); });
  };
  EXPECT_EQ(why({}, "building"), "");
  EXPECT_THAT(why({"peak_slip_m", "overturned", "overturned=again"}, ""),
              AllOf(HasSubstr("exactly 3 limit states for a building"), HasSubstr("these are 4")));
  EXPECT_THAT(why({}, "electric_facility"),
              AllOf(HasSubstr("exactly 4 limit states for an electric_facility"), HasSubstr("these are 3")));
  EXPECT_THAT(why({"overturned"}, "building"), AllOf(HasSubstr("exactly 3"), HasSubstr("overturned=again")));
  // Of more than are wanted the last one stays: nothing is more severe than to fall over.
  EXPECT_THAT(
      why({"peak_slip_m:0.05", "peak_slip_m:0.05=b", "peak_slip_m:0.2", "overturned"}, "building"),
      AllOf(HasSubstr("these are 4"),
            HasSubstr("--limit-state peak_slip_m:0.05 --limit-state peak_slip_m:0.05 --limit-state overturned)")));
  EXPECT_THAT(why({}, "fridge"), AllOf(HasSubstr("no inventory fridge"), HasSubstr("electric_facility 4")));
}

// Rules of a user's file.
std::string set_of(const std::string& rules) {
  const std::string curve =
      R"j({"description": "a", "returnType": {"type": "Limit State", "unit": "", "description": "LS_0"}, "rules": [)j" +
      rules + "]}";
  return R"j({"demandTypes": ["PGA"], "demandUnits": ["g"], "resultType": "Limit State", "hazardType": "earthquake",
    "inventoryType": "building", "curveParameters": [{"name": "PGA", "unit": "g", "fullName": "PGA", "expression": null}],
    "fragilityCurves": [)j" +
         curve + "," + curve + "," + curve + "]}";
}

TEST(InCoreCheck, GoesThroughRulesInOrderAndRounds) {
  const std::string guarded =
      R"j({"condition": ["PGA > 0"], "expression": "scipy.stats.norm.cdf((math.log(PGA) - (0)) / (0.5))"})j";
  const std::string otherwise = R"j({"condition": null, "expression": "0"})j";
  const ReadBack back = read(set_of(guarded + "," + otherwise));
  EXPECT_EQ(back.probability(0, 1), 0.5);
  EXPECT_EQ(back.probability(0, 0), 0);
  EXPECT_EQ(back.probability(0, std::exp(0.5)), 0.8413447461);  // ten digits
  // The rule without condition does not end the search: in front it gives way to what comes behind it.
  EXPECT_EQ(read(set_of(R"j({"condition": null, "expression": "0.25"},)j" + guarded)).probability(0, 1), 0.5);
  EXPECT_EQ(read(set_of(R"j({"expression": "2^2/16"})j")).probability(0, 1), 0.25);
  EXPECT_NEAR(read(set_of(R"j({"expression": "numpy.interp(PGA, [0, 1, 3], [0, 0.5, 0.6])"})j")).probability(0, 2),
              0.55, 1e-12);
}

TEST(InCoreCheck, HoldsFilesToTheRules) {
  const std::string good = set_of(R"j({"expression": "0"})j");
  const auto why = [&](const std::string& old, const std::string& next) {
    return error_of([&] { read(edited(good, old, next)); });
  };
  EXPECT_THAT(why("[\"g\"]", "[\"mps2\"]"), HasSubstr("PGA in mps2"));
  EXPECT_THAT(why("building", "bridge"), HasSubstr("this inventory has 4 curves"));
  EXPECT_THAT(why("\"hazardType\": \"earthquake\",", ""), HasSubstr("it has hazardType"));
  EXPECT_THAT(why("\"0\"", "\"math.sinus(PGA)\""), HasSubstr("is not what IN-CORE reads"));
  EXPECT_THAT(why("{\"demandTypes\"", "[\"demandTypes\""), HasSubstr("is not what IN-CORE reads"));
}

}  // namespace
}  // namespace freestand::exports::test::incore_test
