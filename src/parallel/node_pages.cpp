#include "parallel/node_pages.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <string>

#include "parallel/node_ranks.hpp"
#include "parallel/requests.hpp"

namespace freestand::parallel {
namespace {

std::shared_ptr<std::byte> mapped(std::size_t bytes, int kind, int descriptor) {
  void* first = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, kind, descriptor, 0);
  if (first == MAP_FAILED) return nullptr;
  return {static_cast<std::byte*>(first), [bytes](std::byte* p) { ::munmap(p, bytes); }};
}

// Null on all ranks of a node that cannot share. The memory loses its name before it takes room, so that none is left
// behind by ranks that are killed.
std::shared_ptr<std::byte> shared_pages(MPI_Comm node, int rank, const std::string& name, std::size_t bytes,
                                        const std::function<void(std::byte*)>& begin) {
  const auto on_all = [&](bool mine) {
    int all = mine;
    wait([&](MPI_Request* request) { return MPI_Iallreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, node, request); });
    return all == 1;
  };
  const bool lowest = rank == 0;
  int descriptor = lowest ? ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600) : -1;
  const bool made = on_all(!lowest || descriptor >= 0);
  if (made && !lowest) descriptor = ::shm_open(name.c_str(), O_RDWR, 0);
  const bool opened = on_all(descriptor >= 0);
  if (lowest && made) ::shm_unlink(name.c_str());
  const bool fits = on_all(opened && (!lowest || ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes)) == 0));
  std::shared_ptr<std::byte> pages = fits ? mapped(bytes, MAP_SHARED, descriptor) : nullptr;
  if (descriptor >= 0) ::close(descriptor);
  if (lowest && pages) begin(pages.get());
  return on_all(pages != nullptr) ? pages : nullptr;
}

}  // namespace

// Not by a window of MPI: where there is no room for one, Open MPI tells the first rank of a node and leaves the others waiting.
NodePages node_pages(const Communicator& world, std::size_t bytes, const std::function<void(std::byte*)>& begin) {
  NodePages pages{nullptr, world.rank()};
  bytes = std::max(bytes, std::size_t{1});
  if (const NodeRanks node(world); node.size > 1) {
    static std::int64_t made = 0;  // memories of this program so far, each with a name of its own
    std::int64_t lowest[3] = {world.rank(), ::getpid(), made++};
    wait([&](MPI_Request* request) { return MPI_Ibcast(lowest, 3, MPI_INT64_T, 0, node.among, request); });
    const std::string name = fmt::format("/freestand.{}.{}.{}", lowest[1], lowest[0], lowest[2]);
    pages.first = shared_pages(node.among, node.rank, name, bytes, begin);
    if (pages.first) pages.node = lowest[0];
    pages.refused = !pages.first;
  }
  if (pages.first) return pages;
  pages.first = mapped(bytes, MAP_PRIVATE | MAP_ANONYMOUS, -1);
  if (!pages.first) throw std::bad_alloc();
  begin(pages.first.get());
  return pages;
}

}  // namespace freestand::parallel
