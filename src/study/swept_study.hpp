// The study of a finished sweep, for what is asked of it afterwards.
#pragma once

#include <filesystem>

#include "io/samples_file.hpp"
#include "parallel/communicator.hpp"
#include "study/study.hpp"
#include "study/sweep.hpp"

namespace freestand::study {

// As stored with the samples, records not looked for; the fragility block is that of fragility.h5 where there is one: what was fitted
// last.
Study analysed_study(const std::filesystem::path& folder, const io::SampleReader&);

// Ready to compute samples again: study.yaml of the folder, which knows where the records lie. Throws Error (Exit::usage) where that
// is not the study of the samples. Collective.
Study swept_study(const parallel::Communicator&, const std::filesystem::path& folder, const io::SampleReader&);

}  // namespace freestand::study
