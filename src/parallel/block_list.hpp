// Numbers of blocks as runs of consecutive ones: what is open of a sweep, which is nearly all or nearly none of it, takes a few bytes whatever
// the number of blocks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace freestand::parallel {

class BlockList {
 public:
  BlockList() = default;
  BlockList(std::initializer_list<std::int64_t> blocks) : BlockList(std::vector<std::int64_t>(blocks)) {}
  BlockList(const std::vector<std::int64_t>& blocks) {
    for (const std::int64_t block : blocks) push_back(block);
  }

  void push_back(std::int64_t block) {
    if (runs_.empty() || block != runs_.back().block + (size_ - runs_.back().place)) runs_.push_back({size_, block});
    ++size_;
  }

  std::int64_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // place: 0 ... size() - 1.
  std::int64_t operator[](std::int64_t place) const {
    const auto after = std::upper_bound(runs_.begin(), runs_.end(), place,
                                        [](std::int64_t wanted, const Run& run) { return wanted < run.place; });
    const Run& run = *(after - 1);
    return run.block + (place - run.place);
  }

 private:
  struct Run {
    std::int64_t place, block;  // of its first block: its place among all, and its number
  };
  std::vector<Run> runs_;
  std::int64_t size_ = 0;
};

}  // namespace freestand::parallel
