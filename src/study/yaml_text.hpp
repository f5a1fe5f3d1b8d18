// Text as a word of YAML, quoted where it would read as something else, so that it may stand in braces too: names, files.
#pragma once

#include <string>

namespace freestand::study {

std::string yaml_text(const std::string&);

}  // namespace freestand::study
