#include "mpi/mpi_main.hpp"

#include <gtest/gtest.h>

namespace freestand::test {
namespace {
parallel::Communicator the_world;
}
const parallel::Communicator& world() { return the_world; }
}  // namespace freestand::test

int main(int argc, char** argv) {
  const freestand::parallel::Session session(&argc, &argv);
  freestand::test::the_world = session.world();
  testing::InitGoogleTest(&argc, argv);
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  if (!session.world().is_root()) delete listeners.Release(listeners.default_result_printer());
  const bool failed = RUN_ALL_TESTS() != 0;
  if (failed) std::fprintf(stderr, "rank %d: a test failed\n", session.world().rank());
  return session.world().any(failed) ? 1 : 0;
}
