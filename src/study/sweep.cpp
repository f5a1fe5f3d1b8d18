#include "study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <freestand/error.hpp>
#include <numeric>
#include <optional>

#include "base/random.hpp"
#include "fragility/fit.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/samples_file.hpp"
#include "parallel/block_log.hpp"
#include "parallel/progress.hpp"
#include "parallel/schedule.hpp"
#include "study/accuracy.hpp"
#include "study/analysis.hpp"
#include "study/changed_keys.hpp"
#include "study/doubts.hpp"
#include "study/earlier_samples.hpp"
#include "study/effects_page.hpp"
#include "study/evaluator.hpp"
#include "study/intensities.hpp"
#include "study/kernel_number.hpp"
#include "study/known.hpp"
#include "study/read_parts.hpp"
#include "study/spread_jobs.hpp"
#include "study/until.hpp"

namespace freestand::study {
namespace {

// Samples that are integrated together between two beats.
constexpr std::int64_t pack_samples = 1024;

using parallel::Communicator;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Why the blocks in the folder are of another study: in which key, as the study.yaml beside them tells.
std::string why_other(const Study& study, const std::filesystem::path& folder, const std::string& blocks_fingerprint) {
  if (blocks_fingerprint.starts_with(samples_fingerprint(study)))
    return "a record has other contents now, or another name";
  try {
    const std::string told = changes_told(study, parse_stored(read_text(study_path(folder)), study_path(folder)));
    if (!told.empty()) return told;
  } catch (const Error&) {  // it is gone, or no study any more
  }
  return "their fingerprint differs";
}

// The root tries the records first, so that a broken one is told once and all ranks leave in order.
MotionSet load_together(const Communicator& world, const Study& study) {
  world.on_root([&] {
    const MotionSet motions = load_motions(study);
    for (const std::string& doubt : doubts(study, motions)) parallel::tell("doubtful: " + doubt + "\n");
  });
  return load_motions(study);
}

Evaluator evaluator_together(const Communicator& world, const Study& study, bool quiet) {
  const MotionSet motions = load_together(world, study);
  parallel::StepDisplay display(quiet || !world.is_root());
  return {study, motions, summarize_together(world, study, motions, &display)};
}

// Of the numbers of a row and of what they mean.
std::uint32_t kernel_of(const std::vector<Column>& columns) {
  std::string names;
  for (const Column& column : columns) names += column.name + "\n";
  return kernel_number ^ static_cast<std::uint32_t>(random::stable_hash(names));
}

class Sweep {
 public:
  Sweep(const Communicator& world, const Study& study, const SweepOptions& options, RunFolder& folder)
      : world_(world),
        study_(study),
        options_(options),
        folder_(folder),
        earlier_(study, folder.path()),
        evaluator_(evaluator_together(world, study, options.quiet)),
        log_(log_in(folder.path())) {
    earlier_.check(evaluator_.columns(), evaluator_.motions().fingerprint());
  }

  SweepSummary run() {
    summary_.motions_s = seconds_since(start_);
    take_stock();
    folder_.begin();
    std::int64_t samples = std::max(first_round(), earlier_.rows());
    compute(samples);
    while (samples < total() && !known_well_enough(samples)) {
      samples = std::min(total(), 2 * samples);
      compute(samples);
    }
    if (study_.until && samples == total() && !options_.fit_follows) tell_if_not_reached(samples);
    write(samples);
    folder_.end();
    summary_.samples = samples;
    summary_.wall_s = seconds_since(start_);
    if (summary_.compute_s > 0) summary_.samples_per_s = static_cast<double>(summary_.computed) / summary_.compute_s;
    return summary_;
  }

 private:
  // What is wrong with the bins is told before anything is made.
  parallel::BlockLog log_in(const std::filesystem::path& folder) const {
    refuse_bins_that_are_too_narrow();
    return {blocks_path(folder), samples_fingerprint(study_) + evaluator_.motions().fingerprint(),
            kernel_of(evaluator_.columns())};
  }

