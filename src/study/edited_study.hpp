// What `fit` goes by: the study that was swept, with the fragility block as it stands in study.yaml now.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace freestand::study {

// A number or word that two studies do not share: its dotted key, "friction.mu_k"; "nothing" where one has no such key.
struct Difference {
  std::string key, now, before;
};

// What determines the numbers of two studies and differs, in the order of `now`; what that lacks comes last. The name is
// none of it.
std::vector<Difference> differences(const Study& now, const Study& before);

struct EditedStudy {
  Study study;
  std::vector<std::string> changed;  // keys of the fragility block that the file gives otherwise than the sweep did
};

// swept: the expanded text that the samples carry. text: of `file`, the study.yaml beside them, which its user may have
// edited. Only the name and the fragility block may be: samples are what they are. Throws Error (Exit::usage): the file
// is no study, or the first key that says something else than was swept, with its line.
EditedStudy edited_study(const std::string& swept, const std::string& text, const std::filesystem::path& file);

}  // namespace freestand::study
