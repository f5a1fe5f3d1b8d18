// The study of a finished sweep, for what is asked of it afterwards.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/samples_file.hpp"
#include "parallel/communicator.hpp"
#include "study/study.hpp"
#include "study/sweep.hpp"

namespace freestand::study {

// How many samples were swept; the first reader.rows() of them are kept.
std::int64_t swept_samples(const io::SampleReader&);

// How many of the first samples, and of those that are kept, were taken whatever their intensity: what is asked of all intensities together, or over another
// one than `until` was, comes from them.
std::int64_t samples_alike(const io::SampleReader&);
std::int64_t rows_alike(const io::SampleReader&);

// What is to be told where an answer comes from so many of the first samples; empty where these are all.
std::string kept_told(const io::SampleReader&, std::int64_t rows);

// As stored with the samples, records not looked for; the fragility block is that of fragility.h5 where there is one: what was fitted
// last.
Study analysed_study(const std::filesystem::path& folder, const io::SampleReader&);

// Ready to compute samples again: study.yaml of the folder, which knows where the records lie. Throws Error (Exit::usage) where that
// is not the study of the samples. Collective.
Study swept_study(const parallel::Communicator&, const std::filesystem::path& folder, const io::SampleReader&);

}  // namespace freestand::study