  std::int64_t total() const { return static_cast<std::int64_t>(study_.samples); }
  io::BlockLayout layout(std::int64_t samples) const { return {samples, static_cast<std::int64_t>(study_.block_size)}; }

  // With `until`: whole blocks, enough for the bins of the intensity measure to be laid.
  std::int64_t first_round() const {
    if (!study_.until) return total();
    const auto block = static_cast<std::int64_t>(study_.block_size);
    return std::min(total(), block * ((bin_layout_samples + block - 1) / block));
  }

  // The bins are laid over the first samples' intensities, which are known before any response is.
  void refuse_bins_that_are_too_narrow() const {
    const auto& axes = study_.fragility.axes;
    if (study_.fragility.bins.width <= 0 &&
        std::none_of(axes.begin(), axes.end(), [](const AxisPart& axis) { return axis.bins.width > 0; }))
      return;
    world_.on_root([&] {
      const auto first = static_cast<std::size_t>(std::min(total(), bin_layout_samples));
      const SampleIntensity intensity(study_.fragility.im, evaluator_.summaries());
      laid_out(study_, Target(study_), intensity.beside(evaluator_.draws(first)), evaluator_.motions().groups());
    });
  }

  void take_stock() {
    world_.on_root([&] {
      find_blocks();
      if (earlier_.rows() == 0) write_study();  // else it is of the samples that are there, until all are
    });
    finished_ = log_.begin(world_);
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
      log_.find();
    } catch (const parallel::OtherBlocks& other) {
      throw Error(
          fmt::format("{} holds samples of another study ({}): resume with the study and records it was started with, "
                      "choose another folder, or give --overwrite to replace them",
                      folder_.path().string(), why_other(study_, folder_.path(), other.fingerprint())));
    }
  }

