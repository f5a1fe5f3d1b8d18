// The numbers of a floor motion in a row, which may lie in memory that others hold too.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace freestand {

// Rows start where a cache line does, so that a pack of a run never lies across two.
//
// `held`: n values that are there already, for a vector that is made with n values: it reads these and must not be changed
// in place. They stay as long as it does; copies of it, and what it grows into, have values of their own. So the ranks
// of a node share the records of a sweep.
template <class T>
class LineAllocator {
 public:
  using value_type = T;
  using is_always_equal = std::false_type;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;
  static constexpr std::align_val_t line{64};

  LineAllocator() = default;
  LineAllocator(std::shared_ptr<const T> held, std::size_t n) : held_(std::move(held)), n_(n) {}
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  LineAllocator select_on_container_copy_construction() const { return {}; }

  T* allocate(std::size_t n) {
    if (held_ && n == n_ && !std::exchange(given_, true)) return const_cast<T*>(held_.get());
    return static_cast<T*>(::operator new(n * sizeof(T), line));
  }
  void deallocate(T* p, std::size_t) {
    if (!holds(p)) ::operator delete(p, line);
  }
  // What is there stays as it is.
  template <class U>
  void construct(U* p) {
    if (!holds(p)) ::new (static_cast<void*>(p)) U();
  }
  bool operator==(const LineAllocator& other) const { return held_ == other.held_; }

 private:
  bool holds(const T* p) const { return held_ && p >= held_.get() && p < held_.get() + n_; }
  std::shared_ptr<const T> held_;
  std::size_t n_ = 0;
  bool given_ = false;
};

using MotionValues = std::vector<double, LineAllocator<double>>;

}  // namespace freestand
