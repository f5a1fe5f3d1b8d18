// `motion --synthetic`: what the motions of a set are, and files of them.
#pragma once

#include <cstdint>
#include <string>

namespace freestand::app {

struct SyntheticOptions {
  std::string file;        // synthetic.yaml
  std::uint64_t seed = 1;  // of the study that would draw them
  int number = -1;         // of one motion; -1: all of the set
  std::string convert;     // one motion: a file; all: a new folder; empty: nothing is written
  std::string csv;         // a table of the records in that folder; empty: none
};

// Throws Error (Exit::usage) where the set or the options are wrong. Files are replaced: who may do so has asked before.
void show_synthetic(const SyntheticOptions&);

}  // namespace freestand::app