  // All blocks of the first `samples` samples.
  void compute(std::int64_t samples) {
    parallel::Words todo;
    std::int64_t there = 0;
    for (std::int64_t block = 0; block < layout(samples).blocks(); ++block) {
      const std::int64_t rows = layout(samples).rows(block), earlier = earlier_rows(samples, block);
      const bool finished = earlier == rows || std::binary_search(finished_.begin(), finished_.end(), block);
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
    if (!complete) folder_.leave();
    log_.share(world_);
    summary_.computed += samples - there;
    finished_.insert(finished_.end(), todo.begin(), todo.end());
    std::sort(finished_.begin(), finished_.end());
  }

  parallel::Counts compute_block(std::int64_t samples, std::int64_t block, const parallel::Beat& beat) {
    parallel::Counts counts;
    log_.write(block, rows_of(samples, block, counts, beat));
    return counts;
  }

  parallel::BlockRows rows_of(std::int64_t samples, std::int64_t block, parallel::Counts& counts,
                              const parallel::Beat& beat) const {
    const io::BlockLayout blocks = layout(samples);
    parallel::BlockRows rows{.columns = static_cast<std::int64_t>(evaluator_.columns().size()), .values = {}};
    rows.values.reserve(static_cast<std::size_t>(rows.columns * blocks.rows(block)));
    const std::int64_t first = block * blocks.block_size, end = first + blocks.rows(block);
    const std::int64_t earlier = earlier_rows(samples, block);
    if (earlier > 0) rows.values = earlier_.read(first, earlier);
    for (std::int64_t sample = first + earlier; sample < end; sample += pack_samples) {
      const auto count = static_cast<std::size_t>(std::min(pack_samples, end - sample));
      for (const Outcome outcome : evaluator_.append(static_cast<std::uint64_t>(sample), count, rows.values)) {
        ++counts.samples;
        counts.overturned += outcome == Outcome::overturned;
        counts.failed +=
            outcome == Outcome::painleve || outcome == Outcome::step_limit || outcome == Outcome::not_finite;
      }
      beat();
    }
    return rows;
  }

  // A finished block; one whose file has become unreadable since is computed again.
  std::vector<double> finished_rows(std::int64_t samples, std::int64_t block) const {
    const std::int64_t rows = layout(samples).rows(block);
    if (earlier_rows(samples, block) == rows) return earlier_.read(block * layout(samples).block_size, rows);
    try {
      return log_.read(block).values;
    } catch (const Error& error) {
      parallel::tell(fmt::format("{}: it is computed again now\n", error.what()));
      parallel::Counts ignored;
      return rows_of(samples, block, ignored, [] {}).values;
    }
  }

  // Of the finished samples; on the root.
  fragility::Result result_so_far(std::int64_t samples) {
    folder_.leave_if_asked();
    const SampleIntensity intensity(study_.fragility.im, evaluator_.summaries());
    return analyse(
        world_, study_, Target(study_), evaluator_.motions().groups(), layout(samples).blocks(),
        layout(samples).block_size,
        [&](std::int64_t block) {
          return intensity.beside({evaluator_.columns(), finished_rows(samples, block)});
        },
        spread_jobs(world_, true, [this] { folder_.leave(); }));
  }

  // However quiet: who asked for a half width must know that it was not reached.
  void tell_if_not_reached(std::int64_t samples) {
    const fragility::Result result = result_so_far(samples);
    if (!world_.is_root()) return;
    if (const std::string warning = not_reached(study_, result); !warning.empty()) parallel::tell(warning + "\n");
  }

  // Is every wanted point of the surface within the half width asked for?
  bool known_well_enough(std::int64_t samples) {
    const fragility::Result result = result_so_far(samples);
    double half_width = 0;
    if (world_.is_root()) half_width = fragility::half_width(result).largest;
    half_width = world_.broadcast(std::vector<double>{half_width}).front();
    if (world_.is_root() && !options_.quiet)
      parallel::tell(fmt::format("{} samples: the surface is known to +-{:.3f} (wanted +-{:.3f})\n", samples,
                                 half_width, study_.until->half_width));
    return half_width <= study_.until->half_width;
  }

  void write(std::int64_t samples) {
    folder_.leave_if_asked();
    const auto check = Clock::now();
    const Accuracy accuracy = check_accuracy(world_, study_, evaluator_, samples);
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
    header.provenance.kernel = fmt::format("{:08x}", kernel_number);
    folder_.confirm();
    io::write_samples(world_, samples_path(folder_.path()), header, layout(samples),
                      [&](std::int64_t block) { return finished_rows(samples, block); });
    world_.on_root([&] {
      write_study();
      parallel::remove_blocks(log_.folder());
    });
    summary_.write_s = seconds_since(writing);
  }

  const Clock::time_point start_ = Clock::now();  // before the motions are read
  const Communicator& world_;
  const Study& study_;
  const SweepOptions& options_;
  RunFolder& folder_;
  const EarlierSamples earlier_;
  Evaluator evaluator_;
  parallel::BlockLog log_;
  parallel::Words finished_;
  SweepSummary summary_;
};

}  // namespace

std::filesystem::path samples_path(const std::filesystem::path& folder) { return folder / "samples.h5"; }
std::filesystem::path blocks_path(const std::filesystem::path& folder) { return folder / "blocks"; }
std::filesystem::path study_path(const std::filesystem::path& folder) { return folder / "study.yaml"; }

SweepSummary sweep(const Communicator& world, const Study& study, const SweepOptions& options, RunFolder& folder) {
  parallel::Words complete{0};
  world.on_root([&] {
    complete[0] = EarlierSamples(study, folder.path()).complete();
    if (!complete[0]) return;
    parallel::remove_blocks(blocks_path(folder.path()));  // its end was interrupted
    io::write_text(study_path(folder.path()), io::signed_text(expanded(study, folder.path())));
  });
  if (world.broadcast(complete)[0]) return {.samples = static_cast<std::int64_t>(study.samples), .computed = 0};
  return Sweep(world, study, options, folder).run();
}

}  // namespace freestand::study
