#include "study/sensitivity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <span>

#include "base/folder.hpp"
#include "fragility/groups.hpp"
#include "io/samples_file.hpp"
#include "parallel/progress.hpp"
#include "parallel/schedule.hpp"
#include "parallel/step_display.hpp"
#include "study/answers.hpp"
#include "study/build_catalogue.hpp"
#include "study/damage_states.hpp"
#include "study/evaluator.hpp"
#include "study/known.hpp"
#include "study/motion_bytes.hpp"
#include "study/sampled.hpp"
#include "study/swept_study.hpp"

namespace freestand::study {
namespace {

constexpr std::int64_t rows_in_a_block = 8192, pairs_at_once = 1024;

std::span<const double> row_of(const Table& table, std::size_t row) {
  return std::span(table.values).subspan(row * table.columns.size(), table.columns.size());
}

// The groups of motions need no more of the options.
fragility::Options group_options(const io::SampleReader& reader, const Study& study) {
  fragility::Options options;
  options.scrambles = study.scrambles;
  options.motion_group = reader.motions().group;
  return options;
}

std::filesystem::path samples_of(const std::filesystem::path& folder) {
  refuse_database(folder);
  if (!is_there(samples_path(folder)) && is_there(folder / "fragility.h5"))
    throw Error(
        fmt::format("{} is a fit without samples (shares are of the samples of a sweep): give the folder of the "
                    "sweep that it was fitted from",
                    folder.string()));
  return samples_path(folder);
}

// A finished sweep, and how its samples are told apart.
class Shares {
 public:
  Shares(const parallel::Communicator& world, const SensitivityOptions& options, io::Closing closing)
      : world_(world),
        options_(options),
        reader_(samples_of(options.folder), closing),
        rows_(rows_alike(reader_)),
        study_(analysed_study(options.folder, reader_)),
        motions_(group_options(reader_, study_)),
        groups_(motions_),
        sampled_(sampled(study_, reader_.motions().names.size(), grounds(reader_.motions()))),
        idle_(idle_parameters(study_, sampled_)),
        damage_(study_),
        answers_(study_.fragility, with_damage(reader_.columns())) {
    if (sampled_.empty())
      throw Error(
          fmt::format("{} samples nothing (every number is fixed, and there is one motion): give a number of the "
                      "study as a distribution and sweep again",
                      options.folder.string()));
    constexpr std::int64_t fewest_pairs = 64;  // as many groups as are left out in turn
    if (options.pairs > 0 && options.pairs < fewest_pairs)
      throw Error(
          fmt::format("--total {} is too few (of so few pairs no share and no error is known): give {} at least, "
                      "and better thousands",
                      options.pairs, fewest_pairs));
    if (options.pairs > rows_)
      throw Error(
          fmt::format("--total {} is more than the {} samples of {} (each is a sample of the sweep with one "
                      "parameter drawn again): ask for fewer, or sweep more",
                      options.pairs, rows_, options.folder.string()));
    refuse_other_draws();
  }

  Sensitivity operator()() {
    Sensitivity found;
    for (const Sampled& one : sampled_) found.parameters.push_back(one.parameter);
    found.answers = answers_.answers();
    found.confidence = options_.confidence.value_or(study_.fragility.confidence);
    found.pairs = options_.pairs;
    found.note = kept_told(reader_, rows_);
    if (!study_.fragility.target.empty())
      found.note += fmt::format(
          "{}the target of the study is not applied: shares are of what was swept, with its own "
          "distributions",
          found.note.empty() ? "" : "\n");
    decision::ShareTally first = first_order();
    decision::TotalTally total(options_.pairs > 0 ? sampled_.size() : 0, found.answers, groups_);
    if (options_.pairs > 0) compute_pairs(total);
    world_.sum_in_place(first.words());
    world_.sum_in_place(total.words());
    if (!world_.is_root()) return {};
    for (std::size_t a = 0; a < found.answers.size(); ++a) {
      found.rows.push_back(first.row(a, found.confidence));
      found.why_empty.push_back(too_few(found.answers[a], found.rows[a]));
      if (!found.why_empty[a].empty()) found.rows[a].share.clear();
      found.totals.emplace_back();
      found.why_no_total.push_back(too_few_pairs(total, found.answers[a], a));
      if (options_.pairs > 0 && found.why_empty[a].empty() && found.why_no_total[a].empty())
        for (std::size_t p = 0; p < sampled_.size(); ++p)
          found.totals[a].push_back(total.share(p, a, found.confidence));
    }
    if (a_total_is_below_its_share(found))
      found.note += fmt::format(
          "{}a total share is below the one that goes alone (by more than two standard errors): of the samples that "
          "moved, or stood, the parameters hang together, and shares no longer add up to one",
          found.note.empty() ? "" : "\n");
    return found;
  }

