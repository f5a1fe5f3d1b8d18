#include "study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <freestand/error.hpp>
#include <numeric>
#include <optional>

#include "base/passed_over.hpp"
#include "fragility/half_width.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/samples_file.hpp"
#include "io/tally_file.hpp"
#include "parallel/finished_blocks.hpp"
#include "parallel/progress.hpp"
#include "parallel/schedule.hpp"
#include "study/accuracy.hpp"
#include "study/analysis.hpp"
#include "study/changed_keys.hpp"
#include "study/checkpoint.hpp"
#include "study/doubts.hpp"
#include "study/earlier_samples.hpp"
#include "study/effects_page.hpp"
#include "study/evaluator.hpp"
#include "study/intensities.hpp"
#include "study/kernel_number.hpp"
#include "study/known.hpp"
#include "study/motion_bytes.hpp"
#include "study/read_parts.hpp"
#include "study/rounds.hpp"
#include "study/spread_jobs.hpp"
#include "study/sweep_size.hpp"
#include "study/until.hpp"

namespace freestand::study {
namespace {

// Samples that are integrated together, at most; at first, where others wait for beats, so few.
constexpr std::int64_t pack_samples = 1024, first_samples = 32;

using parallel::Communicator;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Why the blocks in the folder are of another study: in which key, as the study.yaml beside them tells.
std::string why_other(const Study& study, const std::filesystem::path& folder, const std::string& blocks_fingerprint) {
  const bool same_samples = blocks_fingerprint.starts_with(samples_fingerprint(study));
  const auto samples = static_cast<std::int64_t>(study.samples);
  try {
    const std::string told =
        changes_told(study, parse_stored(read_text(study_path(folder)), study_path(folder)),
                     same_samples && (study.until || kept_samples(study, samples) < samples) ? Changes::of_counts
                                                                                             : Changes::of_samples);
    if (!told.empty()) return told;
  } catch (const Error&) {  // it is gone, or no study any more
  }
  return same_samples ? "a record has other contents or another name now, is gone, or is new"
                      : "their fingerprint differs";
}

MotionSet load_together(const Communicator& world, const Study& study, const SweepOptions& options) {
  const MotionSet motions = load_motions_together(world, study);
  world.on_root([&] {
    std::set<std::string> none;
    tell_doubts(study, motions, options.doubts_told ? *options.doubts_told : none);
  });
  return motions;
}

Evaluator evaluator_together(const Communicator& world, const Study& study, const SweepOptions& options) {
  const MotionSet motions = load_together(world, study, options);
  parallel::StepDisplay display(options.quiet || !world.is_root());
  return {study, motions, summarize_together(world, study, motions, &display)};
}

class Sweep {
 public:
  Sweep(const Communicator& world, const Study& study, const SweepOptions& options, RunFolder& folder)
      : world_(world),
        study_(study),
        options_(options),
        folder_(folder),
        earlier_(study, folder.path(), io::Closing::checked),
        evaluator_(evaluator_together(world, study, options)),
        target_(study),
        rounds_(world, blocks_path(folder.path()), fingerprint(study) + evaluator_.motions().fingerprint()) {
    earlier_.check(evaluator_.columns(), evaluator_.motions().fingerprint());
    look_at_size();
    checkpoint_.emplace(world, study, target_, evaluator_, folder.path());
    if (study.until) bins_.emplace(study, target_, evaluator_);
  }

  SweepSummary run() {
    summary_.motions_s = seconds_since(start_);
    take_stock();
    folder_.begin();
    if (rounds_.count() == 0) begin_rounds();
    compute(rounds_[0].end);
    for (std::int64_t i = 1; i < rounds_.count() || another_round(); ++i) compute(rounds_[i].end);
    const std::int64_t samples = rounds_[rounds_.count() - 1].end;
    if (study_.until && samples == total() && !options_.fit_follows)
      tell_if_not_reached(result_so_far(samples), samples);
    write(samples);
    folder_.end();
    count_integrated();
    summary_.samples = samples;
    summary_.wall_s = seconds_since(start_);
    if (summary_.compute_s > 0) summary_.samples_per_s = static_cast<double>(summary_.computed) / summary_.compute_s;
    return summary_;
  }

