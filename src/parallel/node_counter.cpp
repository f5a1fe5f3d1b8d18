#include "parallel/node_counter.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <string>

#include "parallel/requests.hpp"

namespace freestand::parallel {

struct NodeCounter::Shared {
  std::int64_t alone = 0;
  std::int64_t* value = &alone;

  bool map(const std::string& name, int flags) {
    const int descriptor = ::shm_open(name.c_str(), O_RDWR | flags, 0600);
    if (descriptor < 0) return false;
    const bool there = (flags & O_CREAT) == 0 || ::posix_fallocate(descriptor, 0, sizeof(std::int64_t)) == 0;
    void* memory =
        there ? ::mmap(nullptr, sizeof(std::int64_t), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0) : MAP_FAILED;
    ::close(descriptor);
    if (memory == MAP_FAILED) return false;
    value = static_cast<std::int64_t*>(memory);
    return true;
  }

  ~Shared() {
    if (value != &alone) ::munmap(value, sizeof(std::int64_t));
  }
};

// Not by a window of MPI, which ends the program where it finds no memory to share. Where there is none, each rank is a node.
NodeCounter::NodeCounter(const Communicator& world) : shared_(std::make_unique<Shared>()), node_(world.rank()) {
  if (world.size() == 1) return;
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, world.rank(), MPI_INFO_NULL, &node);
  int rank = 0;
  MPI_Comm_rank(node, &rank);
  std::int64_t first[2] = {world.rank(), ::getpid()};
  wait([&](MPI_Request* request) { return MPI_Ibcast(first, 2, MPI_INT64_T, 0, node, request); });
  const std::string name = fmt::format("/freestand.{}.{}", first[1], first[0]);
  const auto mapped_by_all = [&](bool mapped) {
    int all = mapped;
    wait([&](MPI_Request* request) { return MPI_Iallreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, node, request); });
    return all == 1;
  };
  bool shared = mapped_by_all(rank != 0 || shared_->map(name, O_CREAT | O_EXCL));
  shared = shared && mapped_by_all(rank == 0 || shared_->map(name, 0));
  if (rank == 0) ::shm_unlink(name.c_str());
  MPI_Comm_free(&node);
  if (shared)
    node_ = first[0];
  else
    shared_ = std::make_unique<Shared>();
}

NodeCounter::~NodeCounter() = default;
NodeCounter::NodeCounter(NodeCounter&&) noexcept = default;
NodeCounter& NodeCounter::operator=(NodeCounter&&) noexcept = default;

std::int64_t NodeCounter::fetch_add(std::int64_t amount) {
  return std::atomic_ref<std::int64_t>(*shared_->value).fetch_add(amount);
}

}  // namespace freestand::parallel
