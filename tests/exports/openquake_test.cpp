// NRML by hand: what is written, what OpenQuake makes of it, which rules are held.
#include "made_results.hpp"

namespace freestand::exports::test::openquake_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string text(const Model& model) { return find("openquake").write(model, "a.xml").front().text; }

TEST(OpenQuake, ContinuousHasTheMomentsOfTheLognormal) {
  const std::string xml = text(model("openquake", request({"peak_slip_m:0.05=slips"})));
  // 0.5 exp(0.4^2/2) and that times sqrt(exp(0.4^2) - 1)
  EXPECT_THAT(xml, HasSubstr("<params ls=\"slips\" mean=\"0.5416435338374793\" stddev=\"0.225619643063357"));
  EXPECT_THAT(xml, AllOf(HasSubstr("maxIML=\"1.9\""), HasSubstr("imt=\"PGA\""), HasSubstr("shape=\"logncdf\""),
                         HasSubstr("lossCategory=\"contents\""), HasSubstr("&lt;of a laboratory&gt; &amp; more")));
}

TEST(OpenQuake, DiscreteHasTheBinsAsLevels) {
  Request wanted = request({"overturned=falls"});
  wanted.form = Form::discrete;
  EXPECT_EQ(text(model("openquake", wanted, without_curves())),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n"
            "  <fragilityModel id=\"fridge\" assetCategory=\"buildings\" lossCategory=\"contents\">\n"
            "    <description>a refrigerator &lt;of a laboratory&gt; &amp; more</description>\n"
            "    <limitStates>falls</limitStates>\n"
            "    <fragilityFunction id=\"fridge\" format=\"discrete\">\n"
            "      <imls imt=\"PGA\" noDamageLimit=\"1e-10\">0.1 0.3 0.6 1 1.6</imls>\n"
            "      <poes ls=\"falls\">0 0 0.1 0.3 0.6</poes>\n"
            "    </fragilityFunction>\n"
            "  </fragilityModel>\n"
            "</nrml>\n");
}

TEST(OpenQuake, VelocityGoesOutInCentimetresPerSecondAndSpectraByPeriod) {
  fragility::Result result = made_results();
  result.im_name = "pgv_mps";
  result.im_unit = "m/s";
  const std::string xml = text(model("openquake", request(), result, {"pgv_mps", "m/s"}));
  EXPECT_THAT(xml,
              AllOf(HasSubstr("imt=\"PGV\""), HasSubstr("maxIML=\"190\""), HasSubstr("mean=\"54.16435338374793\"")));
  EXPECT_THAT(text(model("openquake", request(), made_results(), {"sa_g", "g", 1.0})), HasSubstr("imt=\"SA(1.0)\""));
}

// Equipment on an upper storey: the ground's intensity stands in the table of records.
TEST(OpenQuake, IntensitiesOfTheGroundFromATableGoOutAsTheGroundIs) {
  for (const auto& [im, name] : {std::pair(Intensity{"record.pga_g", "g"}, "imt=\"PGA\""),
                                 std::pair(Intensity{"record.pgv_mps", "m/s"}, "imt=\"PGV\""),
                                 std::pair(Intensity{"record.pgd_m", "m"}, "imt=\"PGD\""),
                                 std::pair(Intensity{"record.sa_g", "g", 0.5}, "imt=\"SA(0.5)\"")}) {
    const Model made = model("openquake", request(), made_results(), im);
    EXPECT_THAT(text(made), HasSubstr(name));
    EXPECT_THAT(made.notes, testing::Contains(HasSubstr("what the table of records gives")));
  }
  const Model under = model("openquake", request(), made_results(), Intensity{"ground.sa_g", "g", 0.5});
  EXPECT_THAT(text(under), HasSubstr("imt=\"SA(0.5)\""));
  EXPECT_THAT(under.notes, testing::Contains(HasSubstr("of the ground under the building")));
  const auto refusal = [](const Intensity& im) {
    try {
      text(model("openquake", request(), made_results(), im));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal({"record.sa_g", "g"}), HasSubstr("add --period"));
  EXPECT_THAT(refusal({"record.magnitude_mw", "1"}), HasSubstr("record.pga_g"));
  EXPECT_THAT(refusal({"pga_g", "g", unknown, true}), HasSubstr("fit the sweep over ground.pga_g"));
  EXPECT_THAT(refusal({"ground.housner_m", "m"}), HasSubstr("no name for the intensity ground.housner_m"));
}

// The very text of a user's file, read by the check, with values from tables of the normal distribution.
const std::string continuous = R"(<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <fragilityModel id="m" assetCategory="buildings" lossCategory="contents">
    <description>d</description>
    <limitStates>a b</limitStates>
    <fragilityFunction id="f" format="continuous" shape="logncdf">
      <imls imt="PGA" noDamageLimit="0.1" minIML="0.1" maxIML="2.0"/>
      <params ls="a" mean="1.0" stddev="1.3108324944320861"/>
      <params ls="b" mean="2.0" stddev="2.6216649888641722"/>
    </fragilityFunction>
  </fragilityModel>
</nrml>)";
const std::string discrete = R"(<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <fragilityModel id="m" assetCategory="buildings" lossCategory="contents">
    <description>d</description>
    <limitStates>a b</limitStates>
    <fragilityFunction id="f" format="discrete">
      <imls imt="PGA" noDamageLimit="0.1">0.2 0.6 1.0</imls>
      <poes ls="a">0.1 0.5 0.9</poes>
      <poes ls="b">0 0.2 0.4</poes>
    </fragilityFunction>
  </fragilityModel>