 private:
  // Of parameters that were drawn by themselves it never is, but by chance.
  static bool a_total_is_below_its_share(const Sensitivity& found) {
    for (std::size_t a = 0; a < found.totals.size(); ++a)
      for (std::size_t p = 0; p < found.totals[a].size(); ++p) {
        const fragility::Estimate &alone = found.rows[a].share[p], &total = found.totals[a][p].share;
        if (alone.value - total.value > 2 * std::hypot(alone.se, total.se)) return true;
      }
    return false;
  }
  int group(std::size_t motion, std::uint64_t sample) const {
    return groups_.of(motions_.group(static_cast<int>(motion), sample));
  }

  // Rows and, behind them, their damage states.
  std::vector<Column> with_damage(std::vector<Column> columns) const {
    for (const DamagePart& state : study_.fragility.damage) columns.push_back({"edp_" + state.name, "1", state.when});
    return columns;
  }
  Table with_damage(Table rows, std::int64_t first) const {
    damage_.append(rows, static_cast<std::uint64_t>(first));
    return rows;
  }

  // Columns of the file that the answers, and the conditions of the damage states, read.
  std::vector<std::string> columns_read() const {
    std::vector<std::string> names = answers_.columns();
    for (const DamagePart& state : study_.fragility.damage) {
      std::erase(names, "edp_" + state.name);
      for (const std::string& demand : state.demands)
        if (std::find(names.begin(), names.end(), "edp_" + demand) == names.end()) names.push_back("edp_" + demand);
    }
    return names;
  }

  // The classes are those of the draws that this program makes; the samples must be made of them.
  void refuse_other_draws() const {
    const std::int64_t rows = std::min<std::int64_t>(rows_, 64);
    for (const Quantity& quantity : quantities(study_.model)) {
      if (is_fixed(quantity.value)) continue;
      std::string column = quantity.name;
      std::replace(column.begin(), column.end(), '.', '_');
      const Table table = reader_.read(0, rows, {column});
      const sampling::Stream stream(study_.plan(), quantity.stream());
      for (std::size_t i = 0; i < table.rows(); ++i)
        if (quantile(quantity.value, stream(i)) != table.at(i, 0))
          throw Error(
              fmt::format("{}: {} of sample {} is {}, not the draw of its study (the samples were made by another "
                          "version): sweep again",
                          samples_path(options_.folder).string(), quantity.name, i, table.at(i, 0)),
              Exit::data);
    }
  }

  decision::ShareTally first_order() const {
    std::vector<decision::Parameter> parameters;
    std::vector<const Sampled*> all;
    for (const std::vector<Sampled>* some : {&sampled_, &idle_})
      for (const Sampled& one : *some) parameters.push_back(one.parameter), all.push_back(&one);
    decision::ShareTally tally(parameters, answers_.answers(), groups_,
                               study_.design == sampling::Design::sobol && study_.scrambles == 1);
    const io::BlockLayout layout{rows_, rows_in_a_block};
    std::vector<std::string> names = columns_read();
    names.emplace_back("motion");
    parallel::StepDisplay display(options_.quiet || !world_.is_root());
    std::vector<double> values;
    std::vector<int> of_class(all.size());
    for (std::int64_t block = world_.rank(); block < layout.blocks(); block += world_.size()) {
      const std::int64_t first = block * rows_in_a_block;
      const Table table = with_damage(reader_.read(first, layout.rows(block), names), first);
      const Answers answers(study_.fragility, table.columns);
      const std::size_t motion_column = column_index(table.columns, "motion");
      for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto sample = static_cast<std::uint64_t>(first) + i;
        const auto motion = static_cast<std::size_t>(table.at(i, motion_column));
        answers.read(row_of(table, i), values);
        for (std::size_t p = 0; p < all.size(); ++p) of_class[p] = all[p]->class_of(sample, motion);
        tally.add(group(motion, sample), of_class, values);
      }
      display.show("reading blocks of samples", static_cast<std::size_t>(block + 1),
                   static_cast<std::size_t>(layout.blocks()));
    }
    return tally;
  }

