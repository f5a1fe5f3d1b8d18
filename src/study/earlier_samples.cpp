#include "study/earlier_samples.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>

#include "base/folder.hpp"
#include "study/changed_keys.hpp"
#include "study/kernel_number.hpp"
#include "study/sweep.hpp"
#include "study/swept_study.hpp"

namespace freestand::study {
namespace {

const char* other_folder = "choose another folder, or give --overwrite to replace them";

// Studies that agree in it share their first samples, but with latin_hypercube: only how many there are, and in which
// blocks, may differ.
std::string draws_fingerprint(Study study) {
  study.samples = study.block_size = 1;
  study.until.reset();
  return samples_fingerprint(study);
}

bool same_names(const std::vector<Column>& a, const std::vector<Column>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].name != b[i].name) return false;
  return true;
}

}  // namespace

EarlierSamples::EarlierSamples(const Study& study, const std::filesystem::path& folder, io::Closing closing)
    : folder_(folder) {
  if (!is_there(samples_path(folder))) return;
  reader_ = std::make_shared<const io::SampleReader>(samples_path(folder), closing);
  if (reader_->rows() < swept_samples(*reader_) && !is_there(tally_path(folder))) {
    reader_.reset();
    return;
  }
  const Study swept = parse_stored(reader_->provenance().study, folder);
  const auto wanted = static_cast<std::int64_t>(study.samples);
  if (draws_fingerprint(swept) != draws_fingerprint(study))
    throw Error(fmt::format("{} holds the results of another study ({}): take that back, or {}", folder.string(),
                            changes_told(study, swept), other_folder));
  rows_ = rows_alike(*reader_);
  const std::int64_t there = swept_samples(*reader_);
  complete_ = study.until || swept.until ? expanded(swept) == expanded(study) : there == wanted;
  if (complete_) return;
  if (reader_->rows() < there)
    throw Error(fmt::format(
        "{} holds the counts of {} samples of this study, of which {} are kept, and none can be added{}: {}",
        folder.string(), there, reader_->rows(),
        study.design == sampling::Design::latin_hypercube ? "" : " (keep: all would have let it)", other_folder));
  if (rows() > wanted)
    throw Error(
        fmt::format("{} holds {} samples of this study, and {} are asked for (none is taken away): `freestand "
                    "fit` uses those that are there; or {}",
                    folder.string(), rows(), wanted, other_folder));
  if (study.design == sampling::Design::latin_hypercube)
    throw Error(
        fmt::format("{} holds {} samples of this study, and none can be added (design latin_hypercube: every "
                    "draw depends on the number of samples, {} now): {}; sobol and monte_carlo can be added to",
                    folder.string(), rows(), wanted, other_folder));
}

void EarlierSamples::check(const std::vector<Column>& columns, const std::string& motions_fingerprint) const {
  if (!reader_) return;
  const bool same_program = reader_->provenance().kernel == kernel_text() && same_names(reader_->columns(), columns);
  if (!same_program)
    throw Error(fmt::format(
        "{} holds samples of another version of freestand or kind of machine, which gives other numbers: add to them "
        "with the program that made them, there; or {}",
        folder_.string(), other_folder));
  check_records(motions_fingerprint);
}

void EarlierSamples::check_records(const std::string& motions_fingerprint) const {
  if (reader_ && reader_->motions().fingerprint != motions_fingerprint)
    throw Error(
        fmt::format("{} holds samples of other records (one has other contents now, or another name): take it "
                    "back; or {}",
                    folder_.string(), other_folder));
}

std::vector<double> EarlierSamples::read(std::int64_t first, std::int64_t count) const {
  return reader_->read(first, count).values;
}

}  // namespace freestand::study