</nrml>)";

ReadBack read(const std::string& xml, const Intensity& im = pga) {
  const Folder folder;
  return check_of("openquake").open(folder.write("a.xml", xml), im);
}

TEST(OpenQuakeCheck, ClampsAndZeroesAsOpenQuakeDoes) {
  // stddev^2/mean^2 + 1 = e gives sigma 1; the median is mean/sqrt(e).
  const ReadBack back = read(continuous);
  const double median = std::exp(-0.5);
  EXPECT_NEAR(back.probability(0, median), 0.5, 1e-12);
  EXPECT_NEAR(back.probability(0, median * std::exp(1.0)), 0.8413447460685429, 1e-12);
  EXPECT_NEAR(back.probability(1, 2 * median), 0.5, 1e-12);
  EXPECT_EQ(back.probability(0, 0.1), 0);
  EXPECT_EQ(back.probability(0, 0.05), 0);  // moved up to minIML, which is no more than noDamageLimit
  EXPECT_EQ(back.probability(0, 7), back.probability(0, 2));
  // Without noDamageLimit the probability of minIML holds below it.
  const ReadBack loose = read(edited(continuous, "noDamageLimit=\"0.1\"", "noDamageLimit=\"0\""));
  EXPECT_EQ(loose.probability(0, 0.05), loose.probability(0, 0.1));
  EXPECT_GT(loose.probability(0, 0.05), 0);
}

TEST(OpenQuakeCheck, LevelsAreStraightLinesFromTheNoDamageLimit) {
  const ReadBack back = read(discrete);
  EXPECT_NEAR(back.probability(0, 0.4), 0.3, 1e-15);
  EXPECT_NEAR(back.probability(0, 0.15), 0.05, 1e-15);
  EXPECT_EQ(back.probability(0, 0.09), 0);
  EXPECT_NEAR(back.probability(1, 3), 0.4, 1e-15);
}

