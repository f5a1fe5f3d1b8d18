// The catalogue file and its table: what they become, and what is told of mistakes.
#include "study/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "study/known.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study {
namespace {

using freestand::test::error_text;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string common =
    "format: freestand-catalogue/1\n"                                                   // line 1
    "samples: 500\n"                                                                    // 2
    "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: {uniform: [0.1, 2]}}]\n"  // 3
    "fragility: {im: pga_g, edp: [peak_slip_m, overturned]}\n";                         // 4
const std::string two =
    "entries:\n"  // 5
    "  - {id: fridge, class: refrigerator, block: {width_m: 0.7, height_m: 1.8}, friction: {mu: 0.25}}\n"
    "  - {id: rack, class: server rack, block: {width_m: 0.6, height_m: 2}, friction: {mu_k: 0.3, static_ratio: "
    "1.5}}\n";

class CatalogueTest : public testing::Test {
 protected:
  Catalogue read(const std::string& text) { return read_catalogue(write("some.yaml", text), registries()); }
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(scratch_ / name) << text;
    return scratch_ / name;
  }
  std::string refusal(const std::string& text) {
    return error_text(Exit::usage, [&] { read(text); });
  }
  std::string table_refusal(const std::string& rows) {
    write("t.csv", rows);
    return refusal(common + "table: t.csv\n");
  }
  static std::vector<std::string> ids(const Catalogue& catalogue) {
    std::vector<std::string> all;
    for (const CatalogueEntry& entry : catalogue.entries) all.push_back(entry.words.id);
    return all;
  }
  const freestand::test::Scratch scratch_{"catalogue"};
};

TEST_F(CatalogueTest, AnEntryIsTheStudyThatItsPartsMake) {
  const Catalogue catalogue = read(common + two);
  EXPECT_EQ(catalogue.name, "some");
  EXPECT_THAT(ids(catalogue), ElementsAre("fridge", "rack"));
  EXPECT_THAT(catalogue.classes, ElementsAre("refrigerator", "server rack"));
  const Study alone = parse_study(
      "samples: 500\n"
      "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: {uniform: [0.1, 2]}}]\n"
      "fragility: {im: pga_g, edp: [peak_slip_m, overturned]}\n"
      "block: {width_m: 0.7, height_m: 1.8}\nfriction: {mu: 0.25}\n",
      scratch_ / "fridge.yaml", registries());
  EXPECT_EQ(expanded(catalogue.entries[0].study), expanded(alone));
  const database::Entry& rack = catalogue.entries[1].words;
  EXPECT_EQ(rack.mu_k, 0.3);
  EXPECT_DOUBLE_EQ(rack.mu_s, 0.45);
  EXPECT_EQ(rack.height_m, 2);
  EXPECT_EQ(rack.source, "not stated");
  EXPECT_EQ(rack.shaking, catalogue.entries[0].words.shaking);
}

TEST_F(CatalogueTest, StaticFrictionIsToldAsAnEffectMakesIt) {
  const Catalogue catalogue =
      read(common +
           "effects: [{name: static_friction, ratio: {uniform: [1.2, 1.6]}}]\nentries:\n"
           "  - {id: a, class: rack, block: {width_m: 0.7, height_m: 1.8}, friction: {mu: 0.25}}\n");
  EXPECT_DOUBLE_EQ(catalogue.entries[0].words.mu_s, 0.25 * 1.4);
}

TEST_F(CatalogueTest, WhatAnEntrySaysItselfComesBeforeTheCommonParts) {
  const Catalogue catalogue =
      read(common +
           "entries:\n  - {id: a, class: x, samples: 700, block: {slenderness_rad: 0.3, size_m: 1}, "
           "friction: {mu: {uniform: [0.2, 0.4]}}, effects: [{name: vertical_shaking, scale: 0.5}]}\n");
  const CatalogueEntry& entry = catalogue.entries.at(0);
  EXPECT_EQ(entry.study.samples, 700U);
  EXPECT_NEAR(entry.words.width_m, 2 * std::sin(0.3), 1e-12);
  EXPECT_NEAR(entry.words.mu_k, 0.3, 1e-12);
  EXPECT_THAT(entry.words.effects, HasSubstr("vertical_shaking(scale=0.5"));
  EXPECT_EQ(entry.words.scatter, "friction.mu x1.228");  // (0.2 + 0.8413 * 0.2)/0.3
}

