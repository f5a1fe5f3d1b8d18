// Limit states, forms, and what is refused, on results made by hand.
#include "fragility/rising.hpp"
#include "made_results.hpp"

namespace freestand::exports::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Risen, PoolsNeighboursThatFallToTheirWeightedMean) {
  EXPECT_THAT(fragility::risen({0.1, 0.4, 0.2, 0.6}, {1, 1, 3, 1}), ElementsAre(0.1, 0.25, 0.25, 0.6));
  // What a pool does to the one before it: 0.5 stands above (0.6 + 0.2)/2.
  EXPECT_THAT(fragility::risen({0.5, 0.6, 0.2}, {2, 1, 1}), ElementsAre(0.45, 0.45, 0.45));
  EXPECT_THAT(fragility::risen({0.1, 0.1, 0.2}, {1, 1, 1}), ElementsAre(0.1, 0.1, 0.2));
}

TEST(LimitStates, UsuallyAreTheFirstDemandAndOverturned) {
  const Model found = model("openquake");
  ASSERT_EQ(found.states.size(), 3u);
  EXPECT_EQ(found.states[0].name, "peak_slip_m_over_0p05");
  EXPECT_EQ(found.states[1].name, "peak_slip_m_over_0p2");
  EXPECT_EQ(found.states[2].name, "overturned");
  EXPECT_TRUE(std::isnan(found.states[2].capacity));
}

// A study that names wall_hit first asks for it. Overturning is no severer state of it: blocks also fall away from the wall.
TEST(LimitStates, ADemandThatHappensOrNotGoesOutWhereItIsNamedFirst) {
  fragility::Result results = made_results();
  results.edps.insert(results.edps.begin(), results.edps.back());
  results.edps.front().name = "wall_hit";
  const Model found = model("openquake", request(), results);
  ASSERT_EQ(found.states.size(), 1u);
  EXPECT_EQ(found.states[0].name, "wall_hit");
  EXPECT_THAT(found.notes, testing::Contains("left out: peak_slip_m, overturned (--limit-state takes them)"));
  // Overturning itself is the last state of the first demand with capacities, wherever it is named.
  std::swap(results.edps.front(), results.edps.back());
  results.edps.pop_back();
  EXPECT_EQ(model("openquake", request(), results).states.size(), 3u);
}

// Nothing in a table has to be in an order.
TEST(LimitStates, OfATableAreAllDemands) {
  fragility::Result results = made_results();
  results.edps.push_back(results.edps.front());
  results.edps.back().name = "delta";
  const Model found = model("csv", request(), results);
  ASSERT_EQ(found.states.size(), 5u);
  EXPECT_EQ(found.states[4].name, "delta_over_0p2");
  EXPECT_THAT(found.notes, testing::Not(testing::Contains(HasSubstr("left out"))));
  EXPECT_EQ(model("csv", request({"overturned"}), results).states.size(), 1u);
}

TEST(LimitStates, DemandsThatNobodyNamedAreToldAsLeftOut) {
  fragility::Result results = made_results();
  results.edps.push_back(results.edps.front());
  results.edps.back().name = "delta";
  EXPECT_THAT(model("openquake", request(), results).notes,
              testing::Contains("left out: delta (--limit-state takes them)"));
  EXPECT_THAT(model("openquake", request({"peak_slip_m"}), results).notes,
              testing::Not(testing::Contains(HasSubstr("left out"))));
}

