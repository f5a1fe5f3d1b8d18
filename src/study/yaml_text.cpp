#include "study/yaml_text.hpp"

#include <yaml-cpp/yaml.h>

namespace freestand::study {

std::string yaml_text(const std::string& text) {
  YAML::Emitter list;
  list << YAML::Flow << YAML::BeginSeq << text << YAML::EndSeq;
  return {list.c_str() + 1, list.size() - 2};
}

}  // namespace freestand::study
