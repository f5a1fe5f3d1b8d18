#include "parallel/block_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <system_error>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "base/open_file.hpp"
#include "parallel/progress.hpp"
#include "parallel/run_files.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "block logs are little endian");

// Blocks begin at pages: ranks of one node never write into the same one, and after a gap the next is soon found.
constexpr std::int64_t page = 4096;

// 10^4 ranks that opened their log for every block would ask the server of names 10^4 times a second.
constexpr std::chrono::seconds open_for{10};

struct Header {
  std::array<char, 8> magic = {'F', 'S', 'B', 'L', 'O', 'C', 'K', 'S'};
  std::uint32_t format = 3;
  std::uint32_t kernel = 0;
  std::int64_t block = 0, rows = 0, columns = 0;
  std::array<char, 64> fingerprint{};
  std::uint64_t values_checksum = 0, checksum = 0;

  std::int64_t bytes() const;  // of the block
};
static_assert(sizeof(Header) == 120 && std::is_trivially_copyable_v<Header>);

std::int64_t Header::bytes() const {
  return static_cast<std::int64_t>(sizeof(Header) + sizeof(double) * static_cast<std::size_t>(rows * columns));
}

std::uint64_t checksum_of(const Header& header) {
  return fnv1a(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, checksum)));
}

std::int64_t whole_pages(std::int64_t bytes) { return (bytes + page - 1) / page * page; }

std::string text_of(const std::array<char, 64>& fingerprint) {
  return {fingerprint.begin(), std::find(fingerprint.begin(), fingerprint.end(), '\0')};
}

// The header at this place, if a block begins there that the file has room for. empty: nothing was ever written there.
std::optional<Header> header_at(const OpenFile& file, std::int64_t offset, std::int64_t file_size,
                                bool* empty = nullptr) {
  Header header;
  const Header expected;
  const auto bytes = std::as_writable_bytes(std::span(&header, 1));
  const bool read = file.read(bytes, offset);
  if (empty) *empty = read && std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{}; });
  if (!read) return {};
  if (header.magic != expected.magic || header.format != expected.format || header.checksum != checksum_of(header))
    return {};
  if (header.rows < 0 || header.columns <= 0 || header.rows > file_size / header.columns) return {};
  if (offset + header.bytes() > file_size) return {};
  return header;
}

// Calls found(header, offset) for each block that begins at `from` or behind it, before `to`, pages both; for none where the log cannot be
// read. In the middle of a block there is no header, so that it is stepped over page by page. Answers how many places hold something, and no
// block: what a killed rank had begun, or what was damaged. (Before the first block of a part may lie the end of one of the part before.)
std::int64_t for_each_header(const fs::path& path, std::int64_t from, std::int64_t to,
                             const std::function<void(const Header&, std::int64_t)>& found) {
  const OpenFile file(path, O_RDONLY);
  if (!file) return 0;
  const std::int64_t size = file.size();
  std::int64_t torn = 0;
  bool known = from == 0, empty = false, in_torn = false;
  for (std::int64_t offset = from; offset < std::min(to, size);) {
    const auto header = header_at(file, offset, size, &empty);
    if (header) found(*header, offset);
    known |= header.has_value();
    const bool something = known && !header && !empty;
    torn += something && !in_torn;
    in_torn = something;
    offset += header ? whole_pages(header->bytes()) : page;
  }
  return torn;
}

}  // namespace

BlockLog::BlockLog(fs::path folder, std::string fingerprint, std::uint32_t kernel, std::int64_t part)
    : folder_(std::move(folder)), fingerprint_(std::move(fingerprint)), kernel_(kernel), part_(whole_pages(part)) {
  if (fingerprint_.empty() || fingerprint_.size() > sizeof(Header::fingerprint))
    throw Error(
        fmt::format("study fingerprint \"{}\" cannot be stored (1 to 64 characters): shorten it", fingerprint_));
  make_folder(folder_);
}

fs::path BlockLog::log(std::int64_t run, std::int64_t node) const { return run_file(folder_, run, node, "log"); }

