// What a sweep keeps of its floor motions: enough for any intensity of any sample, without the motions being there.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/samples_file.hpp"
#include "motion/summary.hpp"
#include "parallel/communicator.hpp"
#include "parallel/step_display.hpp"
#include "study/realise.hpp"

namespace freestand::study {

// By the index of the motion.
using MotionSummaries = std::vector<motion::MotionSummary>;

// Peaks, pulse and, at these periods, the spectrum of every motion; none given: no spectra. By this process alone.
MotionSummaries summarize(const MotionSet&, const std::vector<double>& sa_period_s);

// The same with the periods that are kept of every record and the one that the study asks for. Each rank does its share.
// display: of the root; null: none. Collective.
MotionSummaries summarize_together(const parallel::Communicator&, const Study&, const MotionSet&,
                                   parallel::StepDisplay* display);

// Whose periods w_p of delta comes from, over the records: {"records": 3, "period_given": 1, "period_identified": 2}.
nlohmann::ordered_json record_pulses_json(const MotionSummaries&);

// To samples.h5 and back, to the bit. Pulses are known by their names.
io::MotionRows motion_rows(const MotionSet&, const MotionSummaries&);
MotionSummaries motion_summaries(const io::MotionRows&);

// Of each motion the one of the ground under its building; of one that is of no floor itself.
std::vector<std::size_t> grounds(const io::MotionRows&);

}  // namespace freestand::study
