// What the jobs of a long computation have answered, kept in its folder. Started again after an interruption, the computation asks the
// same jobs in the same order, and what is kept need not be found again; the answers have the same bits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "parallel/block_log.hpp"

namespace freestand::study {

// Of all that answers follow from, this program included.
std::string fingerprint_of_answers(const std::string& content);

class KeptAnswers {
 public:
  // folder: of the logs (parallel/block_log.hpp). Answers of another fingerprint in it are an Error (Exit::usage). Collective.
  KeptAnswers(const parallel::Communicator&, const std::filesystem::path& folder, const std::string& fingerprint);

  // Of job i of the call so many. On any rank.
  std::optional<std::vector<double>> find(std::int64_t call, std::size_t i) const;
  // took_s: how long it was looked for; what is found at once again is not kept.
  void keep(std::int64_t call, std::size_t i, const std::vector<double>& answer, double took_s);

 private:
  parallel::BlockLog log_;
  std::vector<std::int64_t> found_;  // ascending
};

}  // namespace freestand::study