TEST_F(CatalogueTest, FrictionsAndFloorsMultiplyTheEntriesThatNameNone) {
  const std::string head =
      "format: freestand-catalogue/1\nsamples: 500\n"
      "floors: {low: [{pulse: A, period_s: 0.5, peak_acceleration_g: {uniform: [0.1, 2]}}], high: [{pulse: B, "
      "period_s: 1, peak_acceleration_g: {uniform: [0.1, 2]}}]}\n"
      "frictions: {ice: {mu: 0.05}, vinyl: {mu: 0.25}}\n";
  const Catalogue catalogue =
      read(head +
           "entries:\n"
           "  - {id: a, class: x, block: {width_m: 1, height_m: 2}}\n"
           "  - {id: b, class: x, block: {width_m: 1, height_m: 2}, friction: vinyl, floor: [high]}\n"
           "  - {id: c, class: x, block: {width_m: 1, height_m: 2}, friction: {mu: 0.7}, floor: low}\n");
  EXPECT_THAT(ids(catalogue), ElementsAre("a_ice_low", "a_ice_high", "a_vinyl_low", "a_vinyl_high", "b_high", "c"));
  EXPECT_EQ(catalogue.entries[3].words.mu_k, 0.25);
  EXPECT_EQ(catalogue.entries[3].words.floor, "high");
  EXPECT_EQ(catalogue.entries[3].words.friction, "vinyl");
  EXPECT_EQ(catalogue.entries[3].study.motions[0].pulses.values[0], "B");
  EXPECT_EQ(catalogue.entries[5].words.mu_k, 0.7);
  EXPECT_NE(catalogue.entries[0].words.shaking, catalogue.entries[1].words.shaking);
  EXPECT_THAT(refusal(head + "entries:\n  - {id: a, class: x, block: {width_m: 1, height_m: 2}, friction: vinil}\n"),
              AllOf(HasSubstr("some.yaml:6: friction vinil"), HasSubstr("did you mean vinyl?")));
}

TEST_F(CatalogueTest, ATableGivesOneEntryARow) {
  write("t.csv",
        "# measured by "
        "hand\nid,class,width_m,height_m,mu_k,mu_s,description,effects.rate_weakening.drop,effects.rate_weakening."
        "speed_mps\n"
        "a,bookcase,0.32,1.8,0.3,0.4,\"five shelves, full\",0.3,0.1\n\n"
        "b,bookcase,0.32,1.8,\"{lognormal: {median: 0.3, dispersion: 0.2}}\",,,,\n");
  const Catalogue catalogue = read(common + "table: t.csv\n");
  EXPECT_THAT(ids(catalogue), ElementsAre("a", "b"));
  EXPECT_EQ(catalogue.entries[0].words.description, "five shelves, full");
  EXPECT_EQ(catalogue.entries[0].words.mu_s, 0.4);
  EXPECT_EQ(catalogue.entries[0].study.model.effects.size(), 1U);
  EXPECT_THAT(catalogue.entries[0].place, testing::EndsWith("t.csv:3"));
  EXPECT_EQ(catalogue.entries[1].study.model.effects.size(), 0U);
  EXPECT_NEAR(catalogue.entries[1].words.mu_k, 0.3, 1e-12);
  EXPECT_EQ(catalogue.entries[1].words.scatter, "friction.mu_k x1.221");  // exp(0.2)
}

