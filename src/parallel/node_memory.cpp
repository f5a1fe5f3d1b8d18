#include "parallel/node_memory.hpp"

#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <new>

namespace freestand::parallel {
namespace {

// The mutex stands before the numbers.
constexpr std::size_t bytes_of_mutex =
    (sizeof(pthread_mutex_t) + sizeof(std::int64_t) - 1) / sizeof(std::int64_t) * sizeof(std::int64_t);

pthread_mutex_t* mutex_in(std::byte* memory) { return std::launder(reinterpret_cast<pthread_mutex_t*>(memory)); }

// Of all processes that see it; one that ends while it holds it is noticed by the next.
void make_mutex(std::byte* memory) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
  pthread_mutex_init(mutex_in(memory), &attributes);
  pthread_mutexattr_destroy(&attributes);
}

}  // namespace

NodeMemory::NodeMemory(const Communicator& world, std::size_t numbers)
    : pages_(node_pages(world, bytes_of_mutex + numbers * sizeof(std::int64_t), make_mutex)), numbers_(numbers) {}

std::span<std::int64_t> NodeMemory::numbers() {
  return {std::launder(reinterpret_cast<std::int64_t*>(pages_.first.get() + bytes_of_mutex)), numbers_};
}

std::int64_t NodeMemory::fetch_add(std::size_t position, std::int64_t amount) {
  return std::atomic_ref<std::int64_t>(numbers()[position]).fetch_add(amount);
}

NodeMemory::Lock::Lock(NodeMemory& memory) : memory_(memory) {
  pthread_mutex_t* mutex = mutex_in(memory_.pages_.first.get());
  const int error = pthread_mutex_lock(mutex);
  if (error == 0) return;
  if (error == EOWNERDEAD) pthread_mutex_unlock(mutex);  // for good: no other rank goes on either
  throw Error("a process of this node has ended while it added to what all of them count: start again with --resume",
              Exit::resumable);
}

NodeMemory::Lock::~Lock() { pthread_mutex_unlock(mutex_in(memory_.pages_.first.get())); }

}  // namespace freestand::parallel
