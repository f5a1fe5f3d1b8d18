#include "parallel/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <system_error>

#include "base/durable_file.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "block files are little endian");

struct Header {
  std::array<char, 8> magic = {'F', 'S', 'B', 'L', 'O', 'C', 'K', 'S'};
  std::uint32_t format = 2;
  std::uint32_t kernel = 0;
  std::int64_t block = 0, rows = 0, columns = 0;
  std::array<char, 64> fingerprint{};
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Header) == 112 && std::is_trivially_copyable_v<Header>);

std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t hash = 14695981039346656037ULL) {
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211ULL;
  return hash;
}

std::uint64_t checksum_of(const Header& header, std::span<const std::byte> values) {
  return fnv1a(values, fnv1a(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, checksum))));
}

std::string text_of(const std::array<char, 64>& fingerprint) {
  return {fingerprint.begin(), std::find(fingerprint.begin(), fingerprint.end(), '\0')};
}

// A block file as it lies there; nothing if it is no whole block.
struct Found {
  std::int64_t block;
  std::uint32_t kernel;
  std::string fingerprint;
  BlockRows rows;
};

std::optional<Found> parse(const std::string& bytes) {
  Header header;
  if (bytes.size() < sizeof header) return {};
  std::memcpy(&header, bytes.data(), sizeof header);
  const auto values = std::as_bytes(std::span(bytes)).subspan(sizeof header);
  const Header expected;
  if (header.magic != expected.magic || header.format != expected.format) return {};
  if (header.columns <= 0 || header.rows < 0 || values.size() % sizeof(double) != 0) return {};
  const auto count = static_cast<std::int64_t>(values.size() / sizeof(double));
  if (count / header.columns != header.rows || count % header.columns != 0) return {};
  if (checksum_of(header, values) != header.checksum) return {};
  Found found{header.block, header.kernel, text_of(header.fingerprint), {header.columns, {}}};
  found.rows.values.resize(static_cast<std::size_t>(count));
  if (count > 0) std::memcpy(found.rows.values.data(), values.data(), values.size());
  return found;
}

// The same for a file that may not be readable.
std::optional<Found> found_at(const fs::path& path) {
  try {
    return parse(read_whole(path));
  } catch (const Error&) {
    return {};
  }
}

bool is_block_name(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("block-") && name.ends_with(".bin");
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) paths.push_back(i->path());
  if (error) throw file_error("read", folder, error.value());
  std::sort(paths.begin(), paths.end());
  return paths;
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw file_error("remove", path, error.value());
}

}  // namespace

BlockStore::BlockStore(fs::path folder, std::string fingerprint, std::uint32_t kernel)
    : folder_(std::move(folder)), fingerprint_(std::move(fingerprint)), kernel_(kernel) {
  if (fingerprint_.empty() || fingerprint_.size() > sizeof(Header::fingerprint))
    throw Error(
        fmt::format("study fingerprint \"{}\" cannot be stored (1 to 64 characters): shorten it", fingerprint_));
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw file_error("make folder", folder_, error.value());
}

fs::path BlockStore::file(std::int64_t block) const { return folder_ / fmt::format("block-{:08}.bin", block); }

void BlockStore::write(std::int64_t block, const BlockRows& rows) const {
  Header header;
  header.kernel = kernel_;
  header.block = block;
  header.rows = rows.rows();
  header.columns = rows.columns;
  std::copy(fingerprint_.begin(), fingerprint_.end(), header.fingerprint.begin());
  const auto values = std::as_bytes(std::span(rows.values));
  header.checksum = checksum_of(header, values);
  const std::array<std::span<const std::byte>, 2> pieces{std::as_bytes(std::span(&header, 1)), values};
  write_aside(file(block), pieces);
}

std::vector<std::int64_t> BlockStore::finished() const {
  std::vector<std::int64_t> blocks;
  for (const fs::path& path : entries(folder_)) {
    if (!is_block_name(path)) continue;
    const auto found = found_at(path);
    if (!found || path != file(found->block)) continue;
    if (found->fingerprint != fingerprint_)
      throw OtherBlocks(
          fmt::format("{} holds samples of another study (its fingerprint is {}, this study's is {}): resume with "
                      "the study and records it was started with, or choose another output folder",
                      folder_.string(), found->fingerprint, fingerprint_),
          found->fingerprint);
    if (found->kernel != kernel_)
      throw Error(fmt::format("{} holds samples of another version of freestand, which gives other numbers (kernel {:08x}, "
                              "this one's is {:08x}): resume with the program it was started with, or start again with "
                              "--overwrite",
                              folder_.string(), found->kernel, kernel_));
    blocks.push_back(found->block);
  }
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

BlockRows BlockStore::read(std::int64_t block) const {
  const auto found = parse(read_whole(file(block)));
  const auto reject = [&](const char* why) {
    throw Error(
        fmt::format("{} cannot be used ({}): --resume computes it again", file(block).string(), why),
        Exit::data);
  };
  if (!found || found->block != block) reject("torn or damaged");
  if (found->fingerprint != fingerprint_) reject("of another study");
  if (found->kernel != kernel_) reject("of another version of freestand");
  return found->rows;
}

void BlockStore::remove_leftovers() const {
  for (const fs::path& path : entries(folder_))
    if (is_aside_name(path)) remove_file(path);
}

void BlockStore::clear() const {
  for (const fs::path& path : entries(folder_))
    if (is_aside_name(path) || is_block_name(path)) remove_file(path);
  std::error_code ignored;
  if (fs::is_empty(folder_, ignored)) fs::remove(folder_, ignored);
}

}  // namespace freestand::parallel