TEST_F(CatalogueTest, ACommonBlockIsWhatEachEntryDoesNotSay) {
  const auto numbers = [](const database::Entry& entry) {
    return std::vector<double>{entry.width_m, entry.height_m, entry.mass_kg};
  };
  write("t.csv", "id,class,width_m,height_m,mass_kg,mu\na,x,0.5,1.5,,0.3\nb,x,0.6,,90,0.3\n");
  const Catalogue catalogue = read(common + "block: {mass_kg: 120, height_m: 2, centre_height_m: 0.6}\ntable: t.csv\n");
  EXPECT_THAT(numbers(catalogue.entries.at(0).words), ElementsAre(0.5, 1.5, 120));
  EXPECT_THAT(numbers(catalogue.entries.at(1).words), ElementsAre(0.6, 2, 90));
  EXPECT_TRUE(catalogue.entries.at(1).study.model.block.centre_height);
  // Of two ways to say one thing the entry's counts.
  const Catalogue slender =
      read(common +
           "block: {width_m: 0.6, height_m: 2, mass_kg: 120}\n"
           "entries:\n  - {id: a, class: x, block: {slenderness_rad: 0.3, size_m: 1}, friction: {mu: 0.2}}\n"
           "  - {id: b, class: x, friction: {mu: 0.2}}\n");
  EXPECT_NEAR(slender.entries.at(0).words.width_m, 2 * std::sin(0.3), 1e-12);
  EXPECT_EQ(slender.entries.at(0).words.mass_kg, 120);
  EXPECT_THAT(numbers(slender.entries.at(1).words), ElementsAre(0.6, 2, 120));
  // Mistakes: of the common block once, of what it makes together with a row at the row.
  EXPECT_THAT(refusal(common + "entries: []\n"), HasSubstr("has nothing in it"));
  EXPECT_THAT(refusal(common + "block: {mas_kg: 120}\ntable: t.csv\n"),
              AllOf(HasSubstr("some.yaml:5: unknown key mas_kg"), Not(HasSubstr("t.csv"))));
  EXPECT_THAT(refusal(common + "block: {centre_height_m: 1.7, height_m: 2}\ntable: t.csv\n"),
              AllOf(HasSubstr("t.csv:2: block.centre_height_m"), Not(HasSubstr("t.csv:3"))));
  EXPECT_THAT(refusal(common + "block: {mass_kg: 120}\ntable: t.csv\n"),
              HasSubstr("t.csv:3: block.height_m is missing"));
}

// sqrt(40/100) m and sqrt(40/400) m: blocks that differ. What the mass does in no other way, and what a radius says as well, is alike.
TEST_F(CatalogueTest, BlocksOfOneInertiaAreAlikeByTheirRadius) {
  const auto entry = [](const std::string& id, const std::string& more) {
    return "  - {id: " + id + ", class: x, block: {width_m: 0.6, height_m: 1.8, " + more + "}, friction: {mu: 0.5}}\n";
  };
  const Catalogue catalogue =
      read(common + "entries:\n" + entry("light", "mass_kg: 100, inertia_kgm2: 40") +
           entry("heavy", "mass_kg: 400, inertia_kgm2: 40") + entry("alike", "mass_kg: 400, inertia_kgm2: 160") +
           entry("radius", "mass_kg: 50, gyration_radius_m: 0.632455532"));
  const auto model = [&](std::size_t i) { return catalogue.entries.at(i).words.model; };
  EXPECT_NE(model(0), model(1));
  EXPECT_EQ(model(0), model(2));
  EXPECT_EQ(model(0), model(3));
}

TEST_F(CatalogueTest, AMassThatNobodyGaveIsNotKnown) {
  EXPECT_TRUE(std::isnan(read(common + two).entries[0].words.mass_kg));
}

TEST_F(CatalogueTest, MistakesOfATableAreToldByTheirRow) {
  EXPECT_THAT(table_refusal("id,class,width,height_m,mu\na,x,1,2,0.3\n"),
              AllOf(HasSubstr("t.csv:1: key width in the columns has no unit"), HasSubstr("write width_m")));
  EXPECT_THAT(table_refusal("id,class,width_cm,height_m,mu\na,x,1,2,0.3\n"),
              AllOf(HasSubstr("t.csv:1: "), HasSubstr("key width_cm in the columns")));
  EXPECT_THAT(table_refusal("id,class,width_m,hight_m,mu\na,x,1,2,0.3\n"), HasSubstr("did you mean height_m?"));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na,x,1,2,0.3\nb,x,0.6 m,2,0.3\n"),
              AllOf(HasSubstr("t.csv:3: block.width_m is \"0.6 m\""), Not(HasSubstr("t.csv:2"))));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na,x,1,2,0.3\na,x,1,2,0.4\n"),
              AllOf(HasSubstr("t.csv:3: id a stands twice"), HasSubstr("t.csv:2")));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na,x,1,2\n"),
              HasSubstr("t.csv:2: the row has 4 cells, the header 5"));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na,x,-1,,0.3\n"),
              AllOf(HasSubstr("t.csv:2: block.width_m is -1"), HasSubstr("t.csv:2: block.height_m is missing")));
  EXPECT_THAT(table_refusal("id;class;width_m;height_m;mu\na;x;1;2;0.3\n"), HasSubstr("parted by commas"));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na,x,\"1,2,0.3\n"),
              HasSubstr("t.csv:2: a quote is not closed"));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na,x,1,2,{uniform: [0.1\n"), HasSubstr("t.csv:2: "));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\n"), HasSubstr("has no rows"));
  EXPECT_THAT(table_refusal("id,class,width_m,height_m,mu\na/b,x,1,2,0.3\n"),
              HasSubstr("t.csv:2: id \"a/b\" is no name"));
  EXPECT_THAT(refusal(common + "table: nowhere.csv\n"),
              AllOf(HasSubstr("some.yaml:5: table"), HasSubstr("no such file")));
}

