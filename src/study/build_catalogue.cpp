#include "study/build_catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <freestand/error.hpp>
#include <map>
#include <optional>
#include <set>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "io/database_file.hpp"
#include "io/folder_lock.hpp"
#include "io/fragility_file.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/samples_file.hpp"
#include "io/written_files.hpp"
#include "parallel/finished_blocks.hpp"
#include "parallel/step_display.hpp"
#include "parallel/stop.hpp"
#include "study/catalogue_rows.hpp"
#include "study/edited_study.hpp"
#include "study/fit.hpp"
#include "study/kernel_number.hpp"
#include "study/problems.hpp"
#include "study/realise.hpp"
#include "study/sweep.hpp"

namespace freestand::study {
namespace {

namespace fs = std::filesystem;
using database::Database;
using parallel::Communicator;

const std::vector<std::string> written = {io::database_name, io::entries_csv_name, io::curves_csv_name,
                                          io::points_csv_name, io::words_name};

// More samples than that, and an entry shows its own progress.
constexpr std::uint64_t many_samples = 100000;

enum Work : std::int64_t { keep, refit, sweep_anew };

// A fingerprint: of the study, of the contents of its records, and the other intensities.
constexpr std::size_t study_digits = 16, motion_digits = 16;
std::string of_motions(const std::string& fingerprint) { return fingerprint.substr(study_digits, motion_digits); }

// Of study and motions; the contents of records are read once for entries on the same floor.
class Fingerprints {
 public:
  std::string operator()(const CatalogueEntry& entry) {
    std::string& motions = motions_[entry.words.shaking + entry.study.folder.string()];
    if (motions.empty()) motions = load_motions(entry.study).fingerprint();
    std::string all = fingerprint(entry.study) + motions;
    for (const IntensityPart& im : entry.others) (all += '+') += short_name(im);
    return all;
  }

