// What a study samples: each number that is no fixed one, and the motion, with the class that a sample's draw falls in.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "decision/shares.hpp"
#include "study/study.hpp"

namespace freestand::study {

struct Sampled {
  decision::Parameter parameter;
  std::vector<std::string> streams;  // names of its draws, for Study::redrawn
  // Class of a sample, by the uniform that its draw was made from: a pure function of its number, as the draw is. `motion`: which
  // one it was shaken by. parameter.classes: a sample that has none, as the period of a record.
  std::function<int(std::uint64_t sample, std::size_t motion)> class_of;
};

// Numbers that are columns of one table of joint draws as one, the table ("friction.mu with impact.factor (drawn together)"); other numbers of
// the model by their names in the study; motion.* by the entry that a sample takes; `motion`, where there are several
// (`motions`: how many; `ground`: of each the one that it is the floor of, which counts for it, since motion.storey is a number of
// its own; empty: itself).
std::vector<Sampled> sampled(const Study&, std::size_t motions, const std::vector<std::size_t>& ground = {});

// Parameters that nothing depends on, of the designs that those of the study are even in (decision::Parameter::design: 0 independent draws and
// latin hypercubes, 1 dimensions of a Sobol design, 2 its first dimension in orders of their own, from 3 on the same with as many
// classes as a table of joint draws has): what their classes scatter by is chance.
std::vector<Sampled> idle_parameters(const Study&, const std::vector<Sampled>&);

}  // namespace freestand::study