TEST_F(CatalogueTest, MistakesOfTheFileAreToldByTheirLine) {
  EXPECT_THAT(refusal(two), HasSubstr("format is \"\""));
  EXPECT_THAT(refusal(common), HasSubstr("entries is missing"));
  EXPECT_THAT(refusal(common + two + "colour: red\n"), HasSubstr("some.yaml:8: unknown key colour"));
  EXPECT_THAT(refusal("format: freestand-catalogue/1\nsamples: -3\nmotions: [{pulse: Q}]\n" + two),
              AllOf(HasSubstr("some.yaml:2: samples is -3"), HasSubstr("some.yaml:3: ")));
  EXPECT_THAT(refusal(common + "entries:\n  - {class: x, block: {width_m: 1, height_m: 2}, friction: {mu: 0.2}}\n"),
              HasSubstr("some.yaml:6: the entry has no id"));
  EXPECT_THAT(refusal(common + "entries:\n  - {id: a, block: {width_m: 1, height_m: 2}, friction: {mu: 0.2}}\n"),
              HasSubstr("some.yaml:6: the entry has no class"));
  EXPECT_THAT(
      refusal(common + "entries:\n  - {id: a, class: x, block: {width_m: 1, hight_m: 2}, friction: {mu: 0.2}}\n"),
      AllOf(HasSubstr("some.yaml:6: unknown key hight_m"), HasSubstr("did you mean height_m?")));
  EXPECT_THAT(
      refusal(common + "entries:\n  - {id: a, class: x, blok: {width_m: 1, height_m: 2}, friction: {mu: 0.2}}\n"),
      HasSubstr("some.yaml:6: unknown key blok"));
  // Two entries with mistakes: both are told, once each.
  const std::string both = refusal(common +
                                   "entries:\n  - {id: a, class: x, block: {width_m: 1}, friction: {mu: 0.2}}\n"
                                   "  - {id: b, class: x, block: {width_m: 1, height_m: 2}}\n");
  EXPECT_THAT(
      both, AllOf(HasSubstr("some.yaml:6: block.height_m is missing"), HasSubstr("some.yaml:7: friction is missing")));
  EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 1) << both;
}

TEST_F(CatalogueTest, DemandsThatAnEntryCannotHaveAreToldAtIt) {
  std::string asked = common;
  asked.replace(asked.find("overturned"), 10, "connection_failed");
  const std::string chained =
      "entries:\n"
      "  - {id: a, class: x, block: {width_m: 1, height_m: 2, mass_kg: 90}, friction: {mu: 0.2}, "
      "chain: {stiffness_npm: 1e4, strength_n: 200}}\n";
  EXPECT_EQ(read(asked + chained).entries.size(), 1U);
  EXPECT_THAT(
      refusal(asked + chained + "  - {id: b, class: x, block: {width_m: 1, height_m: 2}, friction: {mu: 0.2}}\n"),
      HasSubstr("some.yaml:7: fragility.edp: connection_failed would be 0"));
  write("t.csv", "id,class,width_m,height_m,mu\nb,x,1,2,0.2\n");
  EXPECT_THAT(refusal(asked + "table: t.csv\n"), HasSubstr("t.csv:2: fragility.edp: connection_failed would be 0"));
}

