#include "parallel/block_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <freestand/error.hpp>
#include <system_error>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "parallel/block_log.hpp"
#include "parallel/progress.hpp"
#include "parallel/run_files.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* extension = "sums";
constexpr std::int64_t bits = 64;
// A node's file is written after a second, and again after as long as the run has lasted, but ten seconds at most: a kill costs no
// more than half of the run, and no more than these; where writing takes long, after a hundred times as long, but a minute at most.
constexpr std::int64_t first_pause_ns = 1'000'000'000, longest_pause_ns = 10'000'000'000, pause_per_writing = 100,
                       longest_of_all_ns = 60'000'000'000;

struct SumsHeader {
  std::array<char, 8> magic = {'F', 'S', 'S', 'U', 'M', 'S', '\0', '\0'};
  std::uint32_t format = 1;
  std::uint32_t kernel = 0;
  std::array<char, 64> fingerprint{};
  std::int64_t blocks = 0, words = 0;
  std::uint64_t content_checksum = 0, checksum = 0;

  std::uint64_t expected_checksum() const {
    return fnv1a(std::as_bytes(std::span(this, 1)).first(offsetof(SumsHeader, checksum)));
  }
  std::int64_t words_of_set() const { return (blocks + bits - 1) / bits; }
  std::string fingerprint_text() const {
    return {fingerprint.begin(), std::find(fingerprint.begin(), fingerprint.end(), '\0')};
  }
};
static_assert(sizeof(SumsHeader) == 112 && std::is_trivially_copyable_v<SumsHeader>);

// Where the node's memory holds what.
enum Position : std::size_t { began, next_writing, writing, set };

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

bool bit(const Words& set, std::int64_t i) {
  return (static_cast<std::uint64_t>(set[static_cast<std::size_t>(i / bits)]) >> (i % bits)) & 1;
}

struct Parts {
  SumsHeader header;
  std::string_view set, sums;
};

// Throws Error (Exit::data) if it is not whole.
Parts parts_of(const std::string& file, const fs::path& path) {
  Parts parts;
  const auto reject = [&] {
    throw Error(fmt::format("{} cannot be used (it is torn or damaged): its blocks are counted again", path.string()),
                Exit::data);
  };
  if (file.size() < sizeof(SumsHeader)) reject();
  std::memcpy(&parts.header, file.data(), sizeof(SumsHeader));
  const SumsHeader& header = parts.header;
  const SumsHeader expected;
  if (header.magic != expected.magic || header.format != expected.format ||
      header.checksum != header.expected_checksum() || header.blocks < 0 || header.words < 0)
    reject();
  const std::string_view content = std::string_view(file).substr(sizeof(SumsHeader));
  const auto most = static_cast<std::int64_t>(content.size());  // sizes beyond it may have no sum
  if (header.blocks / bits > most || header.words > most) reject();
  const auto set_bytes = static_cast<std::size_t>(header.words_of_set()) * sizeof(std::int64_t);
  if (content.size() != set_bytes + static_cast<std::size_t>(header.words) * sizeof(std::int64_t) ||
      fnv1a(std::as_bytes(std::span(content))) != header.content_checksum)
    reject();
  parts.set = content.substr(0, set_bytes);
  parts.sums = content.substr(set_bytes);
  return parts;
}

Words words_in(std::string_view bytes) {
  Words words(bytes.size() / sizeof(std::int64_t));
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

void add_to(Words& sums, const Words& more) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += more[i];
}

// The files that count: of the last run whose first node has one, since that begins with all before.
std::vector<RunFile> valid_files(const fs::path& folder) {
  std::vector<RunFile> files = run_files(folder, extension);
  std::int64_t last = -1;
  for (const RunFile& file : files)
    if (file.node == 0) last = std::max(last, file.run);
  std::erase_if(files, [&](const RunFile& file) { return file.run != last; });
  return files;
}

}  // namespace

BlockSums::BlockSums(fs::path folder, std::string fingerprint, std::uint32_t kernel, std::int64_t blocks,
                     std::size_t words)
    : folder_(std::move(folder)),
      fingerprint_(std::move(fingerprint)),
      kernel_(kernel),
      blocks_(blocks),
      words_(words) {
  if (fingerprint_.size() > sizeof(SumsHeader::fingerprint))
    throw Error(
        fmt::format("study fingerprint \"{}\" cannot be stored (64 characters at most): shorten it", fingerprint_));
  make_folder(folder_);
}

std::size_t BlockSums::bytes() const {
  return sizeof(SumsHeader) + sizeof(std::int64_t) * (static_cast<std::size_t>((blocks_ + bits - 1) / bits) + words_);
}

fs::path BlockSums::file() const { return run_file(folder_, run_, memory_->node(), extension); }

BlockSums::Content BlockSums::read(const fs::path& path) const {
  const std::string file = read_whole(path);
  const Parts parts = parts_of(file, path);
  if (const std::string other = parts.header.fingerprint_text(); other != fingerprint_)
    throw OtherBlocks(fmt::format("{} holds counts of another study: choose another output folder", folder_.string()),
                      other);
  if (parts.header.kernel != kernel_)
    throw Error(fmt::format(
        "{} holds counts of another version of freestand or kind of machine, which gives other numbers (kernel {:08x}, "
        "this one's is {:08x}): resume with the program it was started with, there, or start again with "
        "--overwrite",
        folder_.string(), parts.header.kernel, kernel_));
  if (parts.header.blocks != blocks_ || static_cast<std::size_t>(parts.header.words) != words_)
    throw Error(
        fmt::format("{} cannot be used (it counts something else): its blocks are counted again", path.string()),
        Exit::data);
  return {words_in(parts.set), words_in(parts.sums)};
}

