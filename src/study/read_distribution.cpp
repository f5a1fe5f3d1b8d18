// A number of the study file, which may be a distribution.
#include <fmt/format.h>

#include <cmath>

#include "base/shown_text.hpp"
#include "study/section.hpp"

namespace freestand::study {
namespace {

using namespace sampling;

const std::vector<std::string> kinds_of_distribution = {"uniform",    "log_uniform", "normal",   "lognormal",
                                                        "triangular", "choice",      "posterior"};

// The n numbers of `key`, or nothing and a problem.
std::optional<std::vector<double>> exactly(Section& section, const std::string& key, std::size_t n, const char* form) {
  const std::size_t before = section.problems().count();
  const auto values = section.numbers(key);
  if (section.problems().count() != before) return {};
  if (values.size() == n) return values;
  section.problem(key, fmt::format("{} has {} numbers ({} are needed): write {}: {}", section.name(key), values.size(),
                                   n, key, form));
  return {};
}

// A number that the distribution cannot do without.
double needed(Section& parameters, const std::string& key) {
  if (!parameters.has(key))
    parameters.problem(key,
                       fmt::format("{} is missing (the distribution needs it): add {}", parameters.name(key), key));
  return parameters.number(key, std::nan(""));
}

std::optional<Distribution> read_normal(const YAML::Node& node, const std::string& where, int line,
                                        Problems& problems) {
  Section parameters(node, where, line, problems);
  if (!node.IsMap()) return {};
  const double mean = needed(parameters, "mean"), deviation = needed(parameters, "standard_deviation");
  const double min = parameters.number("min", -unbounded), max = parameters.number("max", unbounded);
  parameters.finish();
  if (std::isnan(mean) || std::isnan(deviation)) return {};
  return Normal{mean, deviation, min, max};
}

std::optional<Distribution> read_lognormal(const YAML::Node& node, const std::string& where, int line,
                                           Problems& problems) {
  Section parameters(node, where, line, problems);
  if (!node.IsMap()) return {};
  const double median = needed(parameters, "median"), dispersion = needed(parameters, "dispersion");
  const double min = parameters.number("min", 0), max = parameters.number("max", unbounded);
  parameters.finish();
  if (std::isnan(median) || std::isnan(dispersion)) return {};
  return Lognormal{median, dispersion, min, max};
}

std::optional<Distribution> read_kind(Section& section, const std::string& kind) {
  if (kind == "normal")
    return read_normal(*section.find(kind), section.name(kind), section.line(kind), section.problems());
  if (kind == "lognormal")
    return read_lognormal(*section.find(kind), section.name(kind), section.line(kind), section.problems());
  if (kind == "choice") {
    const std::size_t before = section.problems().count();
    Choice choice{section.numbers("choice"), section.numbers("weights")};
    if (section.problems().count() != before) return {};
    return choice;
  }
  if (kind == "posterior") {
    const std::size_t before = section.problems().count();
    Posterior joint{section.text("posterior", ""), section.text("column", ""), section.numbers("values")};
    if (section.problems().count() != before) return {};
    return joint;
  }
  if (kind == "triangular") {
    const auto v = exactly(section, kind, 3, "[lower, mode, upper]");
    return v ? std::optional<Distribution>(Triangular{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
  }
  const auto v = exactly(section, kind, 2, "[lower, upper]");
  if (!v) return {};
  if (kind == "uniform") return Uniform{(*v)[0], (*v)[1]};
  return LogUniform{(*v)[0], (*v)[1]};
}

std::optional<Distribution> read_mapping(const YAML::Node& node, const std::string& where, int line,
                                         Problems& problems) {
  Section section(node, where, line, problems);
  std::string found;
  for (const auto& kind : kinds_of_distribution)
    if (section.has(kind)) {
      if (!found.empty()) {
        problems.add(
            section.line(kind),
            fmt::format("{} is both {} and {} (one distribution for one number): remove one", where, found, kind));
        return {};
      }
      found = kind;
    }
  if (found.empty()) {
    const std::string first = node.size() ? node.begin()->first.Scalar() : "";
    std::vector<std::string> meant = kinds_of_distribution;
    if (first != "calibrate") meant.emplace_back("calibrate");  // in a study that is held against measurements
    problems.add(line, fmt::format("{} has no known distribution ({}): use one of {}", where,
                                   nearest(first, meant).empty() ? "found " + (first.empty() ? "nothing" : shown(first))
                                                                 : hint(first, meant),
                                   joined(kinds_of_distribution)));
    return {};
  }
  if (!section.find(found)) return {};
  const auto distribution = read_kind(section, found);
  section.finish();
  return distribution;
}

}  // namespace

std::optional<Distribution> read_distribution(const YAML::Node& node, const std::string& where, int line,
                                              Problems& problems) {
  std::optional<Distribution> distribution;
  if (node.IsScalar()) {
    const auto value = number_of(node.Scalar());
    if (!value) {
      problems.add(line, fmt::format("{} is \"{}\" (a number or a distribution is needed): write 0.6 or {}", where,
                                     shown(node.Scalar()), "{uniform: [0.5, 0.7]}"));
      return {};
    }
    distribution = Fixed{*value};
  } else if (node.IsSequence()) {
    problems.add(line, fmt::format("{} is a list (a number or a distribution is needed): write {}", where,
                                   "{choice: [...]} or {uniform: [lower, upper]}"));
    return {};
  } else {
    distribution = read_mapping(node, where, line, problems);
  }
  if (!distribution) return {};
  if (const auto wrong = mistake(*distribution)) {
    problems.add(line, where + ": " + *wrong);
    return {};
  }
  return distribution;
}

std::optional<Names> read_names(const YAML::Node& node, const std::string& where, int line, Problems& problems) {
  if (node.IsScalar()) return Names{{node.Scalar()}, {}};
  Names names;
  YAML::Node list = node;
  if (node.IsMap()) {
    Section section(node, where, line, problems);
    const YAML::Node* choice = section.find("choice");
    names.weights = section.numbers("weights");
    section.finish();
    if (!choice) {
      problems.add(line, fmt::format("{} has no choice (names are drawn from a list): write {}", where,
                                     "{choice: [A, B], weights: [2, 1]}"));
      return {};
    }
    list.reset(*choice);
  }
  if (!list.IsSequence()) {
    problems.add(line, where + " is no list of names (a choice is drawn from a list): write [A, B]");
    return {};
  }
  for (const auto& entry : list) names.values.push_back(entry.IsScalar() ? entry.Scalar() : "");
  if (const auto wrong = mistake(names)) {
    problems.add(line, where + ": " + *wrong);
    return {};
  }
  return names;
}

void check_range(const Distribution& distribution, const Range& range, const std::string& where, int line,
                 Problems& problems) {
  const Support s = support(distribution);
  const bool low =
      s.lower < range.lower || (s.lower == range.lower && range.lower_open && !s.lower_open && std::isfinite(s.lower));
  const bool high =
      s.upper > range.upper || (s.upper == range.upper && range.upper_open && !s.upper_open && std::isfinite(s.upper));
  if (!low && !high) return;
  const double end = low ? s.lower : s.upper;
  if (is_fixed(distribution)) {
    problems.add(line, fmt::format("{} is {} ({}): correct the number", where, number_text(end), range.why));
    return;
  }
  const std::string reach = std::isinf(end) ? fmt::format("its distribution has no {} end", low ? "lower" : "upper")
                            : low && std::holds_alternative<Lognormal>(distribution)
                                ? fmt::format("its distribution comes as near to {} as it may", number_text(end))
                                : fmt::format("its distribution reaches {}", number_text(end));
  const bool cuttable = std::holds_alternative<Normal>(distribution) || std::holds_alternative<Lognormal>(distribution);
  problems.add(line,
               fmt::format("{} can take impossible values ({}, and {}): {}", where, reach, range.why,
                           !cuttable                                         ? "move that end"
                           : !low                                            ? "cut it with max"
                           : std::holds_alternative<Lognormal>(distribution) ? "cut it with min"
                                                                             : "cut it with min, or use lognormal"));
}

}  // namespace freestand::study