TEST_F(CatalogueTest, ClassesAreAClosedListWhereTheyAreListed) {
  EXPECT_THAT(refusal(common + "classes: [refrigerator]\n" + two),
              AllOf(HasSubstr("class server rack is not among `classes`"), HasSubstr("some.yaml:8: ")));
  EXPECT_EQ(read(common + "classes: [server rack, refrigerator, oven]\n" + two).classes.size(), 3U);
  EXPECT_THAT(refusal(common + two +
                      "  - {id: c, class: refrigerater, block: {width_m: 1, height_m: 2}, friction: {mu: 0.2}}\n"),
              HasSubstr("class refrigerater is nearly refrigerator"));
}

TEST_F(CatalogueTest, ClassesThatDifferInDigitsAreTwo) {
  const std::string rest = ", block: {width_m: 1, height_m: 2}, friction: {mu: 0.2}}\n";
  const std::string kinds = "entries:\n  - {id: a, class: kind_1" + rest + "  - {id: b, class: kind_2" + rest;
  EXPECT_EQ(read(common + kinds).classes, (std::vector<std::string>{"kind_1", "kind_2"}));
  EXPECT_THAT(refusal(common + kinds + "  - {id: c, class: kynd_2" + rest), HasSubstr("class kynd_2 is nearly kind_"));
}

TEST_F(CatalogueTest, AReferenceIsWhole) {
  const std::string entry =
      "entries:\n  - {id: a, class: x, block: {width_m: 1, height_m: 2}, friction: {mu: 0.2}, reference: ";
  const Catalogue catalogue =
      read(common + entry +
           "{source: book, id: E.1, intensity: pgv_mps, demand: overturned, median: 0.5, dispersion: 0.4}}\n");
  EXPECT_EQ(catalogue.entries[0].words.reference_id, "E.1");
  EXPECT_EQ(catalogue.entries[0].words.reference_median, 0.5);
  EXPECT_THAT(refusal(common + entry + "{source: book, intensity: pgv_mps, demand: overturned, median: 0.5}}\n"),
              HasSubstr("reference.dispersion is missing"));
  EXPECT_THAT(refusal(common + entry +
                      "{source: book, intensity: pgv_mps, demand: peak_slip_m, median: 0.5, dispersion: 0.4}}\n"),
              HasSubstr("reference.capacity is missing"));
  EXPECT_THAT(refusal(common + entry +
                      "{source: book, intensity: pgw_mps, demand: overturned, median: 0.5, dispersion: 0.4}}\n"),
              AllOf(HasSubstr("some.yaml:6: reference.intensity pgw_mps"), HasSubstr("did you mean pgv_mps?")));
}

// The catalogues that come with the project: what the README promises of them.
TEST_F(CatalogueTest, TheCataloguesThatComeWithTheProgramAreSound) {
  const std::filesystem::path folder = std::filesystem::path(FREESTAND_SOURCE_DIR) / "configs/catalogue";
  const Catalogue equipment = read_catalogue(folder / "equipment.yaml", registries());
  EXPECT_GE(equipment.classes.size(), 21U);
  for (const CatalogueEntry& entry : equipment.entries) EXPECT_NE(entry.words.source, "not stated") << entry.words.id;
  const Catalogue p58 = read_catalogue(folder / "p58.yaml", registries());
  std::map<std::string, double> medians;
  for (const CatalogueEntry& entry : p58.entries) {
    medians[entry.words.reference_id] = entry.words.reference_median;
    EXPECT_EQ(entry.words.reference_dispersion, 0.5);
  }
  const std::map<std::string, double> published = {
      {"E.20.22.102a", 0.724}, {"E.20.22.103a", 0.493}, {"E.20.22.104a", 0.361},
      {"E.20.22.105a", 0.29},  {"E.20.22.106a", 0.251}, {"E.20.22.112a", 1.229},
      {"E.20.22.114a", 0.498}, {"E.20.22.124a", 0.688}, {"E.20.22.125a", 0.526}};
  EXPECT_EQ(medians, published);
}

}  // namespace
}  // namespace freestand::study