 private:
  std::int64_t total() const { return static_cast<std::int64_t>(study_.samples); }
  io::BlockLayout layout(std::int64_t samples) const { return {samples, checkpoint_->block_size()}; }

  // With `until`: whole blocks, enough for the bins of the intensity measure to be laid.
  void begin_rounds() {
    const auto block = static_cast<std::int64_t>(study_.block_size);  // not the sweep's own, which time decides
    const std::int64_t least = std::max(bin_layout_samples, earlier_.rows());
    Round first{study_.until ? std::min(total(), block * ((least + block - 1) / block)) : total()};
    if (first.end < checkpoint_->least_counted())
      throw Error(
          fmt::format("{} cannot be gone on with (which samples its rounds have taken is not known any more): give "
                      "--overwrite to begin anew",
                      blocks_path(folder_.path()).string()));
    if (study_.until)
      rounds_.add(std::move(first));
    else
      rounds_.only(std::move(first));
  }

  // Before anything is made: the bins are laid over the first samples' intensities, which are known before any response is.
  void look_at_size() const {
    const parallel::NodeSize node = parallel::narrowest_node(world_);
    world_.on_root([&] {
      const SweepSize size = size_of(study_, target_, evaluator_);
      refuse_too_large(size, node);
      if (size.kept < size.samples && !options_.quiet) parallel::tell(told(size) + "\n");
      if (const std::string room = room_told(size, folder_.path()); !room.empty())
        parallel::tell("doubtful: " + room + "\n");
    });
  }

  void take_stock() {
    checkpoint_->look();
    world_.on_root([&] {
      find_blocks();
      if (earlier_.rows() == 0) write_study();  // else it is of the samples that are there, until all are
    });
    checkpoint_->begin();
    if (study_.until) rounds_.read();
  }

  void write_study() const {
    io::write_text(study_path(folder_.path()), io::signed_text(expanded(study_, folder_.path())));
  }

  // How many samples of a block the earlier sweep holds.
  std::int64_t earlier_rows(std::int64_t samples, std::int64_t block) const {
    const io::BlockLayout blocks = layout(samples);
    return std::clamp<std::int64_t>(earlier_.rows() - block * blocks.block_size, 0, blocks.rows(block));
  }

  void find_blocks() {
    try {
      checkpoint_->find();
    } catch (const parallel::OtherBlocks& other) {
      throw Error(
          fmt::format("{} holds samples of another study ({}): resume with the study and records it was started with, "
                      "choose another folder, or give --overwrite to replace them",
                      folder_.path().string(), why_other(study_, folder_.path(), other.fingerprint())));
    }
  }

  // All blocks of the first `samples` samples.
  void compute(std::int64_t samples) {
    parallel::BlockList todo;
    std::int64_t there = 0;
    for (std::int64_t block = 0; block < layout(samples).blocks(); ++block) {
      const std::int64_t rows = layout(samples).rows(block), earlier = earlier_rows(samples, block);
      const bool finished = earlier == rows || block < finished_ || checkpoint_->has(block);
      there += finished ? rows : earlier;
      if (!finished) todo.push_back(block);
    }
    std::optional<parallel::Progress> progress;
    if (world_.is_root())
      progress.emplace(samples, there, parallel::Progress::Settings{.quiet = options_.quiet || todo.empty()});
    const auto start = Clock::now();
    const bool complete = parallel::for_each_block(
        world_, todo,
        [&](std::int64_t block, const parallel::Beat& beat) { return compute_block(samples, block, beat); },
        progress ? &*progress : nullptr);
    summary_.compute_s += seconds_since(start);
    checkpoint_->share();
    if (!complete) folder_.leave();
    finished_ = samples / layout(samples).block_size;
  }

  parallel::Counts compute_block(std::int64_t samples, std::int64_t block, const parallel::Beat& beat) {
    parallel::Counts counts;
    const std::int64_t before = passed_over_;
    const bool alike = block * layout(samples).block_size < rounds_.alike();
    checkpoint_->add(block, {evaluator_.columns(), rows_of(block, layout(samples).rows(block), counts, beat)}, alike);
    integrated_ += counts.samples - (passed_over_ - before);
    return counts;
  }

