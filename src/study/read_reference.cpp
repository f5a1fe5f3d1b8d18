#include "study/read_reference.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/shown_text.hpp"

namespace freestand::study {
namespace {

template <class Words>
void check_known(Section& section, const char* key, const std::string& name, const Words& words) {
  std::vector<std::string> names;
  for (const auto& word : words) names.push_back(word.name);
  if (!name.empty() && std::ranges::find(names, name) == names.end())
    section.problem(key,
                    fmt::format("reference.{} {} is not known ({}): correct it", key, shown(name), hint(name, names)));
}

}  // namespace

void read_reference(const YAML::Node& node, int line, const Known& known, database::Entry& words, Problems& problems) {
  Section section(node, "reference", line, problems);
  words.reference_source = section.text("source", "");
  words.reference_id = section.text("id", "");
  words.reference_im = section.text("intensity", "");
  words.reference_demand = section.text("demand", "");
  words.reference_capacity = section.optional_number("capacity", range::positive).value_or(database::unknown);
  words.reference_median = section.optional_number("median", range::positive).value_or(database::unknown);
  words.reference_dispersion = section.optional_number("dispersion", range::positive).value_or(database::unknown);
  if (!node.IsMap()) return;
  const auto takes_capacity = [&](const KnownEdp& edp) { return edp.name == words.reference_demand && !edp.binary; };
  if (std::ranges::any_of(known.edps, takes_capacity) && !section.has("capacity"))
    section.problem("capacity", "reference.capacity is missing (the demand exceeds something): add it");
  for (const char* key : {"source", "intensity", "demand", "median", "dispersion"})
    if (!section.has(key))
      section.problem(
          key, fmt::format("reference.{} is missing (a reference is a lognormal over an intensity): add it", key));
  check_known(section, "intensity", words.reference_im, known.intensities);
  check_known(section, "demand", words.reference_demand, known.edps);
  section.finish();
}

}  // namespace freestand::study