TEST(LimitStates, ThatNeverHappenedAreLeftOutWhereNobodyAskedForThem) {
  fragility::Result results = made_results();
  for (std::size_t b = 0; b < std::size(bins); ++b) set_surface(results.edps[1], b, 0);
  const Model usual = model("pelicun", request(), results);
  ASSERT_EQ(usual.states.size(), 2u);
  EXPECT_THAT(usual.notes, testing::Contains(HasSubstr("left out: overturned never happened up to 1.9 g")));
  EXPECT_THAT(usual.notes, testing::Not(testing::Contains(HasSubstr("left out: overturned (--limit-state"))));
  // IN-CORE takes three, no fewer.
  const Model three = model("incore", request(), results);
  ASSERT_EQ(three.states.size(), 3u);
  EXPECT_THAT(three.notes, testing::Contains(HasSubstr("overturned never happened up to 1.9 g: its probability is 0")));
  EXPECT_EQ(error_of([&] { find("incore").refuse(three); }), "");
  Request asked = request({"peak_slip_m:0.05", "overturned"});
  asked.form = Form::discrete;
  const Model zeros = model("openquake", asked, results);
  ASSERT_EQ(zeros.states.size(), 2u);
  EXPECT_THAT(zeros.notes, testing::Contains(HasSubstr("overturned never happened up to 1.9 g: its probability is 0")));
}

// A capacity of a nanometre: that it is exceeded says nothing.
TEST(LimitStates, ThatAlwaysHappenedAreToldAndRefusedWhereThereIsNoOther) {
  fragility::Result results = made_results();
  for (std::size_t b = 0; b < std::size(bins); ++b) {
    fragility::Surface& surface = results.edps[0].surface;
    surface.probability[2 * b] = surface.empirical[2 * b] = surface.upper[2 * b] = 1;
  }
  results.edps[0].functions[0] = {};
  const Model beside = model("openquake", request({"peak_slip_m:0.05", "peak_slip_m:0.2"}), results);
  EXPECT_THAT(beside.notes, testing::Contains(HasSubstr("peak_slip_m_over_0p05 happened in every sample, from")));
  EXPECT_THAT(error_of([&] { model("openquake", request({"peak_slip_m:0.05"}), results); }),
              HasSubstr("peak_slip_m_over_0p05 happened in every sample at every intensity swept"));
  EXPECT_EQ(error_of([&] { model("csv", request({"peak_slip_m:0.05"}), results); }), "");
}

TEST(LimitStates, AreChosenAndNamed) {
  const Model found = model("openquake", request({"peak_slip_m:0.2=hits", "overturned=falls"}));
  ASSERT_EQ(found.states.size(), 2u);
  EXPECT_EQ(found.states[0].name, "hits");
  EXPECT_EQ(found.states[0].capacity, 0.2);
  EXPECT_EQ(found.states[1].name, "falls");
}

TEST(LimitStates, ThatAreNotThereAreToldWithThoseThatAre) {
  const auto why = [](const std::string& word) { return error_of([&] { model("openquake", request({word})); }); };
  EXPECT_THAT(why("slip:0.2"), AllOf(HasSubstr("slip"), HasSubstr("peak_slip_m, overturned")));
  EXPECT_THAT(why("peak_slip_m:0.3"), HasSubstr("it has 0.05, 0.2"));
  EXPECT_THAT(why("peak_slip_m:much"), HasSubstr("is no number"));
  EXPECT_THAT(why("overturned:0.5"), HasSubstr("takes no capacity"));
  EXPECT_THAT(why("overturned=it falls"), HasSubstr("letters, digits and _ only"));
  EXPECT_THAT(why("peak_slip_m=both"), HasSubstr("one name to 2 limit states"));
  EXPECT_THAT(error_of([] { model("openquake", request({"overturned", "overturned"})); }), HasSubstr("twice"));
}

TEST(Forms, AdequateLognormalsGoOutAndOthersNever) {
  EXPECT_EQ(model("openquake").states[0].curve.form, Form::lognormal);
  EXPECT_EQ(model("openquake").states[0].curve.median, 0.5);
  const Model counted = model("openquake", request(), made_results(false));
  for (const LimitState& state : counted.states) EXPECT_EQ(state.curve.form, Form::discrete);
  EXPECT_THAT(counted.notes,
              testing::Contains(HasSubstr("no lognormal form: the lognormal of peak_slip_m > 0.05 m is not "
                                          "adequate (it may be off by 0.12)")));
  Request wanted = request();
  wanted.form = Form::lognormal;
  EXPECT_THAT(error_of([&] { model("openquake", wanted, made_results(false)); }), HasSubstr("use --form discrete"));
}