  // Every parameter times every stretch of samples is one piece of work.
  void compute_pairs(decision::TotalTally& total) const {
    const Study study = swept_study(world_, options_.folder, reader_);
    const Evaluator whole(study, load_motions_together(world_, study));
    std::vector<Evaluator> evaluators;
    for (const Sampled& one : sampled_) {
      Study other = study;
      other.redrawn = one.streams;
      evaluators.push_back(whole.drawing(other));
    }
    const io::BlockLayout layout{options_.pairs, pairs_at_once};
    std::vector<std::int64_t> todo(static_cast<std::size_t>(layout.blocks()) * sampled_.size());
    std::iota(todo.begin(), todo.end(), 0);
    std::optional<parallel::Progress> progress;
    if (world_.is_root())
      progress.emplace(options_.pairs * static_cast<std::int64_t>(sampled_.size()), 0,
                       parallel::Progress::Settings{.quiet = options_.quiet});
    const auto compute = [&](std::int64_t piece, const parallel::Beat&) {
      const auto p = static_cast<std::size_t>(piece / layout.blocks());
      return add_pairs(p, evaluators[p], piece % layout.blocks(), layout, total);
    };
    if (!parallel::for_each_block(world_, todo, compute, progress ? &*progress : nullptr))
      throw Error("stopped on request (nothing of the total shares is kept): start again", Exit::resumable);
  }

  parallel::Counts add_pairs(std::size_t p, const Evaluator& evaluator, std::int64_t block,
                             const io::BlockLayout& layout, decision::TotalTally& total) const {
    const std::int64_t first = block * pairs_at_once, count = layout.rows(block);
    const Table table = with_damage(reader_.read(first, count), first);
    Table again{evaluator.columns(), {}};
    parallel::Counts counts;
    for (const Outcome outcome :
         evaluator.append(static_cast<std::uint64_t>(first), static_cast<std::size_t>(count), again.values)) {
      ++counts.samples;
      counts.overturned += outcome == Outcome::overturned;
      counts.failed += outcome > Outcome::overturned;
    }
    again = with_damage(std::move(again), first);
    const Answers answers_again(study_.fragility, again.columns);
    const std::size_t motion = column_index(table.columns, "motion"),
                      motion_again = column_index(again.columns, "motion");
    std::vector<double> value, value_again;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const std::uint64_t sample = static_cast<std::uint64_t>(first) + i;
      answers_.read(row_of(table, i), value);
      answers_again.read(row_of(again, i), value_again);
      total.add(p, group(static_cast<std::size_t>(table.at(i, motion)), sample),
                group(static_cast<std::size_t>(again.at(i, motion_again)), sample), value, value_again);
    }
    return counts;
  }

  // Shares of what hardly ever varies would be shares of chance: as many samples as a bin needs must have each answer.
  std::string too_few(const decision::Answer& answer, const decision::ShareRow& row) const {
    const double least = study_.fragility.minimum_samples, n = static_cast<double>(row.samples);
    if (!answer.yes_or_no)
      return n < least ? fmt::format("{:.0f} samples moved and stood, fewer than {:.0f}", n, least) : "";
    const double yes = row.samples > 0 ? std::round(row.mean * n) : 0;
    if (yes < least) return fmt::format("it happens in {:.0f} of {:.0f} samples, fewer than {:.0f}", yes, n, least);
    if (n - yes < least)
      return fmt::format("it does not happen in {:.0f} of {:.0f} samples, fewer than {:.0f}", n - yes, n, least);
    return "";
  }

  // Where it hardly ever differs in the pairs all of those may turn, and seem to say that nothing else matters.
  std::string too_few_pairs(const decision::TotalTally& total, const decision::Answer& answer, std::size_t a) const {
    const double least = study_.fragility.minimum_samples;
    for (std::size_t p = 0; options_.pairs > 0 && answer.yes_or_no && p < sampled_.size(); ++p)
      if (total.rarer(p, a) < least)
        return fmt::format(
            "no total shares: {} of the {} samples that were computed again differ from the others, fewer than {:.0f}",
            std::floor(total.rarer(p, a)), options_.pairs, least);
    return "";
  }

  const parallel::Communicator& world_;
  const SensitivityOptions& options_;
  const io::SampleReader reader_;
  const std::int64_t rows_;  // that shares are of
  const Study study_;
  const fragility::MotionGroups motions_;
  const fragility::LeaveOutGroups groups_;
  const std::vector<Sampled> sampled_, idle_;
  const DamageStates damage_;
  const Answers answers_;
};

}  // namespace

Sensitivity sensitivity(const parallel::Communicator& world, const SensitivityOptions& options) {
  world.on_root([&] { Shares(world, options, io::Closing::check); });  // so that what is wrong is told once
  return Shares(world, options, io::Closing::checked)();
}

std::string title(const decision::Answer& answer) {
  if (!answer.yes_or_no) return "ln " + answer.edp;
  if (std::isnan(answer.capacity)) return answer.edp;
  return fmt::format("{} > {}{}", answer.edp, answer.capacity, answer.unit == "1" ? "" : " " + answer.unit);
}

}  // namespace freestand::study
