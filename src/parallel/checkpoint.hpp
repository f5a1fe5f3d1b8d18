// Finished blocks of samples, one file each, that survive the end of the program at any moment.
//
// A block file is written aside and renamed, so under its name it is whole; one that the end of the machine has torn is
// known by its checksum. Layout, little endian: 8 bytes magic, uint32 format, uint32 kernel, int64 block, int64 rows, int64
// columns, 64 bytes fingerprint (ASCII, zero padded), uint64 checksum (FNV-1a over the header before it and the values),
// then rows x columns doubles, row by row.
#pragma once

#include <cstdint>
#include <filesystem>
#include <freestand/error.hpp>
#include <string>
#include <utility>
#include <vector>

namespace freestand::parallel {

// Rows of one block, row-major: values[row * columns + column].
struct BlockRows {
  std::int64_t columns = 0;
  std::vector<double> values;

  std::int64_t rows() const { return columns ? static_cast<std::int64_t>(values.size()) / columns : 0; }
};

// Blocks that were made with another fingerprint, which is told.
class OtherBlocks : public Error {
 public:
  OtherBlocks(const std::string& text, std::string fingerprint) : Error(text), fingerprint_(std::move(fingerprint)) {}
  const std::string& fingerprint() const { return fingerprint_; }

 private:
  std::string fingerprint_;
};

class BlockStore {
 public:
  // folder: made if it is not there (parents too). fingerprint: of all in the study that determines the numbers, at most
  // 64 characters. kernel: of what in the program does. Throws Error if the folder cannot be made or the fingerprint is too long or empty.
  BlockStore(std::filesystem::path folder, std::string fingerprint, std::uint32_t kernel = 0);

  // Stores a finished block, replacing one of the same index. Throws Error: a full disk or a failing device is
  // Exit::cure, a missing right Exit::usage.
  void write(std::int64_t block, const BlockRows& rows) const;

  // The blocks that are there and whole, ascending. Files that are torn, damaged or cannot be read do not count, they will
  // be computed again. A block of another study (OtherBlocks) or kernel is an Error (Exit::usage): resuming would mix the
  // two. One rank asks and tells the others.
  std::vector<std::int64_t> finished() const;

  // One block. Throws Error (Exit::data) if it is not there, damaged, or of another study.
  BlockRows read(std::int64_t block) const;

  // Removes what an interrupted run has left half written. Only while no other rank writes.
  void remove_leftovers() const;

  // Removes all block files of this folder, of whatever study, and the folder if it is then empty.
  void clear() const;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path file(std::int64_t block) const;

 private:
  std::filesystem::path folder_;
  std::string fingerprint_;
  std::uint32_t kernel_;
};

}  // namespace freestand::parallel