TEST(Forms, DiscretePassesThroughTheSurface) {
  const fragility::Result result = made_results(false);
  const Model found = model("openquake", request(), result);
  for (std::size_t b = 0; b < std::size(bins); ++b)
    EXPECT_NEAR(probability(found.states[0].curve, bins[b]), result.edps[0].surface.probability[2 * b], 1e-15);
  // It goes on with the fitted curve's bend to the end of the sweep, and stays.
  EXPECT_GT(probability(found.states[0].curve, 1.9), result.edps[0].surface.probability[8]);
  EXPECT_EQ(probability(found.states[0].curve, 5), probability(found.states[0].curve, 1.9));
  EXPECT_EQ(probability(found.states[0].curve, 0), 0);
  EXPECT_NEAR(found.states[0].off_surface, 0, 1e-15);
}

// The counted shares of a lognormal, over wide bins: straight lines from one to the next, and from 0, have 2.4 times its events a year where the
// hazard falls by im^-2.5. With the same levels for all, each state's lines give its rate.
TEST(Forms, DiscreteBendsAsTheFittedCurveDoes) {
  constexpr double edge[] = {0.1, 0.45, 0.8, 1.15, 1.5, 1.9}, slope = 2.5;
  const auto law = [](double median, double im) { return phi(std::log(im / median) / 0.4); };
  const double medians[] = {0.9, 1.3, 1.6};
  const auto with_shares = [&](fragility::Result result) {
    for (std::size_t b = 0; b < std::size(bins); ++b) {
      constexpr int places = 200, cells = 8;
      double mean = 0, share[3] = {}, sum[cells] = {}, n[cells] = {};
      for (int i = 0; i < places; ++i) {
        const double im = edge[b] * std::pow(edge[b + 1] / edge[b], (i + 0.5) / places);
        mean += im / places;
        const auto cell = static_cast<int>(cells * (im - edge[b]) / (edge[b + 1] - edge[b]));
        sum[cell] += im, n[cell] += 1;
        for (int s = 0; s < 3; ++s) share[s] += law(medians[s], im) / places;
      }
      result.im[b] = mean;
      for (int cell = 0; cell < cells; ++cell) {
        result.cell_im.push_back(sum[cell] / n[cell]);
        result.cell_n.push_back(static_cast<std::int64_t>(n[cell]));
      }
      for (fragility::EdpResult& edp : result.edps) edp.bins[b].status = fragility::BinStatus::counts_only;
      for (std::size_t k = 0; k < 2; ++k) set_surface(result.edps[0], 2 * b + k, share[k]);
      set_surface(result.edps[1], b, share[2]);
    }
    result.im_edge.assign(std::begin(edge), std::end(edge));
    return result;
  };
  const auto events = [&](const auto& curve) {  // those from what was swept, to the last bin's mean
    double sum = 0;
    for (double im = 0.1; im < 1.65; im *= 1.001)
      sum += curve(im * 1.0005) * (std::pow(im, -slope) - std::pow(im * 1.001, -slope));
    return sum;
  };
  fragility::Result result = made_results(false);
  for (int s = 0; s < 3; ++s) {
    fragility::FragilityFunction& f =
        s < 2 ? result.edps[0].functions[static_cast<std::size_t>(s)] : result.edps[1].functions[0];
    f.median = medians[s];
    f.im_least = 0.1;
  }
  const Model bent = model("openquake", request(), with_shares(result)),
              straight = model("openquake", request(), with_shares(without_curves()));
  for (std::size_t s = 0; s < 3; ++s) {
    const double truth = events([&](double im) { return law(medians[s], im); });
    EXPECT_NEAR(events([&](double im) { return probability(bent.states[s].curve, im); }) / truth, 1, 0.03) << s;
    EXPECT_GT(events([&](double im) { return probability(straight.states[s].curve, im); }) / truth, 1.3) << s;
    EXPECT_EQ(bent.states[s].curve.points.size(), bent.states[0].curve.points.size());
    EXPECT_LT(bent.states[s].off_lines, 0.01);
  }
  EXPECT_LT(bent.states[0].curve.points.size(), 60u);
  EXPECT_THAT(bent.notes,
              testing::Contains(HasSubstr("points of the curve through 5 bins, off that of the counts by at most")));
  EXPECT_THAT(bent.notes, Not(testing::Contains(HasSubstr("annual rates by these straight lines"))));
  // A database is read by straight lines, and so are its exports; how far off these are is said.
  Request as_a_database = request();
  as_a_database.straight = true;
  const Model lines = model("openquake", as_a_database, with_shares(result));
  EXPECT_EQ(lines.states[0].curve.points.size(), 6u);
  EXPECT_GT(lines.states[0].rate_by_lines[1], 1.2);
  EXPECT_GT(lines.states[0].rate_by_lines[2], lines.states[0].rate_by_lines[1]);
  EXPECT_THAT(lines.notes, testing::Contains(HasSubstr("annual rates by these straight lines are")));
}

