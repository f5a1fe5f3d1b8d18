// Laws that bend while the block moves: what bends at an impact leaves the impact counted, and packs go through bends with the bits of single
// samples.
#include <gtest/gtest.h>

#include <freestand/simulate.hpp>

#include "dynamics/simulate.hpp"
#include "formula/formula.hpp"
#include "support/keyed_random.hpp"
#include "support/random_cases.hpp"
#include "support/same_bits.hpp"
#include "support/same_histories.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

struct Bend {
  const char *force, *friction;
  double low, high;  // of the parameter c
};

constexpr Bend bends[] = {{"-c*v*abs(v)", "", 0.1, 3},
                          {"-c*max(u - 0.002, 0)", "", 1, 100},
                          {"if(u - 0.003, -c*u, 0)", "", 0.01, 0.5},
                          {"-c*v*abs(v) - abs(v)*v", "", 0.1, 1},
                          {"-c*max(abs(u) - 0.001, 0)*if(u, 1, -1)", "", 1, 50},
                          {"-c*v*abs(v) - 30*c*max(u - 0.001, 0)", "", 0.1, 2},
                          {"", "mu*(1 + c*max(t - 2, 0))", 0.01, 0.3},
                          {"-c*v*abs(v)", "mu*(1 + 0.1*max(path - 0.01, 0))", 0.1, 1}};

// |v| v changes its sense where the block turns back, and touches zero where a corner comes down: there round-off may meet the bend first.
TEST(KinksInMotion, AnImpactAtABendIsCounted) {
  const dynamics::Effect drag = formula::effect("drag", "", "-c*v*abs(v)", {"c"});
  CaseFamily family;
  family.seed = 17;
  family.vertical = 0;
  int all = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const RandomCase c = random_case(family, i);
    Specimen plain = c.specimen, with = c.specimen;
    plain.model = with.model = Model::rock;
    with.effects = {{&drag, {1e-12}}};
    for (const Solver& solver : {fast_solver, reference_solver}) {
      const Response r = solver.solve(plain, c.shaking, {}, nullptr), bent = solver.solve(with, c.shaking, {}, nullptr);
      EXPECT_EQ(r.impacts, bent.impacts) << solver.name << ' ' << c.text();
      all += r.impacts;
    }
  }
  EXPECT_GT(all, 400);
}

TEST(KinksInMotion, PacksHaveTheBitsOfSingleSamples) {
  constexpr std::size_t count = 120;
  for (std::size_t b = 0; b < std::size(bends); ++b) {
    const dynamics::Effect law = formula::effect("bend", bends[b].friction, bends[b].force, {"c"});
    CaseFamily family;
    family.seed = 40 + b;
    family.one_model = 0;
    family.vertical = 0.2;
    family.duration_low_s = 3;
    family.duration_high_s = 5;
    std::vector<RandomCase> cases;
    std::vector<Specimen> specimens;
    std::vector<Shaking> shakings;
    std::vector<History> histories(count);
    for (std::size_t i = 0; i < count; ++i) cases.push_back(random_case(family, i));
    for (std::size_t i = 0; i < count; ++i) {
      KeyedRandom random(41 + b, i);
      specimens.push_back(cases[i].specimen);
      specimens.back().model = i % 4 ? Model::slide_rock : i % 8 ? Model::slide : Model::rock;
      specimens.back().effects = {{&law, {random.uniform(bends[b].low, bends[b].high)}}};
      shakings.push_back(cases[i].shaking);
      histories[i].step_s = 0.01;
    }
    const Settings settings{.tolerance = b % 2 ? 1e-8 : 1e-9};
    std::vector<Response> block(count), with_histories(count);
    respond_batch(specimens, shakings, settings, block);
    respond_batch(specimens, shakings, settings, with_histories, histories);
    int impacts = 0;
    for (std::size_t i = 0; i < count; ++i) {
      History history = histories[i];
      history.points.clear();
      history.events.clear();
      const Response alone = respond(specimens[i], shakings[i], settings, &history);
      impacts += alone.impacts;
      EXPECT_TRUE(same_bits(block[i], respond(specimens[i], shakings[i], settings))) << b << ' ' << cases[i].text();
      EXPECT_TRUE(same_bits(with_histories[i], alone)) << b << ' ' << cases[i].text();
      EXPECT_TRUE(same_histories(histories[i], history)) << b << ' ' << cases[i].text();
    }
    EXPECT_GT(impacts, 100) << b;
  }
}

}  // namespace
}  // namespace freestand::test
