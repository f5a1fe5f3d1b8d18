// Writes a samples.h5 of 150,000 rows, some hundred kilobytes, into the folder of its first argument; run by full_disk.sh.
#include <cstdio>

#include "io/samples_file.hpp"
#include "parallel/communicator.hpp"
#include "support/sample_blocks.hpp"

using namespace freestand;

int main(int argc, char** argv) {
  const parallel::Session session(&argc, &argv);
  try {
    const io::BlockLayout layout{150000, 1000};
    io::write_samples(session.world(), std::filesystem::path(argv[1]) / "samples.h5", test::small_header(), layout,
                      test::small_blocks(layout));
    return 0;
  } catch (const Error& error) {
    return parallel::end_run(session.world(), error);
  }
}