TEST(OpenQuakeCheck, HoldsFilesToTheRules) {
  const auto why = [](const std::string& base, const std::string& old, const std::string& next) {
    return error_of([&] { read(edited(base, old, next)); });
  };
  EXPECT_THAT(why(discrete, "nrml/0.5", "nrml/0.4"), HasSubstr("version 0.5"));
  EXPECT_THAT(why(discrete, "id=\"m\"", "id=\"m.1\""), HasSubstr("letters, digits"));
  EXPECT_THAT(why(discrete, "assetCategory=\"buildings\" ", ""), HasSubstr("assetCategory"));
  EXPECT_THAT(why(discrete, "<description>d</description>\n", ""), HasSubstr("description"));
  EXPECT_THAT(why(discrete, "<description>d</description>\n    <limitStates>a b</limitStates>",
                  "<limitStates>a b</limitStates><description>d</description>"),
              HasSubstr("first element of the model is a description"));
  EXPECT_THAT(why(discrete, "a b<", "b a<"), HasSubstr("order of limitStates"));
  EXPECT_THAT(why(discrete, "a b<", "a b c<"), HasSubstr("has every limit state"));
  EXPECT_THAT(why(discrete, "a b<", "a.1 b<"), HasSubstr("words of letters"));
  EXPECT_THAT(why(discrete, "0.2 0.6 1.0", "0.2 0.6 0.6"), HasSubstr("levels rise"));
  EXPECT_THAT(why(discrete, "0.2 0.6 1.0", "0.2 0.6"), HasSubstr("probability for each level"));
  EXPECT_THAT(why(discrete, "0.1 0.5 0.9", "0.1 0.5 0.4"), HasSubstr("do not fall"));
  EXPECT_THAT(why(discrete, "0.1 0.5 0.9", "0.1 0.5 1.1"), HasSubstr("within 0 and 1"));
  EXPECT_THAT(why(discrete, "0 0.2 0.4", "0 0.6 0.7"), HasSubstr("do not cross"));
  EXPECT_THAT(why(discrete, "0.9", "0.9x"), HasSubstr("0.9x is a number"));
  EXPECT_THAT(why(discrete, "</nrml>", ""), HasSubstr("it is XML"));
  EXPECT_THAT(why(continuous, "logncdf", "normal"), HasSubstr("logncdf"));
  EXPECT_THAT(why(continuous, "maxIML=\"2.0\"", "maxIML=\"0.01\""), HasSubstr("minIML is below maxIML"));
  EXPECT_THAT(why(continuous, "imt=\"PGA\"", "imt=\"PGV\""), HasSubstr("fits an intensity in g"));
}

TEST(OpenQuake, RefusesWhatItHasNoNameFor) {
  const auto why = [](const Model& model) { return error_of([&] { find("openquake").refuse(model); }); };
  EXPECT_THAT(why(model("openquake", request(), made_results(), {"p_pgv_over_g_tan_alpha", "1"})),
              AllOf(HasSubstr("none of a floor"), HasSubstr("pga_g")));
  Model bad = model("openquake");
  bad.id = "lab.fridge";
  EXPECT_THAT(why(bad), AllOf(HasSubstr("lab.fridge"), HasSubstr("no dot"), HasSubstr("--id")));
  bad.id = std::string(76, 'a');
  EXPECT_THAT(why(bad), HasSubstr("at most 75"));
  bad.id = "a";
  bad.description = " ";
  EXPECT_THAT(why(bad), HasSubstr("empty description"));
}

TEST(OpenQuakeVulnerability, HasMassesAtNoLossAndAtAll) {
  Request wanted = request({"overturned=falls"});
  wanted.form = Form::discrete;
  const std::string xml = find("openquake-vulnerability")
                              .write(model("openquake-vulnerability", wanted, without_curves()), "a.xml")
                              .front()
                              .text;
  EXPECT_THAT(xml, AllOf(HasSubstr("<vulnerabilityFunction id=\"fridge\" dist=\"PM\">"),
                         HasSubstr("<imls imt=\"PGA\">1e-10 0.1 0.3 0.6 1 1.6</imls>"),
                         HasSubstr("<probabilities lr=\"0\">1 1 1 0.9 0.7 0.4</probabilities>"),
                         HasSubstr("<probabilities lr=\"1\">0 0 0 0.1 0.3 0.6</probabilities>")));
  const Folder folder;
  const auto why = [&](const std::string& old, const std::string& next) {
    return error_of(
        [&] { check_of("openquake-vulnerability").open(folder.write("a.xml", edited(xml, old, next)), pga); });
  };
  EXPECT_THAT(why("1 1 1 0.9", "1 1 1 0.8"), HasSubstr("add up to 1"));
  EXPECT_THAT(why("0.3 0.6 1 1.6<", "0.3 0.3 1 1.6<"), HasSubstr("levels rise"));
  EXPECT_THAT(why("dist=\"PM\"", "dist=\"LN\""), HasSubstr("dist PM"));
}

TEST(OpenQuakeVulnerability, TakesTheMostSevereLimitState) {
  const Model found = model("openquake-vulnerability");
  ASSERT_EQ(found.states.size(), 1u);
  EXPECT_EQ(found.states[0].name, "overturned");
}

}  // namespace
}  // namespace freestand::exports::test::openquake_test