TEST(Forms, ALognormalWhoseRatesAreNotThoseOfTheCountsIsNone) {
  fragility::Result result = made_results();
  for (fragility::EdpResult& edp : result.edps)
    for (fragility::FragilityFunction& f : edp.functions) {
      f.rate_p = 0.001;
      f.adequate = false;
    }
  const Model found = model("openquake", request(), result);
  EXPECT_EQ(found.states[0].curve.form, Form::discrete);
  EXPECT_THAT(found.notes, testing::Contains(HasSubstr("no lognormal form: the lognormal of peak_slip_m > 0.05 m gives "
                                                       "other annual rates than the counts")));
}

TEST(Forms, PartsAreTheThreePartsAtTheBinsAndBetweenThem) {
  const Model found = model("incore", request(), made_results(false));
  ASSERT_EQ(found.states[0].curve.form, Form::parts);
  EXPECT_NEAR(probability(found.states[0].curve, 0.6), three_parts(0.1, 0.1, std::log(0.06), 0.5, 0.05), 1e-15);
  // Half way between the bins at 0.6 and 1.0 every part is half way.
  EXPECT_NEAR(probability(found.states[1].curve, 0.8),
              three_parts(0.2, 0.05, (std::log(0.06) + std::log(0.1)) / 2, 0.5, 0.2), 1e-15);
  EXPECT_EQ(probability(found.states[0].curve, 0.05), 0);  // nothing moved in the lowest bin
  EXPECT_NEAR(probability(found.states[2].curve, 1.3), 0.45, 1e-15);
}

TEST(Forms, ABinThatFailedItsTestHasNoParts) {
  fragility::Result result = made_results(false);
  result.edps[0].bins[2].status = fragility::BinStatus::rejected;
  EXPECT_EQ(model("incore", request(), result).states[0].curve.form, Form::discrete);
  Request wanted = request();
  wanted.form = Form::parts;
  EXPECT_THAT(error_of([&] { model("incore", wanted, result); }), HasSubstr("no three parts at pga_g 0.6"));
}

TEST(Notes, AreOfTheDemandsThatGoOut) {
  fragility::Result result = made_results();
  result.warnings = {"peak_slip_m: fails", "overturned: rare", "samples are few"};
  const Model found = model("openquake", request({"overturned"}), result);
  EXPECT_THAT(found.notes, testing::IsSupersetOf({"overturned: rare", "samples are few"}));
  EXPECT_THAT(found.notes, testing::Not(testing::Contains(HasSubstr("fails"))));
}

TEST(Falling, WithinItsBandIsPooledAndToldBeyondItRefused) {
  fragility::Result result = without_curves();
  set_surface(result.edps[1], 3, 0.63);
  const Model found = model("openquake", request({"overturned"}), result);
  EXPECT_NEAR(probability(found.states[0].curve, 1.0), 0.615, 1e-15);
  EXPECT_NEAR(probability(found.states[0].curve, 1.6), 0.615, 1e-15);
  EXPECT_NEAR(found.states[0].pooled, 0.015, 1e-15);
  EXPECT_THAT(found.notes, testing::Contains(HasSubstr("pooled, by 0.015")));
  set_surface(result.edps[1], 3, 0.7);
  EXPECT_THAT(error_of([&] { model("openquake", request({"overturned"}), result); }),
              HasSubstr("the probability of overturned falls near pga_g 1"));
}