 private:
  std::map<std::string, std::string> motions_;
};

// What may change without new samples.
bool is_of_fragility(const Difference& difference) { return difference.key.starts_with("fragility."); }

// The study of the samples that lie in an entry's folder, on motions of this fingerprint; nothing where there are none, or of another
// kernel.
std::optional<Study> swept_study(const fs::path& folder, const std::string& motions) {
  if (!fs::exists(samples_path(folder))) return {};
  const io::SampleReader reader(samples_path(folder));
  if (reader.provenance().kernel != kernel_text() || reader.motions().fingerprint != motions) return {};
  return parse_stored(reader.provenance().study, folder);
}

struct Plan {
  parallel::Words work;  // of each entry of the catalogue
  std::vector<std::string> fingerprints;
};

// A database has one confidence of its bands: that of its entries, and of those that are kept.
void refuse_other_confidence(const Catalogue& catalogue, const Database& before) {
  const CatalogueEntry& first = catalogue.entries.front();
  for (const CatalogueEntry& entry : catalogue.entries)
    if (entry.study.fragility.confidence != first.study.fragility.confidence)
      throw Error(fmt::format(
          "entry {} has confidence {} and entry {} has {} (the bands of a database have one): give all the same",
          first.words.id, first.study.fragility.confidence, entry.words.id, entry.study.fragility.confidence));
  if (before.confidence == first.study.fragility.confidence) return;
  for (const database::Entry& kept : before.entries)
    if (std::none_of(catalogue.entries.begin(), catalogue.entries.end(),
                     [&](const CatalogueEntry& entry) { return entry.words.id == kept.id; }))
      throw Error(fmt::format(
          "confidence is {}, and that of entry {}, which the database keeps, {}: give the same, or name another folder",
          first.study.fragility.confidence, kept.id, before.confidence));
}

// What there is to do. Throws Error that lists every changed entry, unless redo is given.
Plan plan_of(const Catalogue& catalogue, const Database& before, const fs::path& folder, bool redo) {
  refuse_other_confidence(catalogue, before);
  Plan plan;
  Fingerprints fingerprint_of;
  std::vector<Refusal> refused;
  std::map<std::string, const database::Entry*> old;
  for (const database::Entry& entry : before.entries) old[entry.id] = &entry;
  for (const CatalogueEntry& entry : catalogue.entries) {
    plan.fingerprints.push_back(fingerprint_of(entry));
    const auto known = old.find(entry.words.id);
    const database::Entry* row = known == old.end() ? nullptr : known->second;
    if (row && row->fingerprint == plan.fingerprints.back() && row->kernel == kernel_text()) {
      plan.work.push_back(keep);
      continue;
    }
    const auto swept = swept_study(entry_folder(folder, entry.words.id), of_motions(plan.fingerprints.back()));
    const std::vector<Difference> differ = swept ? differences(entry.study, *swept) : std::vector<Difference>{};
    if (swept && std::all_of(differ.begin(), differ.end(), is_of_fragility)) {
      plan.work.push_back(refit);
      continue;
    }
    plan.work.push_back(sweep_anew);
    if (redo || (!row && !swept)) continue;
    const std::vector<Difference> changed =
        row ? differences(entry.study, parse_stored(row->study, entry.place)) : differ;
    const std::string what = row && row->kernel != kernel_text() ? "freestand gives other numbers now"
                             : changed.empty()
                                 ? "its records were changed"
                                 : fmt::format("{} was {}, is {}", changed[0].key, changed[0].before, changed[0].now);
    refused.push_back({entry.words.id,
                       fmt::format("entry {} is not the one {} ({}): take it back, give it another id, or add "
                                   "--redo to compute it anew",
                                   entry.words.id, row ? "of the database" : "whose samples are finished", what),
                       entry.place});
  }
  if (!refused.empty()) throw Error(fmt::format("{}", fmt::join(told_once(refused), "\n")));
  return plan;
}

// The expanded study beside the samples, as `fit` goes by it.
void write_study(const Study& study, const fs::path& folder) {
  io::write_text(study_path(folder), io::signed_text(expanded(study, folder)));
}

// Beside the blocks of an entry: of which study, records and program they are.
fs::path mark_path(const fs::path& folder) { return parallel::run_file(blocks_path(folder), 0, 0, "entry"); }
std::string mark_of(const std::string& fingerprint) { return fmt::format("{} {}\n", fingerprint, kernel_text()); }

// What an entry's folder holds is to be gone on with: what was interrupted in this very work, or a sweep to fit again.
bool goes_on(const fs::path& folder, const std::string& fingerprint, Work work) {
  if (work == refit) return true;
  return fs::exists(mark_path(folder)) && read_whole(mark_path(folder)) == mark_of(fingerprint);
}

void compute(const Communicator& world, const CatalogueEntry& entry, Work work, const fs::path& folder,
             const std::string& fingerprint, const CatalogueOptions& options, std::set<std::string>& doubts_told) {
  const bool quiet = options.quiet || entry.study.samples < many_samples;
  std::vector<std::int64_t> resume{0};
  world.on_root([&] { resume[0] = goes_on(folder, fingerprint, work); });
  RunFolder run_folder(world, folder, world.broadcast(resume)[0] ? io::Existing::resume : io::Existing::overwrite,
                       "go on with the same command", {.writes = {study_path("").string()}});
  if (work == sweep_anew)
    world.on_root([&] {
      make_folder(blocks_path(folder));
      write_durably(mark_path(folder), mark_of(fingerprint));
    });
  SweepSummary summary;
  if (work == refit)
    world.on_root([&] {
      parallel::remove_finished_blocks(blocks_path(folder));  // the end of its sweep was interrupted
      write_study(entry.study, folder);
    });
  else
    summary = sweep(world, entry.study, {.quiet = quiet, .command = options.command, .doubts_told = &doubts_told},
                    run_folder);
  fit(world, run_folder,
      {.from = folder, .command = options.command, .quiet = true, .sweep = work == refit ? nullptr : &summary});
  for (const IntensityPart& im : entry.others) {
    RunFolder other(world, intensity_folder(folder, short_name(im)), io::Existing::resume,
                    "go on with the same command", {.writes = {study_path("").string()}});
    fit(world, other, {.from = folder, .changes = {.im = short_name(im)}, .command = options.command, .quiet = true});
  }
}

// What the folder of an entry holds, as rows of the database.
void add_rows(Database& db, const CatalogueEntry& entry, const std::string& fingerprint, std::int64_t version,
              const fs::path& folder) {
  const auto [provenance, result] = io::read_fragility(folder / "fragility.h5");
  database::Entry row = entry.words;
  row.version = version;
  row.study = expanded(entry.study);
  row.fingerprint = fingerprint;
  row.kernel = provenance.kernel;
  row.program = provenance.version;
  row.git_commit = provenance.git_commit;
  row.created_utc = provenance.created_utc;
  row.samples = provenance.samples;
  row.failed = 0;
  for (const Outcome outcome : {Outcome::painleve, Outcome::step_limit, Outcome::not_finite})
    row.failed += result.outcome_counts[static_cast<std::size_t>(outcome)];
  row.motions = result.motions;
  db.confidence = result.confidence;
  const auto add = [&](const fragility::Result& found, const IntensityPart& im) {
    for (database::Curve& curve : curves_of(found, db.entries.size(), short_name(im)))
      db.curves.push_back(std::move(curve));
  };
  add(result, entry.study.fragility.im);
  for (const IntensityPart& im : entry.others)
    add(io::read_fragility(intensity_folder(folder, short_name(im)) / "fragility.h5").result, im);
  db.entries.push_back(std::move(row));
}

void copy_rows(Database& db, const Database& before, std::size_t at, const database::Entry& row) {
  for (const database::Curve& curve : before.curves)
    if (curve.entry == at) {
      db.curves.push_back(curve);
      db.curves.back().entry = db.entries.size();
    }
  db.entries.push_back(row);
}

// Words of a kept entry that may change without its numbers.
database::Entry renewed(const database::Entry& before, const database::Entry& words) {
  database::Entry row = words;
  for (auto member : {&database::Entry::study, &database::Entry::fingerprint, &database::Entry::kernel,
                      &database::Entry::program, &database::Entry::git_commit, &database::Entry::created_utc})
    row.*member = before.*member;
  for (auto member :
       {&database::Entry::version, &database::Entry::samples, &database::Entry::failed, &database::Entry::motions})
    row.*member = before.*member;
  return row;
}

// Entries of the catalogue in its order, behind those that it does not name.
Database assemble(const Catalogue& catalogue, const Plan& plan, const Database& before, const fs::path& folder) {
  Database db{.name = catalogue.name, .revision = catalogue.revision};
  db.confidence = before.confidence;
  std::map<std::string, std::size_t> old;
  for (std::size_t i = 0; i < before.entries.size(); ++i) old[before.entries[i].id] = i;
  std::map<std::string, std::size_t> mine;
  for (std::size_t i = 0; i < catalogue.entries.size(); ++i) mine[catalogue.entries[i].words.id] = i;
  for (std::size_t i = 0; i < before.entries.size(); ++i)
    if (!mine.contains(before.entries[i].id)) copy_rows(db, before, i, before.entries[i]);
  for (std::size_t i = 0; i < catalogue.entries.size(); ++i) {
    const CatalogueEntry& entry = catalogue.entries[i];
    const auto known = old.find(entry.words.id);
    if (plan.work[i] == keep)
      copy_rows(db, before, known->second, renewed(before.entries[known->second], entry.words));
    else
      add_rows(db, entry, plan.fingerprints[i], known == old.end() ? 1 : before.entries[known->second].version + 1,
               entry_folder(folder, entry.words.id));
  }
  for (const database::Entry& entry : db.entries)
    if (std::find(db.classes.begin(), db.classes.end(), entry.equipment) == db.classes.end())
      db.classes.push_back(entry.equipment);
  db.demands = demand_words(db);
  db.intensities = intensity_words(db.curves);
  return db;
}

// Is there something in the folder, and no database of ours? Then it is somebody else's.
void refuse_other_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (!fs::is_directory(folder, ignored))
    throw Error(fmt::format("{} cannot take a database (it is a file): name a folder", folder.string()));
  if (fs::exists(folder / io::database_name, ignored) || fs::is_directory(entry_folder(folder, ""), ignored)) return;
  for (const auto& inside : fs::directory_iterator(folder))
    if (inside.path().filename() != io::lock_name)
      throw Error(fmt::format("{} is not empty and holds no database ({} is there): name another folder",
                              folder.string(), inside.path().filename().string()));
}

Database database_before(const fs::path& folder) {
  if (!fs::exists(folder / io::database_name)) return {};
  return io::read_database(folder / io::database_name);
}

}  // namespace

