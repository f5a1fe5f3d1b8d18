// A tally as words. A 128-bit sum is split into four parts of 32 bits, each in a 64-bit word, so that words may be
// added element by element without a carry being lost.
#include <fmt/format.h>

#include <freestand/error.hpp>

#include "fragility/tally.hpp"

namespace freestand::fragility {
namespace {

__extension__ using Wide = __int128;
constexpr std::uint64_t part_mask = 0xffffffffULL;

void append(std::vector<std::int64_t>& words, const ExactSum& sum) {
  words.push_back(static_cast<std::int64_t>(sum.low() & part_mask));
  words.push_back(static_cast<std::int64_t>(sum.low() >> 32));
  words.push_back(sum.high() & static_cast<std::int64_t>(part_mask));
  words.push_back(sum.high() >> 32);
}

ExactSum joined(std::span<const std::int64_t> parts) {
  Wide total = parts[3];
  for (int i = 2; i >= 0; --i) total = total * (Wide{1} << 32) + parts[static_cast<std::size_t>(i)];
  return ExactSum::from_words(static_cast<std::int64_t>(total >> 64), static_cast<std::uint64_t>(total));
}

}  // namespace

std::vector<std::int64_t> Tally::words() const {
  std::vector<std::int64_t> words(count_);
  words.reserve(count_.size() + 4 * sum_.size());
  for (const ExactSum& sum : sum_) append(words, sum);
  return words;
}

Tally Tally::from_words(Options options, std::span<const std::int64_t> words) {
  Tally tally(std::move(options));
  const std::size_t counts = tally.count_.size(), expected = counts + 4 * tally.sum_.size();
  if (words.size() != expected)
    throw Error(fmt::format("a tally cannot be read ({} words, not {}): it was counted with other options",
                            words.size(), expected),
                Exit::data);
  for (std::size_t i = 0; i < counts; ++i) tally.count_[i] = words[i];
  for (std::size_t i = 0; i < tally.sum_.size(); ++i) tally.sum_[i] = joined(words.subspan(counts + 4 * i, 4));
  return tally;
}

}  // namespace freestand::fragility