TEST(Crossing, IsRefusedWithWhereItHappens) {
  EXPECT_THAT(error_of([] {
                model("openquake", request({"overturned", "peak_slip_m:0.05"}));
              }),
              AllOf(HasSubstr("limit states cross at pga_g"), HasSubstr("least severe first")));
  // Lognormals of other dispersions cross in the tail; their surfaces do not.
  fragility::Result result = made_results();
  result.edps[0].functions[1] = function(0.9, 0.9, true);
  EXPECT_EQ(model("openquake", request(), result).states[0].curve.form, Form::discrete);
}

TEST(EmptyRows, AreRefusedOrLeftOut) {
  fragility::Result result = without_curves();
  result.edps[1].surface.probability[2] = std::nan("");
  result.edps[1].bins[2].n = 12;
  EXPECT_THAT(error_of([&] { model("openquake", request(), result); }),
              AllOf(HasSubstr("empty row at pga_g 0.6 (12 samples"), HasSubstr("--skip-empty")));
  Request wanted = request({"overturned"});
  wanted.skip_empty = true;
  EXPECT_NEAR(probability(model("openquake", wanted, result).states[0].curve, 0.65), 0.15, 1e-15);
}

TEST(Select, RefusesACurveOfOneIntensity) {
  fragility::Result result = made_results(false);
  for (std::size_t b = 0; b + 1 < std::size(bins); ++b) set_surface(result.edps[1], b, std::nan(""));
  Request wanted = request({"overturned"});
  wanted.skip_empty = true;
  EXPECT_THAT(error_of([&] { model("openquake", wanted, result); }),
              AllOf(HasSubstr("overturned is known at one intensity only, pga_g 1.6"), HasSubstr("sweep a range")));
  EXPECT_EQ(model("csv", wanted, result).states.size(), 1u);  // a table holds what there is
}

TEST(Probabilities, AboveOneAreRefused) {
  fragility::Result result = made_results(false);
  result.edps[1].surface.probability[4] = 1.2;
  EXPECT_THAT(error_of([&] { model("openquake", request(), result); }), HasSubstr("must lie within 0 and 1"));
}

TEST(ReportsIntensity, IsPtaAtOneMu) {
  fragility::Result result = made_results();
  result.im_name = "report";
  result.im_unit = "1";
  result.cell_im = {-0.2, 0.1, 0.5, 1.2};
  result.cell_n = {4, 4, 4, 4};
  const fragility::Result pta = as_pta(result, 0.2);
  EXPECT_EQ(pta.im_name, "pta_g");
  EXPECT_NEAR(pta.im[1], 0.2 * 1.3, 1e-15);
  EXPECT_NEAR(pta.im_edge[5], 0.2 * 3, 1e-15);
  EXPECT_THAT(error_of([&] {
                Request lognormal = request({"peak_slip_m:0.05"});
                lognormal.form = Form::lognormal;
                model("openquake", lognormal, pta);
              }),
              HasSubstr("one over another intensity is none over this"));
  // A lognormal over the one is none over the other: its shares stay, at the intensities of the other.
  const fragility::FragilityFunction &over_report = result.edps[0].functions[0], &over_pta = pta.edps[0].functions[0];
  EXPECT_FALSE(over_pta.adequate);
  EXPECT_TRUE(std::isnan(over_pta.dispersion));
  ASSERT_EQ(over_pta.cell_im.size(), 4U);
  ASSERT_EQ(over_pta.cell_share.size(), 4U);
  for (std::size_t i = 0; i < over_pta.cell_im.size(); ++i) {
    const double im = over_pta.cell_im[i] / 0.2 - 1;
    EXPECT_NEAR(over_pta.cell_share[i], im > 0 ? phi(std::log(im / over_report.median) / over_report.dispersion) : 0,
                1e-12);
  }
}

}  // namespace
}  // namespace freestand::exports::test
