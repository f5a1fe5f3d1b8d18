#include "study/checkpoint.hpp"

#include <algorithm>
#include <bit>

#include "base/random.hpp"
#include "study/block_size.hpp"
#include "study/kernel_number.hpp"
#include "study/sweep.hpp"

namespace freestand::study {
namespace {

// Counts of a few megabytes are added to those of the node in milliseconds: once a second. Where they are larger, or many ranks wait for each other,
// so seldom that it takes less than a hundredth of the time, but every ten seconds.
constexpr std::chrono::duration<double> shortest_pause{1}, longest_pause{10};

// Of the numbers of a row and of what they mean.
std::uint32_t kernel_of(const std::vector<Column>& columns) {
  std::string names;
  for (const Column& column : columns) names += column.name + "\n";
  return kernel_here() ^ static_cast<std::uint32_t>(random::stable_hash(names));
}

std::string fingerprint_of(const Study& study, const Evaluator& evaluator, bool all_kept) {
  return samples_fingerprint(study) + (all_kept ? "" : counts_fingerprint(study)) +
         (study.until ? fingerprint(study) : "") + evaluator.motions().fingerprint();
}

// Samples 0 ... count - 1, of which every rank integrates a part: their bits travel as whole numbers.
Table first_samples(const parallel::Communicator& world, const Evaluator& evaluator, std::int64_t count) {
  const auto columns = evaluator.columns().size();
  const std::int64_t first = count * world.rank() / world.size(), end = count * (world.rank() + 1) / world.size();
  std::vector<double> mine;
  evaluator.append(static_cast<std::uint64_t>(first), static_cast<std::size_t>(end - first), mine);
  parallel::Words words(static_cast<std::size_t>(count) * columns);
  for (std::size_t i = 0; i < mine.size(); ++i)
    words[static_cast<std::size_t>(first) * columns + i] = std::bit_cast<std::int64_t>(mine[i]);
  world.sum_in_place(words);
  Table table{evaluator.columns(), {}};
  for (const std::int64_t word : words) table.values.push_back(std::bit_cast<double>(word));
  return table;
}

}  // namespace

Checkpoint::Checkpoint(const parallel::Communicator& world, const Study& study, const Target& target,
                       const Evaluator& evaluator, const std::filesystem::path& folder)
    : world_(world),
      kept_(kept_samples(study, static_cast<std::int64_t>(study.samples))),
      log_(blocks_path(folder), fingerprint_of(study, evaluator, kept_ == static_cast<std::int64_t>(study.samples)),
           kernel_of(evaluator.columns())),
      layout_{static_cast<std::int64_t>(study.samples), samples_in_a_block(world, study, evaluator, folder)} {
  if (kept_ == layout_.samples) return;
  SampleCounts counts(study, target, evaluator.motions().groups(), evaluator.summaries(),
                      first_samples(world, evaluator, bin_layout_samples));
  parallel::BlockSums sums(blocks_path(folder), fingerprint_of(study, evaluator, false), kernel_of(evaluator.columns()),
                           layout_.blocks(), counts.size());
  counted_ = std::make_unique<Counted>(Counted{std::move(counts), std::move(sums)});
}

void Checkpoint::look() { log_.look(world_); }

void Checkpoint::find() {
  log_.find();
  if (counted_) counted_->sums.find();
}

void Checkpoint::begin() {
  logged_ = log_.begin(world_);
  if (counted_) counted_->sums.begin(world_);
}

std::int64_t Checkpoint::kept(std::int64_t block) const {
  return std::clamp<std::int64_t>(kept_ - block * layout_.block_size, 0, layout_.rows(block));
}

bool Checkpoint::has_rows(std::int64_t block) const {
  return kept(block) == 0 || std::binary_search(logged_.begin(), logged_.end(), block);
}

// The rows first: what is in the sums is never counted again, and rows that are missing are computed again when they are read.
void Checkpoint::add(std::int64_t block, const Table& rows, bool alike) {
  const auto columns = static_cast<std::int64_t>(rows.columns.size());
  if (!has_rows(block))
    log_.write(block, {columns, {rows.values.begin(), rows.values.begin() + kept(block) * columns}});
  if (has_counts(block)) return;
  if (counted_->waiting.empty()) counted_->since = std::chrono::steady_clock::now();
  counted_->counts.add(rows, block * layout_.block_size, alike);
  counted_->waiting.push_back(block);
  if (std::chrono::steady_clock::now() - counted_->since >= counted_->pause) add_to_sums();
}

void Checkpoint::add_to_sums() {
  if (counted_->waiting.empty()) return;
  const std::chrono::duration<double> took(counted_->sums.add(counted_->waiting, counted_->counts.take()));
  counted_->pause = std::clamp(100 * took, shortest_pause, longest_pause);
  counted_->waiting.clear();
}

void Checkpoint::share() {
  log_.share(world_);
  if (!counted_) return;
  add_to_sums();
  counted_->sums.write(world_);
}

std::int64_t Checkpoint::least_counted() const {
  return counted_ ? std::min(counted_->sums.end() * layout_.block_size, layout_.samples) : 0;
}

parallel::Words Checkpoint::counted() { return counted_->counts.normal(counted_->sums.total(world_)); }

}  // namespace freestand::study
