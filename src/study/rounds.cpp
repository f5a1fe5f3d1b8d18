#include "study/rounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <sstream>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "fragility/tally_layout.hpp"
#include "parallel/run_files.hpp"
#include "study/analysis.hpp"

namespace freestand::study {
namespace {

// A line a round: where it ends, and a 1 for each bin from which it takes samples. The last line says that the file is whole.
std::string text_of_rounds(const std::string& fingerprint, const std::vector<Round>& rounds) {
  std::string text = fingerprint + "\n";
  for (const Round& round : rounds) {
    text += fmt::format("{} ", round.end);
    for (const bool takes : round.bins) text += takes ? '1' : '0';
    text += "\n";
  }
  return text + "end\n";
}

// Nothing of a file that is another's, or not as it was written.
std::vector<Round> rounds_of(const std::string& text, const std::string& fingerprint) {
  std::vector<Round> rounds;
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != fingerprint) return {};
  while (std::getline(lines, line) && line != "end") {
    std::istringstream words(line);
    Round round;
    std::string bins;
    words >> round.end >> bins;
    for (const char takes : bins) round.bins.push_back(takes == '1');
    rounds.push_back(std::move(round));
  }
  return text_of_rounds(fingerprint, rounds) == text ? rounds : std::vector<Round>{};
}

}  // namespace

Rounds::Rounds(const parallel::Communicator& world, const std::filesystem::path& folder, std::string fingerprint)
    : world_(world), file_(parallel::run_file(folder, 0, 0, "rounds")), fingerprint_(std::move(fingerprint)) {}

void Rounds::read() {
  std::string text;
  world_.on_root([&] {
    if (is_there(file_)) text = read_whole(file_);
  });
  rounds_ = rounds_of(world_.broadcast(text), fingerprint_);
}

void Rounds::add(Round round) {
  rounds_.push_back(std::move(round));
  world_.on_root([&] { write_durably(file_, text_of_rounds(fingerprint_, rounds_)); });
}

const Round& Rounds::of(std::int64_t sample) const {
  const auto later = std::upper_bound(rounds_.begin(), rounds_.end(), sample,
                                      [](std::int64_t s, const Round& round) { return s < round.end; });
  return later == rounds_.end() ? rounds_.back() : *later;
}

std::int64_t Rounds::alike() const {
  std::int64_t alike = 0;
  for (const Round& round : rounds_) {
    if (!round.bins.empty()) break;
    alike = round.end;
  }
  return alike;
}

RoundBins::RoundBins(const Study& study, const Target& target, const Evaluator& evaluator)
    : intensity_(study.fragility.im, evaluator.summaries()) {
  const auto first = static_cast<std::size_t>(std::min(static_cast<std::int64_t>(study.samples), bin_layout_samples));
  const fragility::Options options =
      laid_out(study, target, intensity_.beside(evaluator.draws(first)), evaluator.motions().groups());
  edge_ = options.im_edge;
  open_ends_ = options.open_ends;
}

std::vector<bool> RoundBins::taken(const Round& round, const Table& draws) const {
  std::vector<bool> taken(draws.rows(), true);
  if (round.bins.empty()) return taken;
  const std::vector<double> intensity = intensity_(draws);
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const int bin = fragility::bin_index(edge_, intensity[i], open_ends_);
    taken[i] = bin >= 0 && round.bins.at(static_cast<std::size_t>(bin));
  }
  return taken;
}

}  // namespace freestand::study
