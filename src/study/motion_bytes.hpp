// The floor motions of a study, read by one rank for all: a file server sees one reader, whatever the number of ranks. Their
// values, and what is tabulated from them, lie once in the memory of each node.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "study/realise.hpp"

namespace freestand::study {

// Of the same machine and program alone.
struct MotionBytes {
  std::string words;                             // all but the rows of values, and how long these are
  std::vector<std::span<const std::byte>> rows;  // each to begin where a cache line does; not owned
  std::size_t row_bytes = 0;                     // of all rows, with the gaps between them

  void write_rows(std::byte* to) const;
};
MotionBytes bytes_of(const MotionSet&);

// The same motions to the bit, as bytes_of() and write_rows() gave them. They read their rows where these are.
MotionSet motions_of(const std::string& words, std::shared_ptr<const std::byte> rows);

// load_motions() of the root, on every rank. Where the ranks of a node cannot share memory each holds its own, which the
// root tells once. Throws what load_motions() throws, on every rank. Collective.
MotionSet load_motions_together(const parallel::Communicator&, const Study&);

}  // namespace freestand::study