  // The first so many rows of a block.
  std::vector<double> rows_of(std::int64_t block, std::int64_t rows, parallel::Counts& counts,
                              const parallel::Beat& beat) {
    std::vector<double> values;
    values.reserve(evaluator_.columns().size() * static_cast<std::size_t>(rows));
    const std::int64_t first = block * layout(total()).block_size, end = first + rows;
    const std::int64_t earlier = std::min(rows, earlier_rows(total(), block));
    if (earlier > 0) values = earlier_.read(first, earlier);
    const Round& round = rounds_.of(first);
    Evaluator::Taken taken;
    if (!round.bins.empty()) taken = [&](const Table& draws) { return bins_->taken(round, draws); };
    const bool serves = world_.is_root() && world_.size() > 1;
    for (std::int64_t sample = first + earlier, count = 0; sample < end; sample += count) {
      count = std::min(serves ? to_beat_ : pack_samples, end - sample);
      const auto start = Clock::now();
      for (const Outcome outcome :
           evaluator_.append(static_cast<std::uint64_t>(sample), static_cast<std::size_t>(count), values, taken)) {
        ++counts.samples;
        passed_over_ += outcome == passed_over;
        counts.overturned += outcome == Outcome::overturned;
        counts.failed +=
            outcome == Outcome::painleve || outcome == Outcome::step_limit || outcome == Outcome::not_finite;
      }
      to_beat_ = parallel::samples_to_beat(count, seconds_since(start), pack_samples);
      beat();
    }
    return values;
  }

  // Of a finished block what is kept; where that has become unreadable since, it is computed again.
  std::vector<double> finished_rows(std::int64_t samples, std::int64_t block) {
    const std::int64_t rows = std::min(layout(samples).rows(block), checkpoint_->kept(block));
    if (earlier_rows(samples, block) == rows) return earlier_.read(block * layout(samples).block_size, rows);
    try {
      return checkpoint_->rows(block);
    } catch (const Error& error) {
      parallel::tell(fmt::format("{}: it is computed again now\n", error.what()));
      parallel::Counts ignored;
      return rows_of(block, rows, ignored, [] {});
    }
  }

  // Of the finished samples; on the root.
  fragility::Result result_so_far(std::int64_t samples) {
    folder_.leave_if_asked();
    const Jobs jobs = spread_jobs(world_, true, [this] { folder_.leave(); });
    if (const SampleCounts* counts = checkpoint_->counts()) return counts->result(checkpoint_->counted(), jobs);
    const SampleIntensity intensity(study_.fragility.im, evaluator_.summaries());
    return analyse(
        world_, study_, target_, evaluator_.motions().groups(), layout(samples).blocks(), layout(samples).block_size,
        [&](std::int64_t block) {
          return intensity.beside({evaluator_.columns(), finished_rows(samples, block)});
        },
        jobs);
  }

  // With the last sample that may be drawn; where it was not reached, the fit says so.
  void tell_if_reached(std::int64_t samples) {
    if (options_.quiet || !study_.until) return;
    const fragility::Result result = result_so_far(samples);
    if (world_.is_root() && not_reached(study_, result, drawn(samples)).empty())
      parallel::tell(round_told(study_, result, drawn(samples)) + "\n");
  }

  // However quiet: who asked for a half width must know that it was not reached.
  void tell_if_not_reached(const fragility::Result& result, std::int64_t samples) const {
    if (!world_.is_root()) return;
    if (const std::string warning = not_reached(study_, result, drawn(samples)); !warning.empty())
      parallel::tell(warning + "\n");
  }

  Drawn drawn(std::int64_t samples) const { return {samples, rounds_.alike()}; }

  // Does any bin want more samples than all rounds so far have made? Then the next round begins.
  bool another_round() {
    const std::int64_t samples = rounds_[rounds_.count() - 1].end;
    if (samples == total()) {
      tell_if_reached(samples);
      return false;
    }
    const fragility::Result result = result_so_far(samples);
    parallel::Words want;
    if (world_.is_root())
      for (const bool wants : fragility::bins_that_want(result, wanted(study_, drawn(samples)))) want.push_back(wants);
    want = world_.broadcast(want);
    if (world_.is_root() && !options_.quiet) parallel::tell(round_told(study_, result, drawn(samples)) + "\n");
    const auto bins = std::count(want.begin(), want.end(), 1);
    if (bins == 0 && !options_.fit_follows) tell_if_not_reached(result, samples);
    if (bins == 0) return false;
    Round next{std::min(total(), 2 * samples)};
    if (!study_.until->everywhere && bins < std::ssize(want)) next.bins.assign(want.begin(), want.end());
    rounds_.add(std::move(next));
    return true;
  }

