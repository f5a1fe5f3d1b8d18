#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "effects/effects.hpp"
#include "measurement/fit/grown_fit.hpp"
#include "measurement/fit/outcome_fit.hpp"
#include "measurement/fit/posterior.hpp"
#include "study/calibrate_keys.hpp"
#include "study/fitted_study.hpp"
#include "study/section.hpp"
#include "study/spread_jobs.hpp"
#include "study/validation_parts.hpp"

namespace freestand::study {
namespace {

using namespace measurement;

// The entry of `effects`: from a name of the catalogue, YAML text, or a file.
YAML::Node effect_node(const std::string& effect) {
  std::string text = effect;
  if (text.find_first_of("{:\n") == std::string::npos) {
    if (const dynamics::Effect* known = effects::find(text)) {
      YAML::Node node(YAML::NodeType::Map);
      node["name"] = text;
      for (const auto& p : known->parameters)
        if (p.fitted) {
          const auto [lower, upper] = fitted_within(p, p.low, p.high);
          node[p.name] = calibrate_node(lower, upper);
        }
      return node;
    }
    std::ifstream stream(text);
    if (!stream) {
      if (text.find('/') != std::string::npos || text.ends_with(".yaml"))
        throw Error(fmt::format("{} cannot be opened (an effect may stand in a file): correct the path", text));
      std::vector<std::string> names;
      for (const auto& e : effects::all()) names.push_back(e.name);
      throw Error(
          fmt::format("effect {} is not known ({}): choose one of `freestand effects`, or give a formula as a "
                      "YAML mapping or in a file",
                      text, hint(text, names)));
    }
    std::ostringstream content;
    content << stream.rdbuf();
    text = content.str();
  }
  try {
    YAML::Node node = YAML::Load(text);
    if (node.IsMap() && node["name"]) return node;
  } catch (const YAML::Exception&) {
  }
  throw Error(fmt::format("\"{}\" is no effect (a mapping with a name is needed): write {}", effect,
                          "{name: bumps, friction: \"mu*(1 + a*sin(2*pi*u/l))\", parameters: {a: {calibrate: [0, 1]}, "
                          "l_m: {calibrate: [0.01, 1]}}}"));
}

// Effects of the catalogue start within the catalogue's range, not within all that is allowed; numbers that were fitted
// before, near where they stood.
ModelSpec starting(const Prepared& before, const ModelFit& fit, const Prepared& after) {
  ModelSpec model = after.model;
  const EffectTerm& added = model.effects.back();
  for (std::size_t i = 0; i < added.parameters.size(); ++i) {
    const int place = added.parameters[i].free;
    const dynamics::Effect* known = effects::find(added.effect->name);
    if (place < 0 || !known) continue;
    Free& free = model.free[static_cast<std::size_t>(place)];
    const Free range = free_parameter(*known, known->parameters[i], after.bench->reach());
    free.low = range.low;
    free.high = range.high;
    free.logarithmic = range.logarithmic;
  }
  for (Free& free : model.free)
    for (std::size_t i = 0; i < before.model.free.size(); ++i) {
      if (before.model.free[i].name != free.name || !(fit.x[i] > 0) || !free.logarithmic) continue;
      free.low = std::max(free.lower, fit.x[i] / 1.6);
      free.high = std::min(free.upper, fit.x[i] * 1.6);
    }
  return model;
}

LadderStep step_of(const std::string& step, const Prepared& p, const ModelFit& fit, const Posterior& open,
                   const Jobs& jobs) {
  const auto tests = compare_tests(*p.bench, fit, open, jobs);
  const RoleError in = role_error(*p.bench, tests, Role::calibration), out = role_error(*p.bench, tests, Role::holdout);
  const double none = std::nan("");
  return {step,
          in.error,
          out.tests ? out.error : none,
          in.expected,
          out.tests ? out.expected : none,
          out.tests ? out.explained : none,
          in.explained};
}

YAML::Node ladder_node(const std::vector<LadderStep>& ladder) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const LadderStep& s : ladder) {
    YAML::Node step(YAML::NodeType::Map);
    step["step"] = s.step;
    const auto put = [&](const char* key, double value) {
      if (std::isfinite(value)) step[key] = fmt::format("{:.6g}", value);
    };
    put("error_calibration", s.error_calibration);
    put("error_holdout", s.error_holdout);
    put("noise_floor", s.noise_floor);
    put("noise_floor_holdout", s.noise_floor_holdout);
    put("explained_holdout", s.explained_holdout);
    put("explained_calibration", s.explained_calibration);
    step.SetStyle(YAML::EmitterStyle::Flow);
    list.push_back(step);
  }
  return list;
}

}  // namespace

std::string add(const parallel::Communicator& world, const ValidationRun& run, const std::string& effect,
                const std::filesystem::path& folder) {
  const Jobs jobs = spread_jobs(world, run.quiet);
  const auto before = prepare(world, run, 16);
  world.on_root([&] { effect_node(effect); });
  const YAML::Node entry = effect_node(effect);

  YAML::Node root = YAML::Load(before->validation.text);
  YAML::Node model = root["model"];
  write_block(root, *before);
  name_placement_scatter(root, *before);
  if (!model["effects"] || !model["effects"].IsSequence()) model["effects"] = YAML::Node(YAML::NodeType::Sequence);
  if (entry["name"].as<std::string>() == "static_friction")  // which says what these said
    for (const char* key : {"mu_s", "static_ratio"}) model["friction"].remove(key);
  model["effects"].push_back(entry);
  model["effects"].SetStyle(YAML::EmitterStyle::Block);
  const auto after = prepare(world, parse_validation(study_text(root), before->validation.file), run, 16);

  const ModelFit base = fitted(*before, false, jobs);
  ModelFit fit = fit_with_effect(*after->bench, base, starting(*before, base, *after), jobs);
  const Posterior open = open_numbers(*after->bench, fit, jobs);

  std::vector<LadderStep> ladder = before->validation.ladder;
  if (before->measurements != before->validation.measurements) ladder.clear();  // it is of other tests
  if (ladder.empty()) {
    ModelFit told = base;  // as `compare` tells it
    const Posterior of_base = open_numbers(*before->bench, told, jobs);
    ladder.push_back(step_of("base", *before, told, of_base, jobs));
  }
  ladder.push_back(step_of(entry["name"].as<std::string>(), *after, fit, open, jobs));
  write_numbers(root, fit);
  model.remove("discrepancy");  // of the model without the effect
  root["ladder"] = ladder_node(ladder);
  write_paths(root, *before, folder);
  return study_text(root);
}

}  // namespace freestand::study
