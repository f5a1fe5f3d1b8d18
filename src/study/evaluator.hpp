// Samples of a study, from their indices to their rows in samples.h5.
#pragma once

#include <cstdint>
#include <freestand/simulate.hpp>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/table.hpp"
#include "study/motion_summaries.hpp"
#include "study/realise.hpp"
#include "study/study.hpp"

namespace freestand::study {

// A pure function of the sample index; const and safe to share between threads.
class Evaluator {
 public:
  Evaluator(const Study&, MotionSet, MotionSummaries);
  Evaluator(const Study&, MotionSet);  // summarizes the motions itself

  // Columns of a row: the draws (Realiser::draw_columns), edp_NAME for every demand parameter, outcome, events.
  // Intensities follow from them (intensities.hpp).
  const std::vector<Column>& columns() const;

  // Draws, integrates and appends the row of this sample. Demand parameters without meaning for an overturned block,
  // and all of a sample that failed, are nan.
  Outcome append(std::uint64_t sample, std::vector<double>& values) const;

  // The same, integrated by itself, never in a pack: to check those.
  Outcome append_alone(std::uint64_t sample, std::vector<double>& values) const;

  // Which samples are integrated, from their draws.
  using Taken = std::function<std::vector<bool>(const Table& draws)>;

  // The same as append(), for samples first ... first + count - 1, integrated in packs: the same rows, to the bit, in
  // blocks of any size. Tells the outcomes in order: passed_over of those that are not taken, whose rows hold their draws.
  std::vector<Outcome> append(std::uint64_t first, std::size_t count, std::vector<double>& values,
                              const Taken& taken = {}) const;

  // What is known of samples 0 ... count - 1 before they are integrated.
  Table draws(std::size_t count) const;

  const MotionSet& motions() const;
  const MotionSummaries& summaries() const;

  // The same motions, for a study that differs from this one in what it draws (Study::redrawn).
  Evaluator drawing(const Study&) const;

 private:
  struct Parts;
  explicit Evaluator(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};

}  // namespace freestand::study
