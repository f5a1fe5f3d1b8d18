#include "study/rounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/durable_file.hpp"
#include "base/passed_over.hpp"
#include "study/evaluator.hpp"
#include "study/known.hpp"
#include "study/study_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::rounds_test {
namespace {

const std::filesystem::path file = "run-0000.node-000000.rounds";

// Two rounds that take all, one that leaves the second of three bins out, and one that takes all again.
void add_four(Rounds& rounds) {
  rounds.add({4096});
  rounds.add({8192});
  rounds.add({16384, {true, false, true}});
  rounds.add({32768});
}

TEST(Rounds, AreReadAsTheyWereStored) {
  const freestand::test::Scratch scratch("rounds");
  const parallel::Communicator alone;
  Rounds rounds(alone, scratch.folder(), "study"), again(alone, scratch.folder(), "study"),
      others(alone, scratch.folder(), "another");
  add_four(rounds);
  again.read();
  ASSERT_EQ(again.count(), 4);
  EXPECT_EQ(again[2].end, 16384);
  EXPECT_EQ(again[2].bins, (std::vector<bool>{true, false, true}));
  EXPECT_TRUE(again[3].bins.empty());
  EXPECT_EQ(again.alike(), 8192);  // what comes after samples were passed over does not count
  for (const auto& [sample, end] : {std::pair(0, 4096), {4095, 4096}, {4096, 8192}, {16383, 16384}, {16384, 32768}})
    EXPECT_EQ(again.of(sample).end, end) << sample;
  others.read();
  EXPECT_EQ(others.count(), 0);
}

// Half of a file, or another byte in it: it is as if it were not there.
TEST(Rounds, OfASpoiltFileAreNotKnown) {
  const freestand::test::Scratch scratch("rounds");
  const parallel::Communicator alone;
  Rounds rounds(alone, scratch.folder(), "study");
  add_four(rounds);
  const std::string text = read_whole(scratch / file.string());
  for (std::size_t cut = 0; cut < text.size(); ++cut)
    for (const std::string& spoilt : {text.substr(0, cut), text.substr(0, cut) + "x" + text.substr(cut + 1)}) {
      write_durably(scratch / file.string(), spoilt);
      Rounds again(alone, scratch.folder(), "study");
      again.read();
      EXPECT_EQ(again.count(), 0) << spoilt;
    }
}

// The intensity is the peak acceleration; bins of 0.5 g, of which the second is left out.
TEST(Rounds, TakeSamplesByTheBinOfTheirIntensityAlone) {
  const Study study =
      parse_study(test::block + "friction: {mu: {uniform: [0.1, 0.6]}}\n" + test::motions +
                      "samples: 1000\nfragility: {im: pta_g, bins: {edges: [0.2, 0.5, 1, 1.8]}, edp: [delta]}\n",
                  "some.yaml", registries());
  const Evaluator evaluator(study, load_motions(study));
  const Target target(study);
  const RoundBins bins(study, target, evaluator);
  std::vector<double> some, all;
  const Evaluator::Taken taken = [&](const Table& draws) { return bins.taken({1000, {true, false, true}}, draws); };
  const std::vector<Outcome> outcomes = evaluator.append(100, 800, some, taken),
                             whole = evaluator.append(100, 800, all);
  ASSERT_EQ(some.size(), all.size());
  const std::vector<Column>& columns = evaluator.columns();
  const std::size_t width = columns.size(), pta = column_index(columns, "pta_g"),
                    delta = column_index(columns, "edp_delta"), draws = evaluator.draws(1).columns.size();
  int left_out = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const double* row = some.data() + i * width;
    const double im = row[pta];
    const bool wanted = (im >= 0.2 && im < 0.5) || (im >= 1 && im <= 1.8);
    EXPECT_EQ(outcomes[i], wanted ? whole[i] : passed_over) << im;
    for (std::size_t c = 0; c < width; ++c) {
      const double other = all[i * width + c];
      const bool same = row[c] == other || (std::isnan(row[c]) && std::isnan(other));
      EXPECT_TRUE(same || (!wanted && c >= draws)) << c;
    }
    EXPECT_TRUE(wanted || std::isnan(row[delta]));
    left_out += !wanted;
  }
  EXPECT_GT(left_out, 200);
  const std::vector<bool> everything = bins.taken({1000}, evaluator.draws(50));
  EXPECT_EQ(std::count(everything.begin(), everything.end(), true), 50);
}

}  // namespace
}  // namespace freestand::study::rounds_test
