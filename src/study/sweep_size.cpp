#include "study/sweep_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <freestand/error.hpp>
#include <system_error>

#include "fragility/groups.hpp"
#include "fragility/leave_out_groups.hpp"
#include "fragility/tally_layout.hpp"
#include "parallel/block_log.hpp"
#include "study/analysis.hpp"
#include "study/intensities.hpp"
#include "study/motion_bytes.hpp"
#include "study/motion_summaries.hpp"
#include "study/ranking.hpp"
#include "study/sample_counts.hpp"

namespace freestand::study {
namespace {

constexpr double word_bytes = 8;  // of a count
constexpr double words_of_a_sum = 4;
// A tally, its words as they travel, those that have arrived, and what lies in the logs of counts: measured, of a sweep with 82 MB of counts
// in one, 7.5 on the root and 5.4 on other ranks.
constexpr double copies = 8;

double bytes_of(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::integer:
      return 4;
    case ColumnKind::flag:
      return 1;
    case ColumnKind::real:
      break;
  }
  return 8;
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < units.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

// Of each capacity its surface over bins, and its share in the cells and two numbers of its function, in every resample and with every group
// left out; of each demand a histogram a bin; a line of text a point of any surface, of which the longest that was seen has 260 characters;
// and what HDF5 writes of each table beside its numbers, 850 bytes in a file of 404 tables.
double bytes_of_results(const fragility::TallyLayout& layout, int resamples) {
  constexpr double histogram_cells = 400, line = 260, numbers_of_a_point = 8, header = 900, tables = 100,
                   tables_of_an_axis = 10, of_all = 30;
  double capacities = 0, cells = 1;
  for (const std::size_t count : layout.capacity_count) capacities += static_cast<double>(count);
  for (const std::size_t count : layout.axis_cells) cells += static_cast<double>(count);
  const auto bins = static_cast<double>(layout.bins), edps = static_cast<double>(layout.edps);
  const double sets = resamples + fragility::LeaveOutGroups::most_of_a_stratum * 2.0;
  return 8 * capacities * sets * (bins + static_cast<double>(layout.im_cell_count()) + 2) +
         header * (of_all + edps * (tables + tables_of_an_axis * static_cast<double>(layout.axis_cells.size()))) +
         8 * edps * bins * histogram_cells + capacities * bins * cells * (8 * numbers_of_a_point + line);
}

// The motions of samples.h5, with what HDF5 writes of each table beside its numbers: 2450 bytes in a file of 55 tables, 2420 in one of 62.
double bytes_beside_samples(const io::MotionRows& motions, std::size_t columns) {
  constexpr double header = 2600;
  const double tables = static_cast<double>(columns + motions.table.columns.size() + 6);
  double texts = 0;
  for (const std::string& name : motions.names) texts += static_cast<double>(name.size()) + word_bytes;
  const auto numbers = static_cast<double>(motions.names.size() * (motions.table.columns.size() + 2) +
                                           motions.sa_period_s.size() + motions.sa_mps2.size());
  return header * tables + texts + word_bytes * numbers;
}

// As large as they are before time has told how many samples take long enough, or as the study says.
double bytes_of_blocks(const Study& study, std::int64_t kept, std::size_t columns) {
  const auto size = static_cast<std::int64_t>(study.block_size);
  return static_cast<double>((kept + size - 1) / size) *
         static_cast<double>(parallel::bytes_of_block(std::min(size, kept), static_cast<std::int64_t>(columns)));
}

}  // namespace

SweepSize size_of(const Study& study, const Target& target, const Evaluator& evaluator) {
  SweepSize size;
  size.samples = static_cast<std::int64_t>(study.samples);
  size.kept = kept_samples(study, size.samples);
  double row = 0;
  for (const Column& column : evaluator.columns()) row += bytes_of(column.kind);
  const std::size_t columns = evaluator.columns().size();
  size.samples_bytes = row * static_cast<double>(size.kept) +
                       bytes_beside_samples(motion_rows(evaluator.motions(), evaluator.summaries()), columns);
  size.blocks_bytes = bytes_of_blocks(study, size.kept, columns);

  const SampleIntensity intensity(study.fragility.im, evaluator.summaries());
  const auto first = static_cast<std::size_t>(std::min(size.samples, bin_layout_samples));
  const fragility::Options options =
      laid_out(study, target, intensity.beside(evaluator.draws(first)), evaluator.motions().groups());
  const fragility::MotionGroups groups(options);
  const fragility::TallyLayout layout(options, static_cast<std::size_t>(groups.count()));
  const RankingCounts ranking(study, target, evaluator.motions().groups(), evaluator.summaries());
  size.counts_bytes =
      word_bytes * (static_cast<double>(layout.count_size) + words_of_a_sum * static_cast<double>(layout.sum_size) +
                    static_cast<double>(ranking.words().size()));
  size.results_bytes = bytes_of_results(layout, options.resamples);
  size.memory_bytes = copies * size.counts_bytes;
  size.motion_bytes = static_cast<double>(bytes_of(evaluator.motions()).row_bytes);
  return size;
}

std::string told(const SweepSize& size) {
  const std::string memory =
      fmt::format("{} of counts in the memory of each rank, {} of floor motions in that of each node",
                  bytes_text(size.memory_bytes), bytes_text(size.motion_bytes));
  const bool all = size.kept == size.samples;
  const double files = size.samples_bytes + (all ? 0 : size.counts_bytes);
  return fmt::format(
      "{} samples, of which {} kept: at most {} in {}, and {} in fragility.h5 and its tables, {} files in all; while "
      "it runs {} more in "
      "blocks/{}, two files for each node at most; {}",
      size.samples, all ? "all are" : fmt::format("the first {} are", size.kept), bytes_text(files),
      all ? "samples.h5" : "samples.h5 and tally.h5", bytes_text(size.results_bytes), all ? 8 : 9,
      bytes_text(size.blocks_bytes), all ? "" : fmt::format(" and {} for each node", bytes_text(size.counts_bytes)),
      memory);
}

void refuse_too_large(const SweepSize& size, const parallel::NodeSize& node) {
  if (node.ranks * size.memory_bytes <= node.memory_bytes) return;
  throw Error(
      fmt::format("what is counted takes {} in each rank, and a node with {} of them has {}: take fewer bins, "
                  "capacities, second axes "
                  "or demands{}",
                  bytes_text(size.memory_bytes), node.ranks, bytes_text(node.memory_bytes),
                  size.memory_bytes <= node.memory_bytes ? ", or fewer ranks on a node" : ""));
}

std::string room_told(const SweepSize& size, const std::filesystem::path& folder) {
  std::error_code error;
  const double room = static_cast<double>(std::filesystem::space(folder, error).available);
  // Counts go to the disk where not all samples do: of each node while it runs, and in tally.h5.
  const double counts = size.kept == size.samples ? 0 : 2 * size.counts_bytes;
  const double wanted = size.samples_bytes + size.blocks_bytes + counts + size.results_bytes;
  if (error || room >= wanted) return "";
  return fmt::format(
      "{} has room for {}, and the sweep will take {} ({} takes less): it will stop when the disk is full, and go on "
      "with --resume when there is more room",
      folder.string(), bytes_text(room), bytes_text(wanted),
      size.samples_bytes + size.blocks_bytes > 0.5 * wanted ? "keep: {thin: 100} or none"
                                                            : "fewer bins, capacities, second axes or demands");
}

}  // namespace freestand::study
