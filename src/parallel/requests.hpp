// Waiting for MPI without holding the core. Only for the sources of this folder.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <thread>

#include "parallel/mpi.hpp"

namespace freestand::parallel {

// Starts a transfer, start(&request), and waits for it: first in a tight loop, because most are over in microseconds,
// then with short sleeps, so that ranks that wait leave the cores to ranks that compute. MPI ends the program on
// errors.
template <class Start, class While>
void wait(const Start& start, const While& meanwhile) {
  MPI_Request request = MPI_REQUEST_NULL;
  start(&request);
  int done = 0;
  for (int tries = 0; !done; ++tries) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done || tries < 200) continue;
    meanwhile();
    std::this_thread::sleep_for(std::chrono::microseconds(tries < 2000 ? 50 : 500));
  }
}

template <class Start>
void wait(const Start& start) {
  wait(start, [] {});
}

// MPI counts elements with int; longer messages go in parts.
template <class Transfer>
void in_parts(std::size_t length, const Transfer& transfer) {
  constexpr std::size_t part_length = std::size_t{1} << 27;
  for (std::size_t first = 0; first < length; first += part_length)
    transfer(first, static_cast<int>(std::min(part_length, length - first)));
}

}  // namespace freestand::parallel
