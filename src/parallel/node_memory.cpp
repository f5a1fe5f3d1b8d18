#include "parallel/node_memory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <new>
#include <string>
#include <vector>

#include "parallel/requests.hpp"

namespace freestand::parallel {
namespace {

// The mutex stands before the numbers.
constexpr std::size_t words_of_mutex = (sizeof(pthread_mutex_t) + sizeof(std::int64_t) - 1) / sizeof(std::int64_t);

// Of all processes that see it; one that ends while it holds it is noticed by the next.
void make_mutex(pthread_mutex_t* mutex) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
  pthread_mutex_init(mutex, &attributes);
  pthread_mutexattr_destroy(&attributes);
}

}  // namespace

struct NodeMemory::Shared {
  std::size_t words;
  std::vector<std::int64_t> alone = {};
  std::int64_t* first = nullptr;

  explicit Shared(std::size_t numbers) : words(words_of_mutex + numbers) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() {
    if (first && alone.empty()) ::munmap(first, bytes());
  }

  std::size_t bytes() const { return words * sizeof(std::int64_t); }
  pthread_mutex_t* mutex() const { return std::launder(reinterpret_cast<pthread_mutex_t*>(first)); }

  void stay_alone() {
    alone.assign(words, 0);
    first = alone.data();
    make_mutex(mutex());
  }

  bool map(const std::string& name, int flags) {
    const int descriptor = ::shm_open(name.c_str(), O_RDWR | flags, 0600);
    if (descriptor < 0) return false;
    const auto size = static_cast<off_t>(bytes());
    const bool there = (flags & O_CREAT) == 0 || ::posix_fallocate(descriptor, 0, size) == 0;
    void* memory = there ? ::mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0) : MAP_FAILED;
    ::close(descriptor);
    if (memory == MAP_FAILED) return false;
    first = static_cast<std::int64_t*>(memory);
    if (flags & O_CREAT) make_mutex(mutex());
    return true;
  }
};

// Not by a window of MPI, which ends the program where it finds no memory to share. Where there is none, each rank is a node.
NodeMemory::NodeMemory(const Communicator& world, std::size_t numbers)
    : shared_(std::make_unique<Shared>(numbers)), node_(world.rank()) {
  if (world.size() == 1) {
    shared_->stay_alone();
    return;
  }
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, world.rank(), MPI_INFO_NULL, &node);
  int rank = 0;
  MPI_Comm_rank(node, &rank);
  static std::int64_t made = 0;  // memories of this program so far, each with a name of its own
  std::int64_t first[3] = {world.rank(), ::getpid(), made++};
  wait([&](MPI_Request* request) { return MPI_Ibcast(first, 3, MPI_INT64_T, 0, node, request); });
  const std::string name = fmt::format("/freestand.{}.{}.{}", first[1], first[0], first[2]);
  const auto mapped_by_all = [&](bool mapped) {
    int all = mapped;
    wait([&](MPI_Request* request) { return MPI_Iallreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, node, request); });
    return all == 1;
  };
  bool shared = mapped_by_all(rank != 0 || shared_->map(name, O_CREAT | O_EXCL));
  shared = shared && mapped_by_all(rank == 0 || shared_->map(name, 0));
  if (rank == 0) ::shm_unlink(name.c_str());
  MPI_Comm_free(&node);
  if (shared) {
    node_ = first[0];
  } else {
    shared_ = std::make_unique<Shared>(numbers);
    shared_->stay_alone();
  }
}

NodeMemory::~NodeMemory() = default;
NodeMemory::NodeMemory(NodeMemory&&) noexcept = default;
NodeMemory& NodeMemory::operator=(NodeMemory&&) noexcept = default;

std::span<std::int64_t> NodeMemory::numbers() {
  return {shared_->first + words_of_mutex, shared_->words - words_of_mutex};
}

std::int64_t NodeMemory::fetch_add(std::size_t position, std::int64_t amount) {
  return std::atomic_ref<std::int64_t>(numbers()[position]).fetch_add(amount);
}

NodeMemory::Lock::Lock(NodeMemory& memory) : memory_(memory) {
  const int error = pthread_mutex_lock(memory_.shared_->mutex());
  if (error == 0) return;
  if (error == EOWNERDEAD) pthread_mutex_unlock(memory_.shared_->mutex());  // for good: no other rank goes on either
  throw Error("a process of this node has ended while it added to what all of them count: start again with --resume",
              Exit::resumable);
}

NodeMemory::Lock::~Lock() { pthread_mutex_unlock(memory_.shared_->mutex()); }

}  // namespace freestand::parallel