void BlockLog::look(const Communicator& world) {
  Words parts;  // run, node and first byte of each: all ranks share what the root sees
  if (world.is_root())
    for (const RunFile& log : run_files(folder_, "log"))
      for (std::int64_t from = 0, size = OpenFile(log.path, O_RDONLY).size(); from == 0 || from < size; from += part_)
        parts.insert(parts.end(), {log.run, log.node, from});
  parts = world.broadcast(std::move(parts));
  run_ = 0;
  places_.clear();
  Words mine{-1, 0};  // a part of a log of another study or kernel, what is torn, then all places
  torn_ = 0;
  for (std::size_t i = 0; 3 * i < parts.size(); ++i) {
    const RunFile file{parts[3 * i], parts[3 * i + 1], log(parts[3 * i], parts[3 * i + 1])};
    run_ = std::max(run_, file.run);
    if (static_cast<int>(i % static_cast<std::size_t>(world.size())) != world.rank()) continue;
    try {
      look_into(file, parts[3 * i + 2], parts[3 * i + 2] + part_);
    } catch (const Error&) {
      mine[0] = static_cast<std::int64_t>(i);
    }
  }
  for (const Place& place : std::exchange(places_, {}))
    mine.insert(mine.end(), {place.block, place.run, place.node, place.offset});
  mine[1] = torn_;
  torn_ = 0;
  other_.reset();
  for (const Words& one : world.gather(mine)) {
    if (one[0] >= 0) {
      const auto other = static_cast<std::size_t>(3 * one[0]);
      other_ = {parts[other], parts[other + 1], log(parts[other], parts[other + 1])};
    }
    torn_ += one[1];
    for (std::size_t i = 2; i < one.size(); i += 4) places_.push_back({one[i], one[i + 1], one[i + 2], one[i + 3]});
  }
  keep_latest();
  looked_ = true;
}

void BlockLog::find() {
  if (!looked_) look(Communicator());
  looked_ = false;
  if (other_) look_into(*other_, 0, std::numeric_limits<std::int64_t>::max());
}

void BlockLog::look_into(const RunFile& log, std::int64_t from, std::int64_t to) {
  torn_ += for_each_header(log.path, from, to, [&](const Header& header, std::int64_t offset) {
    if (const std::string other = text_of(header.fingerprint); other != fingerprint_)
      throw OtherBlocks(
          fmt::format("{} holds samples of another study (its fingerprint is {}, this study's is {}): resume with "
                      "the study and records it was started with, or choose another output folder",
                      folder_.string(), other, fingerprint_),
          other);
    if (header.kernel != kernel_)
      throw Error(
          fmt::format("{} holds samples of another version of freestand or kind of machine, which gives other numbers "
                      "(kernel {:08x}, "
                      "this one's is {:08x}): resume with the program it was started with, there, or start again with "
                      "--overwrite",
                      folder_.string(), header.kernel, kernel_));
    places_.push_back({header.block, log.run, log.node, offset});
  });
}

// Of several places of one block the last: of the last run, and there the farthest behind.
void BlockLog::keep_latest() {
  std::sort(places_.begin(), places_.end(), std::greater<>());
  places_.erase(
      std::unique(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.block == b.block; }),
      places_.end());
  std::reverse(places_.begin(), places_.end());
}

std::vector<std::int64_t> BlockLog::begin(const Communicator& world) {
  run_ = world.broadcast(Words{run_ + 1}).front();
  end_.emplace(world, 1);
  if (world.is_root()) written_ = std::move(places_);
  places_.clear();
  share(world);

  Words damaged(places_.size(), 0);
  for (std::size_t i = static_cast<std::size_t>(world.rank()); i < places_.size();
       i += static_cast<std::size_t>(world.size()))
    damaged[i] = !is_whole(places_[i]);
  world.sum_in_place(damaged);
  std::vector<Place> whole;
  std::vector<std::int64_t> blocks;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (!damaged[i]) whole.push_back(places_[i]), blocks.push_back(places_[i].block);
  if (const std::size_t lost = places_.size() - whole.size(); lost > 0 && world.is_root())
    tell(fmt::format("{} of {} finished blocks in {} cannot be used (torn or damaged): computed again\n", lost,
                     places_.size(), folder_.string()));
  if (torn_ > 0 && world.is_root())
    tell(fmt::format(
        "{} place{} in the logs of {} hold{} no whole block (torn or damaged): what was there is computed again\n",
        torn_, torn_ == 1 ? "" : "s", folder_.string(), torn_ == 1 ? "s" : ""));
  places_ = std::move(whole);
  return blocks;
}

