// The samples of a finished sweep of the same study, to which more are added: they are not computed again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "io/samples_file.hpp"
#include "study/study.hpp"

namespace freestand::study {

class EarlierSamples {
 public:
  // Those of the folder; none where it holds no samples.h5, or has lost the counts of those that samples.h5 does not keep. Throws Error
  // (Exit::usage): they are of another study, are more than the study wants, or would be others with its number of samples.
  EarlierSamples(const Study&, const std::filesystem::path& folder, io::Closing = io::Closing::check);

  // Of a sweep that passed samples over, those before the first of them: which ones it passed over was for its own study.
  std::int64_t rows() const { return rows_; }

  // All that the study asks for: nothing is left to do. With `until` only if it is the very same study.
  bool complete() const { return complete_; }

  // Throws Error (Exit::usage) if a record has changed since; if this program gives other numbers.
  void check_records(const std::string& motions_fingerprint) const;
  void check(const std::vector<Column>& columns, const std::string& motions_fingerprint) const;

  // Values of rows first ... first + count - 1, row by row.
  std::vector<double> read(std::int64_t first, std::int64_t count) const;

 private:
  std::shared_ptr<const io::SampleReader> reader_;
  std::filesystem::path folder_;
  std::int64_t rows_ = 0;
  bool complete_ = false;
};

}  // namespace freestand::study
