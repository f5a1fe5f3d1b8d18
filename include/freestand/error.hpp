// The one exception of freestand. Only main catches it.
#pragma once

#include <stdexcept>
#include <string>

namespace freestand {

// Exit codes of the program (fixed: scripts rely on them).
enum class Exit : int {
  done = 0,
  usage = 2,      // wrong command line or study file
  data = 3,       // a record, data set or result file that cannot be used
  cure = 74,      // what is finished is kept, but starting again helps only once this is cured: a full disk, say
  resumable = 75  // stopped early on request; --resume goes on
};

// A problem that the user can act on. The text reads "problem (why): what to do"; several problems stand on several
// lines.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& text, Exit exit = Exit::usage) : std::runtime_error(text), exit_(exit) {}
  Exit exit() const { return exit_; }

 private:
  Exit exit_;
};

}  // namespace freestand
