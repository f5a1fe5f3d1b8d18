// What is counted over blocks of samples, and which blocks are in it, in files that survive the end of the program at any
// moment: the whole memory of a sweep that keeps no samples.
//
// The ranks of a node add to one array of words in memory that they share, and one of them at a time writes it, with the set
// of blocks, into the node's file: aside, synced, renamed, so that set and sums always belong together. A kill loses what was
// added since. The first node's file of each run begins with all that earlier runs have counted, whose files then go. Layout,
// little endian: 8 bytes magic, uint32 format, uint32 kernel, 64 bytes fingerprint (ASCII, zero padded), int64 blocks, int64
// words, uint64 checksum of what follows, uint64 checksum of the header before it (both FNV-1a), then one bit a block, in
// words of 64, then the sums.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/node_memory.hpp"

namespace freestand::parallel {

class BlockSums {
 public:
  // For this many blocks and words. fingerprint, at most 64 characters: of all that decides what is counted; kernel: of what
  // in the program does. Throws Error if the folder cannot be made.
  BlockSums(std::filesystem::path folder, std::string fingerprint, std::uint32_t kernel, std::int64_t blocks,
            std::size_t words);

  // Reads what earlier runs have counted; on the root. A file that is damaged is told, and its blocks will be counted again.
  // Those of another study (OtherBlocks) or kernel are an Error (Exit::usage).
  void find();

  // Takes over what the root has found. Collective.
  void begin(const Communicator&);

  bool has(std::int64_t block) const;  // since before begin()
  std::int64_t end() const;            // behind the last of those; 0 without any

  // Adds words that were counted over these blocks, none of which is in the sums. Where it is time, the calling rank writes
  // the node's file too: about every ten seconds, and so seldom that it costs less than a hundredth, but every minute. Throws Error: a full disk
  // is Exit::cure.
  // Returns the seconds for which this rank waited for others and added.
  double add(std::span<const std::int64_t> blocks, std::span<const std::int64_t> words);

  // Writes all nodes' files. Collective.
  void write(const Communicator&);

  // Of all that was added, by any rank and run. Collective.
  Words total(const Communicator&);

  std::size_t bytes() const;  // of a node's file

 private:
  struct Content {
    Words blocks;  // one bit each
    Words sums;
  };
  Content read(const std::filesystem::path& path) const;
  Content content();
  void write_file(const Content&) const;
  std::filesystem::path file() const;

  std::filesystem::path folder_;
  std::string fingerprint_;
  std::uint32_t kernel_;
  std::int64_t blocks_;
  std::size_t words_;
  std::int64_t run_ = 0;
  Content before_;  // there at the beginning; the sums on the root alone, and only until then
  std::optional<NodeMemory> memory_;
};

// How many blocks lie in the sums of a folder, of whatever study.
std::int64_t count_summed_blocks(const std::filesystem::path& folder);

}  // namespace freestand::parallel