void refuse_database(const fs::path& folder) {
  if (!fs::exists(folder / io::database_name)) return;
  const Database db = io::read_database(folder / io::database_name);
  const std::string first = db.entries.empty() ? "ID" : db.entries.front().id;
  throw Error(fmt::format("{} is a database of {} entries (this takes one sweep): give the folder of an entry, as {}",
                          folder.string(), db.entries.size(), entry_folder(folder, first).string()));
}

fs::path intensity_folder(const fs::path& folder, const std::string& im) {
  std::string name = im;
  std::replace(name.begin(), name.end(), ':', '_');
  return folder / name;
}

fs::path entry_folder(const fs::path& folder, const std::string& id) { return folder / "entries" / id; }

CatalogueSummary build_catalogue(const Communicator& world, const Catalogue& catalogue, const fs::path& folder,
                                 const CatalogueOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const parallel::StopOnSignal stop_on_signal;
  std::optional<io::FolderLock> lock;
  Database before;
  Plan plan;
  world.on_root([&] {
    refuse_other_folder(folder);
    io::refuse_others(folder, written);
    make_folder(folder / "entries");
    lock.emplace(folder, io::FolderLock::Settings{.lost = parallel::request_stop});
    remove_asides(folder);
    before = database_before(folder);
    plan = plan_of(catalogue, before, folder, options.redo);
  });
  plan.work = world.broadcast(plan.work);
  plan.fingerprints.resize(catalogue.entries.size());  // which the root alone knows
  CatalogueSummary summary;
  {
    std::set<std::string> doubts_told;
    parallel::StepDisplay display(options.quiet || !world.is_root());
    for (std::size_t i = 0; i < catalogue.entries.size(); ++i) {
      const CatalogueEntry& entry = catalogue.entries[i];
      display.show("entry " + entry.words.id, i + 1, catalogue.entries.size());
      const auto work = static_cast<Work>(plan.work[i]);
      ++(work == keep ? summary.kept : work == refit ? summary.refitted : summary.computed);
      if (work != keep)
        compute(world, entry, work, entry_folder(folder, entry.words.id), plan.fingerprints[i], options, doubts_told);
    }
  }
  std::vector<std::int64_t> others{0};
  world.on_root([&] {
    const Database db = assemble(catalogue, plan, before, folder);
    others[0] = static_cast<std::int64_t>(db.entries.size() - catalogue.entries.size());
    lock->confirm();
    io::write_database(folder / io::database_name, db);
    io::write_result(folder / io::entries_csv_name, io::entries_csv(db));
    io::write_result(folder / io::curves_csv_name, io::curves_csv(db));
    io::write_result(folder / io::points_csv_name, io::points_csv(db));
    io::write_result(folder / io::words_name, io::words_json(db));
  });
  summary.others = world.broadcast(others)[0];
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return summary;
}

}  // namespace freestand::study