void BlockSums::find() {
  remove_asides(folder_);
  before_ = {Words(static_cast<std::size_t>((blocks_ + bits - 1) / bits)), Words(words_)};
  for (const RunFile& file : valid_files(folder_)) {
    try {
      const Content content = read(file.path);
      add_to(before_.blocks, content.blocks);  // no block is in two files
      add_to(before_.sums, content.sums);
    } catch (const Error& error) {
      if (error.exit() != Exit::data) throw;
      tell(std::string(error.what()) + "\n");
    }
  }
  run_ = 0;
  for (const RunFile& file : run_files(folder_, extension)) run_ = std::max(run_, file.run);
}

void BlockSums::begin(const Communicator& world) {
  run_ = world.broadcast(Words{run_ + 1}).front();
  memory_.emplace(world, set + static_cast<std::size_t>((blocks_ + bits - 1) / bits) + words_);
  before_.blocks = world.broadcast(std::move(before_.blocks));
  world.on_root([&] {
    const auto numbers = memory_->numbers();
    std::copy(before_.sums.begin(), before_.sums.end(),
              std::copy(before_.blocks.begin(), before_.blocks.end(), numbers.begin() + set));
    write_file(before_);
    remove_run_files(folder_, extension, run_);
  });
  before_.sums.clear();
  if (world.rank() == memory_->node()) {
    memory_->numbers()[began] = now_ns();
    memory_->numbers()[next_writing] = now_ns() + first_pause_ns;
  }
  world.barrier();
}

bool BlockSums::has(std::int64_t block) const { return bit(before_.blocks, block); }

std::int64_t BlockSums::end() const {
  std::int64_t block = blocks_;
  while (block > 0 && !has(block - 1)) --block;
  return block;
}

double BlockSums::add(std::span<const std::int64_t> blocks, std::span<const std::int64_t> words) {
  Content due;
  const std::int64_t came = now_ns();
  double added = 0;
  {
    const NodeMemory::Lock lock(*memory_);
    const auto numbers = memory_->numbers();
    for (const std::int64_t block : blocks)
      numbers[set + static_cast<std::size_t>(block / bits)] |= static_cast<std::int64_t>(1ULL << (block % bits));
    const auto sums = numbers.last(words_);
    for (std::size_t i = 0; i < words_; ++i) sums[i] += words[i];
    added = 1e-9 * static_cast<double>(now_ns() - came);
    if (numbers[writing] || now_ns() < numbers[next_writing]) return added;
    numbers[writing] = 1;
    due = content();
  }
  const std::int64_t start = now_ns();
  write_file(due);
  const std::int64_t end = now_ns();
  const NodeMemory::Lock lock(*memory_);
  const auto numbers = memory_->numbers();
  numbers[next_writing] = end + std::max(std::min(end - numbers[began], longest_pause_ns),
                                         std::min(pause_per_writing * (end - start), longest_of_all_ns));
  numbers[writing] = 0;
  return added;
}

BlockSums::Content BlockSums::content() {
  const auto numbers = memory_->numbers().subspan(set);
  return {Words(numbers.begin(), numbers.end() - static_cast<std::ptrdiff_t>(words_)),
          Words(numbers.end() - static_cast<std::ptrdiff_t>(words_), numbers.end())};
}

void BlockSums::write(const Communicator& world) {
  world.barrier();
  if (world.rank() == memory_->node()) write_file(content());
  world.barrier();
}

void BlockSums::write_file(const Content& content) const {
  SumsHeader header;
  header.kernel = kernel_;
  std::copy(fingerprint_.begin(), fingerprint_.end(), header.fingerprint.begin());
  header.blocks = blocks_;
  header.words = static_cast<std::int64_t>(words_);
  Words all = content.blocks;
  all.insert(all.end(), content.sums.begin(), content.sums.end());
  header.content_checksum = fnv1a(std::as_bytes(std::span(all)));
  header.checksum = header.expected_checksum();
  const std::array<std::span<const std::byte>, 2> pieces{std::as_bytes(std::span(&header, 1)),
                                                         std::as_bytes(std::span(all))};
  write_durably(file(), pieces);
}

Words BlockSums::total(const Communicator& world) {
  world.barrier();
  Words sums = world.rank() == memory_->node() ? content().sums : Words(words_);
  world.sum_in_place(sums);
  return sums;
}

std::int64_t count_summed_blocks(const fs::path& folder) {
  std::int64_t count = 0;
  for (const RunFile& file : valid_files(folder)) {
    try {
      const std::string text = read_whole(file.path);
      for (const std::int64_t word : words_in(parts_of(text, file.path).set))
        count += std::popcount(static_cast<std::uint64_t>(word));
    } catch (const Error&) {  // damaged: it counts for nothing
    }
  }
  return count;
}

}  // namespace freestand::parallel
