#include "database/query.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "database/made_database.hpp"
#include "support/error_text.hpp"

namespace freestand::database {
namespace {

using freestand::test::error_text;
using test::dispersion;
using test::lognormal;
using test::made_database;
using test::median;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

// Probabilities are drawn in to half a sample of a million, 5e-7, and read back from Phi^-1.
constexpr double drawn_in = 1e-6;

Question question(double im, double capacity = 0.05) {
  Question asked;
  asked.equipment = "rack";
  asked.im = "pga_g";
  asked.im_value = im;
  asked.demand = "peak_slip_m";
  asked.capacity = capacity;
  return asked;
}

Question at(Question asked, Coordinate c, double value) {
  asked.wanted[static_cast<std::size_t>(c)] = value;
  return asked;
}

std::string refusal(const Question& asked) {
  return error_text(Exit::usage, [&] { ask(made_database(), asked); });
}

// What P does between two points that are known far better than they are alike is said to be in no band.
TEST(Query, LinesBetweenPointsFarApartSayWhatNoBandHolds) {
  Database db = made_database();
  for (Curve& curve : db.curves) curve.family.clear();
  Question asked = question(0.55);
  asked.id = "rack_30_2";
  const Curve& curve = *std::find_if(db.curves.begin(), db.curves.end(), [&](const Curve& c) {
    return db.entries[c.entry].id == asked.id && c.demand == asked.demand && c.capacity == asked.capacity;
  });
  const std::string between = fmt::format("from 0.4 to 0.8 it goes from {:.2g} to {:.2g}", curve.points[2].probability,
                                          curve.points[3].probability);
  EXPECT_THAT(ask(db, asked)[0].between, AllOf(HasSubstr(between), HasSubstr("no band holds")));
  for (Curve& each : db.curves)
    for (Point& point : each.points) point.lower = 0, point.upper = 1;
  EXPECT_EQ(ask(db, asked)[0].between, "");
}

TEST(Query, AnEntryAnswersAtItsPointsAndBetweenThem) {
  Question asked = question(0.37);
  asked.id = "rack_30_2";
  for (const double im : {0.1, 0.2, 0.37, 0.55, 1.1, 1.6}) {
    asked.im_value = im;
    const auto answers = ask(made_database(), asked);
    ASSERT_EQ(answers.size(), 1U);
    const Probability p = answers[0].probability.at(0);
    EXPECT_NEAR(p.value, lognormal(im, median(0.3, 2, 0.05), dispersion), drawn_in);
    if (im == 0.1 || im == 0.2 || im == 1.6) {  // points, which the band goes through
      EXPECT_NEAR(p.lower, lognormal(im, 1.2 * median(0.3, 2, 0.05), dispersion), drawn_in);
      EXPECT_NEAR(p.upper, lognormal(im, median(0.3, 2, 0.05) / 1.2, dispersion), drawn_in);
    }
    EXPECT_LE(p.lower, p.value);
    EXPECT_LE(p.value, p.upper);
    EXPECT_EQ(answers[0].rule, "read by the lognormal, which is adequate");
    EXPECT_THAT(answers[0].notes, IsEmpty());
    EXPECT_EQ(answers[0].median, median(0.3, 2, 0.05));
  }
}

// The law is linear in the logarithms, so that interpolation over the grid must give it exactly, at any point.
TEST(Query, BetweenEntriesTheLawOfTheGridComesOut) {
  for (const double mu : {0.2, 0.23, 0.4, 0.5})
    for (const double height : {1.0, 1.3, 1.9})
      for (const double capacity : {0.05, 0.1, 0.2}) {
        const auto answers =
            ask(made_database(), at(at(question(0.44, capacity), Coordinate::mu, mu), Coordinate::height_m, height));
        ASSERT_EQ(answers.size(), 1U);
        EXPECT_NEAR(answers[0].probability[0].value, lognormal(0.44, median(mu, height, capacity), dispersion),
                    drawn_in)
            << mu << " " << height << " " << capacity;
        EXPECT_THAT(answers[0].notes, IsEmpty());
        double weights = 0;
        for (const Part& part : answers[0].parts) weights += part.weight;
        EXPECT_NEAR(weights, 1, 1e-12);
      }
}

TEST(Query, WhatTheBandRestsOnIsNoExtrapolation) {
  Database db = made_database();
  for (Entry& entry : db.entries) entry.motions = 7;
  const Answer answer = ask(db, at(question(0.4), Coordinate::mu, 0.25))[0];
  ASSERT_EQ(answer.notes.size(), 1U);
  EXPECT_THAT(answer.notes[0], HasSubstr("rests on 7 motions"));
  EXPECT_FALSE(answer.extrapolated);
  EXPECT_TRUE(ask(db, at(question(0.4), Coordinate::mu, 0.55))[0].extrapolated);
  EXPECT_TRUE(ask(db, at(question(2), Coordinate::mu, 0.25))[0].extrapolated);
}

TEST(Query, WhatIsNotAskedForPartsTheAnswers) {
  const auto answers = ask(made_database(), at(question(0.4), Coordinate::mu, 0.25));
  ASSERT_EQ(answers.size(), 2U);  // one a height
  EXPECT_NEAR(answers[0].probability[0].value, lognormal(0.4, median(0.25, 1, 0.05), dispersion), drawn_in);
  EXPECT_NEAR(answers[1].probability[0].value, lognormal(0.4, median(0.25, 2, 0.05), dispersion), drawn_in);
  EXPECT_EQ(ask(made_database(), question(0.4)).size(), 6U);
}

TEST(Query, EntriesOnAnotherFloorOrWithAnotherScatterAreNoNeighbours) {
  for (auto member : {&Entry::floor, &Entry::shaking, &Entry::scatter, &Entry::effects, &Entry::model}) {
    Database db = made_database();
    db.entries[2].*member = "another";  // rack_30_1
    const auto answers = ask(db, at(question(0.4), Coordinate::mu, 0.25));
    ASSERT_EQ(answers.size(), 2U);
    EXPECT_EQ(db.entries[answers[0].parts[1].entry].id, "rack_50_1");
  }
}

TEST(Query, ACurveStandsWhereAllItsEntriesWereSwept) {
  Database db = made_database();
  for (Curve& curve : db.curves)
    if (curve.entry == 0) curve.im_most = 0.5;
  Question asked = at(at(question(unknown), Coordinate::mu, 0.25), Coordinate::height_m, 1);
  const Answer answer = ask(db, asked).at(0);
  EXPECT_THAT(answer.im, testing::ElementsAre(0.1, 0.2, 0.4));
  for (std::size_t i = 0; i < answer.im.size(); ++i)
    EXPECT_NEAR(answer.probability[i].value, lognormal(answer.im[i], median(0.25, 1, 0.05), dispersion), drawn_in);
}

TEST(Query, ExtrapolationIsToldAndFarAwayRefused) {
  Answer answer = ask(made_database(), at(at(question(0.4), Coordinate::mu, 0.55), Coordinate::height_m, 1)).at(0);
  EXPECT_NEAR(answer.probability[0].value, lognormal(0.4, median(0.55, 1, 0.05), dispersion), drawn_in);
  ASSERT_EQ(answer.notes.size(), 1U);
  EXPECT_THAT(answer.notes[0], AllOf(HasSubstr("extrapolated: mu = 0.55"), HasSubstr("0.2 to 0.5")));
  EXPECT_THAT(refusal(at(question(0.4), Coordinate::mu, 0.9)),
              AllOf(HasSubstr("mu = 0.9"), HasSubstr("mu 0.2 0.3 0.5")));

  answer = ask(made_database(), question(2)).at(0);
  EXPECT_NEAR(answer.probability[0].value, lognormal(2, median(0.2, 1, 0.05), dispersion), drawn_in);
  ASSERT_EQ(answer.notes.size(), 1U);
  EXPECT_THAT(answer.notes[0], AllOf(HasSubstr("extrapolated: pga_g = 2"), HasSubstr("0.1 to 1.6")));
  EXPECT_THAT(refusal(question(3)),
              AllOf(HasSubstr("pga_g = 3"), HasSubstr("too far outside"), HasSubstr("0.1 to 1.6 g")));
  EXPECT_THAT(refusal(question(0.05)), HasSubstr("too far outside"));
}

TEST(Query, AGridWithAHoleGivesNoAnswerThere) {
  Database db = made_database();
  db.entries[3].height_m = 2.5;  // rack_30_2 leaves its place
  const Question asked = at(at(question(0.4), Coordinate::mu, 0.25), Coordinate::height_m, 1.5);
  EXPECT_THAT(error_text(Exit::usage, [&] { ask(db, asked); }), HasSubstr("lies in no grid"));
}

TEST(Query, APartHoldsTheWordsOfItsCurvesAlone) {
  Database db = test::made_database();
  Curve fell = test::curve(db.entries.size() - 1, 0.5, 0.4, 0.5);
  fell.demand = "overturned";
  db.curves.push_back(fell);
  const Database first = part_of(db, {0}), last = part_of(db, {db.entries.size() - 1});
  ASSERT_EQ(first.demands.size(), 1u);
  EXPECT_EQ(first.demands[0].name, "peak_slip_m");
  EXPECT_EQ(last.demands.size(), 2u);
  ASSERT_EQ(last.entries.size(), 1u);
  EXPECT_EQ(last.entries[0].id, db.entries.back().id);
  for (const Curve& curve : last.curves) EXPECT_EQ(curve.entry, 0u);
}

TEST(Query, MistakesAreToldWithTheChoices) {
  Question asked = question(0.4);
  asked.equipment = "rak";
  EXPECT_THAT(refusal(asked),
              AllOf(HasSubstr("class \"rak\""), HasSubstr("did you mean rack?"), HasSubstr("rack, bookcase")));
  asked = question(0.4);
  asked.id = "rack_31_1";
  EXPECT_THAT(refusal(asked), HasSubstr("rack_30_1"));
  asked = question(0.4);
  asked.im = "pgv_mps";
  EXPECT_THAT(refusal(asked), AllOf(HasSubstr("intensity \"pgv_mps\""), HasSubstr("pga_g")));
  asked = question(0.4);
  asked.demand = "";
  EXPECT_THAT(refusal(asked), AllOf(HasSubstr("no demand is given"), HasSubstr("peak_slip_m, overturned")));
  EXPECT_THAT(refusal(question(0.4, unknown)), HasSubstr("--capacity"));
  EXPECT_THAT(refusal(question(0.4, 0.5)), AllOf(HasSubstr("capacity 0.5"), HasSubstr("0.05 to 0.2")));
  EXPECT_THAT(refusal(question(-1)), HasSubstr("must be above zero"));
  asked = question(0.4);
  asked.demand = "overturned";
  EXPECT_THAT(refusal(asked), HasSubstr("takes no capacity"));
  asked.capacity = unknown;
  EXPECT_THAT(refusal(asked), HasSubstr("has no overturned over pga_g"));
}

}  // namespace
}  // namespace freestand::database