bool BlockLog::is_whole(const Place& place) const {
  try {
    read(place.block);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void BlockLog::write(std::int64_t block, const BlockRows& rows) {
  Header header;
  header.kernel = kernel_;
  header.block = block;
  header.rows = rows.rows();
  header.columns = rows.columns;
  std::copy(fingerprint_.begin(), fingerprint_.end(), header.fingerprint.begin());
  const auto values = std::as_bytes(std::span(rows.values));
  header.values_checksum = fnv1a(values);
  header.checksum = checksum_of(header);

  if (!end_) end_.emplace(Communicator(), 1);
  const std::int64_t offset = end_->fetch_add(0, whole_pages(header.bytes()));
  const fs::path path = log(run_, end_->node());
  if (!open_) {
    open_ = std::make_unique<OpenFile>(path, O_WRONLY | O_CREAT);
    opened_ = std::chrono::steady_clock::now();
  }
  if (!*open_ || !open_->write(std::as_bytes(std::span(&header, 1)), offset) ||
      !open_->write(values, offset + static_cast<std::int64_t>(sizeof header))) {
    const int error_number = errno;
    open_.reset();
    throw file_error("write", path, error_number);
  }
  written_.push_back({block, run_, end_->node(), offset});
  if (std::chrono::steady_clock::now() - opened_ > open_for) close();
}

// A network file system tells only now what it could not write, and which blocks that concerns their checksums say.
void BlockLog::close() {
  if (!open_) return;
  const bool closed = open_->close();
  const int error_number = errno;
  open_.reset();
  if (!closed) throw file_error("write", log(run_, end_->node()), error_number);
}

void BlockLog::share(const Communicator& world) {
  close();
  Words mine;
  for (const Place& place : std::exchange(written_, {}))
    mine.insert(mine.end(), {place.block, place.run, place.node, place.offset});
  Words all;
  for (const Words& one : world.gather(mine)) all.insert(all.end(), one.begin(), one.end());
  all = world.broadcast(all);
  for (std::size_t i = 0; i < all.size(); i += 4) places_.push_back({all[i], all[i + 1], all[i + 2], all[i + 3]});
  keep_latest();
}

BlockRows BlockLog::read(std::int64_t block) const {
  const auto place = std::lower_bound(places_.begin(), places_.end(), Place{block, 0, 0, 0});
  const auto reject = [&](const fs::path& where, const char* why) {
    throw Error(
        fmt::format("block {} of {} cannot be used ({}): --resume computes it again", block, where.string(), why),
        Exit::data);
  };
  if (place == places_.end() || place->block != block) reject(folder_, "it is not there");
  const fs::path path = log(place->run, place->node);
  const OpenFile file(path, O_RDONLY);
  if (!file) reject(path, "the file cannot be read");
  const auto header = header_at(file, place->offset, file.size());
  if (!header || header->block != block) reject(path, "torn or damaged");
  if (text_of(header->fingerprint) != fingerprint_) reject(path, "of another study");
  if (header->kernel != kernel_) reject(path, "of another version of freestand");
  BlockRows rows{header->columns, std::vector<double>(static_cast<std::size_t>(header->rows * header->columns))};
  const auto bytes = std::as_writable_bytes(std::span(rows.values));
  if (!file.read(bytes, place->offset + static_cast<std::int64_t>(sizeof(Header))) ||
      fnv1a(bytes) != header->values_checksum)
    reject(path, "torn or damaged");
  return rows;
}

std::int64_t count_blocks(const fs::path& folder) {
  std::int64_t count = 0;
  for (const RunFile& log : run_files(folder, "log"))
    for_each_header(log.path, 0, std::numeric_limits<std::int64_t>::max(),
                    [&](const Header&, std::int64_t) { ++count; });
  return count;
}

std::int64_t bytes_of_block(std::int64_t rows, std::int64_t columns) {
  Header header;
  header.rows = rows, header.columns = columns;
  return whole_pages(header.bytes());
}

std::int64_t bytes_of_logs(const fs::path& folder) {
  std::int64_t bytes = 0;
  for (const RunFile& log : run_files(folder, "log")) bytes += OpenFile(log.path, O_RDONLY).size();
  return bytes;
}

}  // namespace freestand::parallel