  // Of all ranks.
  void count_integrated() {
    parallel::Words counts{integrated_, passed_over_};
    world_.sum_in_place(counts);
    summary_.computed = counts[0];
    summary_.passed_over = counts[1];
  }

  void write(std::int64_t samples) {
    folder_.leave_if_asked();
    const auto check = Clock::now();
    const Accuracy accuracy = check_accuracy(world_, study_, evaluator_, std::min(samples, rounds_.alike()));
    summary_.accuracy_s = seconds_since(check);
    const auto writing = Clock::now();
    io::SamplesHeader header{io::provenance_here(options_.command, world_.size()), evaluator_.columns(),
                             motion_rows(evaluator_.motions(), evaluator_.summaries())};
    header.provenance.study = expanded(study_);
    header.provenance.effects = effects_json(study_).dump();
    header.provenance.accuracy = world_.broadcast(accuracy_json(accuracy).dump());
    header.provenance.doubts = nlohmann::json(doubts(study_, evaluator_.motions())).dump();
    header.provenance.study_name = study_.name;
    header.provenance.seed = study_.seed;
    header.provenance.samples = samples;
    if (rounds_.alike() < samples) header.provenance.alike = rounds_.alike();
    header.provenance.kernel = kernel_text();
    folder_.confirm();
    if (checkpoint_->counts()) {
      const parallel::Words words = checkpoint_->counted();
      world_.on_root([&] {
        io::write_tally(tally_path(folder_.path()), {header.provenance, counts_fingerprint(study_), words});
      });
    }
    io::write_samples(world_, samples_path(folder_.path()), header,
                      {std::min(samples, checkpoint_->kept()), layout(samples).block_size},
                      [&](std::int64_t block) { return finished_rows(samples, block); });
    world_.on_root([&] {
      write_study();
      parallel::remove_finished_blocks(blocks_path(folder_.path()));
    });
    summary_.write_s = seconds_since(writing);
  }

  const Clock::time_point start_ = Clock::now();  // before the motions are read
  const Communicator& world_;
  const Study& study_;
  const SweepOptions& options_;
  RunFolder& folder_;
  const EarlierSamples earlier_;
  const Evaluator evaluator_;
  const Target target_;
  std::optional<Checkpoint> checkpoint_;
  Rounds rounds_;
  std::optional<RoundBins> bins_;                  // with `until`
  std::int64_t finished_ = 0;                      // whole blocks of the rounds so far
  std::int64_t integrated_ = 0, passed_over_ = 0;  // by this rank
  std::int64_t to_beat_ = first_samples;
  SweepSummary summary_;
};

}  // namespace

std::filesystem::path samples_path(const std::filesystem::path& folder) { return folder / "samples.h5"; }
std::filesystem::path blocks_path(const std::filesystem::path& folder) { return folder / "blocks"; }
std::filesystem::path tally_path(const std::filesystem::path& folder) { return folder / "tally.h5"; }
std::filesystem::path study_path(const std::filesystem::path& folder) { return folder / "study.yaml"; }

SweepSummary sweep(const Communicator& world, const Study& study, const SweepOptions& options, RunFolder& folder) {
  parallel::Words complete{0};
  world.on_root([&] { complete[0] = EarlierSamples(study, folder.path()).complete(); });
  if (!world.broadcast(complete)[0]) return Sweep(world, study, options, folder).run();
  const MotionSet motions = load_motions_together(world, study);
  world.on_root([&] {
    EarlierSamples(study, folder.path(), io::Closing::checked).check_records(motions.fingerprint());
    parallel::remove_finished_blocks(blocks_path(folder.path()));  // its end was interrupted
    io::write_text(study_path(folder.path()), io::signed_text(expanded(study, folder.path())));
  });
  return {.samples = static_cast<std::int64_t>(study.samples), .computed = 0};
}

}  // namespace freestand::study
