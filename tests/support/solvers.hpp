// The two integrators under one name each, so that a test can run on both.
#pragma once

#include <freestand/simulate.hpp>
#include <ostream>

namespace freestand::test {

struct Solver {
  const char* name;
  Response (*solve)(const Specimen&, const Shaking&, const Settings&, History*);

  Response operator()(const Specimen& specimen, const Shaking& shaking, const Settings& settings = {},
                      History* history = nullptr) const {
    return solve(specimen, shaking, settings, history);
  }
};
inline std::ostream& operator<<(std::ostream& out, const Solver& solver) { return out << solver.name; }

inline constexpr Solver fast_solver{"fast", respond};
inline constexpr Solver reference_solver{"reference", respond_reference};

}  // namespace freestand::test

// A parameterised test suite that runs on both integrators.
#define FREESTAND_ON_BOTH_SOLVERS(suite)                                                                     \
  class suite : public testing::TestWithParam<freestand::test::Solver> {};                                   \
  INSTANTIATE_TEST_SUITE_P(Both, suite,                                                                      \
                           testing::Values(freestand::test::fast_solver, freestand::test::reference_solver), \
                           [](const auto& solver) { return std::string(solver.param.name); })
