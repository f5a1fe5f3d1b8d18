// samples.h5: one dataset per column, one row per sample.
//
// root attributes: provenance.hpp, format "freestand-samples/2". /samples/sample is their dimension, without values: rows
// are in the order of the samples' numbers, from 0; /samples/NAME [sample] is float64, int32 or uint8 by the column's kind,
// in pieces that are shuffled and deflated, with attributes unit and description; outcome carries flag_values and
// flag_meanings. /motions/name [motion], scale /motions/motion: names of the floor motions, which the column `motion`
// points to, and beside it [motion] what is kept of them at scale 1, with units; /motions has an attribute fingerprint, of
// their contents; /motions/period_s is the scale of /motions/sa_mps2 [motion, period_s], spectral accelerations, 5 %
// damping. From these and its row every intensity of a sample follows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "io/closing_line.hpp"
#include "io/provenance.hpp"
#include "parallel/communicator.hpp"

namespace freestand::io {

inline constexpr const char* samples_format = "freestand-samples/2";

// What is kept of the floor motions.
struct MotionRows {
  std::vector<std::string> names;
  std::vector<int> group;           // the group of a record, -1 a family of pulses
  Table table;                      // one row a motion
  std::vector<double> sa_period_s;  // increasing
  std::vector<double> sa_mps2;      // [motion, period]
  std::string fingerprint = {};     // of their contents
};

struct SamplesHeader {
  Provenance provenance;
  std::vector<Column> columns;
  MotionRows motions;
};

// How samples lie in blocks: block i holds samples i * block_size up to the next block or the end.
struct BlockLayout {
  std::int64_t samples = 0;
  std::int64_t block_size = 1;

  std::int64_t blocks() const { return (samples + block_size - 1) / block_size; }
  std::int64_t rows(std::int64_t block) const;  // of this block
};

// Values of one block, row-major, rows(block) x columns.
using ReadBlock = std::function<std::vector<double>(std::int64_t block)>;

// Writes the file, all ranks together: each reads runs of blocks, in order, and packs their columns in pieces of 8192 rows; the root
// writes them. A rank holds about 16 MiB of rows, or two blocks, at a time, the root what 64 of them have packed. Not by MPI's own files:
// those of Open MPI (4.1) wait for ever where one rank cannot open the file, and take a write that did a part for a whole one.
// The file does not depend on the number of ranks but for the provenance. Throws Error: a full disk is Exit::cure, a block of
// another shape or a fraction in an integer column Exit::data. Collective.
void write_samples(const parallel::Communicator&, const std::filesystem::path& path, const SamplesHeader&,
                   const BlockLayout&, const ReadBlock&);

// Reads samples.h5 block by block. Every rank may have its own.
class SampleReader {
 public:
  explicit SampleReader(const std::filesystem::path& path,
                        Closing = Closing::check);  // Exit::data if it is no such file

  std::int64_t rows() const { return rows_; }
  const std::vector<Column>& columns() const { return columns_; }  // `sample` itself is not among them
  const MotionRows& motions() const { return motions_; }
  const Provenance& provenance() const { return provenance_; }

  // Rows first .. first + count - 1, all columns or the named ones, in that order.
  Table read(std::int64_t first, std::int64_t count) const;
  Table read(std::int64_t first, std::int64_t count, const std::vector<std::string>& names) const;

 private:
  std::shared_ptr<const h5::File> file_;
  Provenance provenance_;
  std::vector<Column> columns_;
  MotionRows motions_;
  std::int64_t rows_ = 0;
};

}  // namespace freestand::io
