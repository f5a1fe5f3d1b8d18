#include "parallel/node_copy.hpp"

#include <sys/mman.h>

#include "parallel/node_pages.hpp"
#include "parallel/requests.hpp"

namespace freestand::parallel {

NodeCopy copy_to_nodes(const Communicator& world, std::size_t size, const std::function<void(std::byte*)>& fill) {
  const NodePages pages = node_pages(world, size, [](std::byte*) {});
  const bool receives = pages.node == world.rank();
  MPI_Comm receivers = MPI_COMM_NULL;
  if (world.size() > 1) MPI_Comm_split(MPI_COMM_WORLD, receives ? 0 : MPI_UNDEFINED, world.rank(), &receivers);
  if (world.is_root()) fill(pages.first.get());
  if (receivers != MPI_COMM_NULL) {
    in_parts(size, [&](std::size_t first, int count) {
      wait([&](MPI_Request* request) {
        return MPI_Ibcast(pages.first.get() + first, count, MPI_BYTE, 0, receivers, request);
      });
    });
    MPI_Comm_free(&receivers);
  }
  Words refused{pages.refused ? 1 : 0};
  world.sum_in_place(refused);  // after which all have received
  ::mprotect(pages.first.get(), size, PROT_READ);
  return {pages.first, refused[0]};
}

}  // namespace freestand::parallel
