// Finished blocks of samples, in logs to which is only added, that survive the end of the program at any moment.
//
// One log a node and run: 10^4 ranks that make a million blocks need as many files as there are nodes. Its ranks share a
// counter that says where each may write next. A block begins at a multiple of 4096 bytes and is known as whole by its
// checksums; what a rank that was killed has left half written is stepped over. Layout of a block, little endian: 8 bytes
// magic, uint32 format, uint32 kernel, int64 block, int64 rows, int64 columns, 64 bytes fingerprint (ASCII, zero padded),
// uint64 checksum of the values, uint64 checksum of the header before it (both FNV-1a), then rows x columns doubles, row by
// row.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <freestand/error.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/open_file.hpp"
#include "parallel/communicator.hpp"
#include "parallel/node_memory.hpp"
#include "parallel/run_files.hpp"

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

class BlockLog {
 public:
  // folder: made if it is not there (parents too). fingerprint: of all in the study that determines the numbers, at most
  // 64 characters. kernel: of what in the program does. part: of a log that one rank looks through [B]; by default, of a node that has
  // written terabytes, some thousand parts. Throws Error if the folder cannot be made or the fingerprint is too long or empty.
  BlockLog(std::filesystem::path folder, std::string fingerprint, std::uint32_t kernel = 0,
           std::int64_t part = std::int64_t{1} << 28);

  // Looks where blocks lie, each rank in its parts of the logs. There is no index, which a log that was torn would not have: headers are
  // found from any place of it. Collective.
  void look(const Communicator&);

  // Takes what was seen for this study's, on the root, which looks alone where not all have looked. A block of another study
  // (OtherBlocks) or kernel is an Error (Exit::usage): resuming would mix the two.
  void find();

  // Begins the log of this run, behind what the root has found, and gives the blocks that are whole, ascending. All ranks
  // share the reading; what is damaged or cannot be read will be computed again. Collective.
  std::vector<std::int64_t> begin(const Communicator&);

  // Adds a finished block, which counts instead of one of the same number. Throws Error: a full disk or a failing device
  // is Exit::cure, a missing right Exit::usage.
  void write(std::int64_t block, const BlockRows& rows);

  // From here on every rank can read what any has written. Collective. Throws Error as write() does.
  void share(const Communicator&);

  // One block. Throws Error (Exit::data) if it is not there, damaged, or of another study.
  BlockRows read(std::int64_t block) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Place {
    std::int64_t block, run, node, offset;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::filesystem::path log(std::int64_t run, std::int64_t node) const;
  void close();
  void look_into(const RunFile&, std::int64_t from, std::int64_t to);  // bytes
  bool is_whole(const Place&) const;
  void keep_latest();

  std::filesystem::path folder_;
  std::string fingerprint_;
  std::uint32_t kernel_;
  std::int64_t part_;
  std::int64_t run_ = 0;
  std::int64_t torn_ = 0;      // places of the logs that hold something, and no block
  std::vector<Place> places_;  // one a block, ascending
  bool looked_ = false;
  std::optional<RunFile> other_;    // a log that holds blocks of another study or kernel
  std::vector<Place> written_;      // by this rank, not yet shared
  std::unique_ptr<OpenFile> open_;  // this node's log, for some seconds
  std::chrono::steady_clock::time_point opened_ = {};
  std::optional<NodeMemory> end_;  // of this node's log, alone in it
};

// How many blocks lie in the logs of a folder, of whatever study, and how long the logs are [B], which takes no reading.
std::int64_t count_blocks(const std::filesystem::path& folder);
std::int64_t bytes_of_block(std::int64_t rows, std::int64_t columns);  // that it takes in a log
std::int64_t bytes_of_logs(const std::filesystem::path& folder);

}  // namespace freestand::parallel
