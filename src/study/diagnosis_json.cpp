#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "base/folder.hpp"
#include "effects/effects.hpp"
#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/posterior.hpp"
#include "measurement/laboratory/quality.hpp"
#include "measurement/tell/findings.hpp"
#include "measurement/tell/recover.hpp"
#include "measurement/tell/suggest.hpp"
#include "measurement/tell/suggest_outcomes.hpp"
#include "measurement/verdict/decide.hpp"
#include "measurement/verdict/diagnose_outcomes.hpp"
#include "measurement/verdict/law_search.hpp"
#include "measurement/verdict/specimens.hpp"
#include "study/law_forms.hpp"
#include "study/read_parts.hpp"
#include "study/spread_jobs.hpp"
#include "study/sweep.hpp"
#include "study/validation_parts.hpp"

namespace freestand::study {
namespace {

using namespace measurement;
using Json = nlohmann::ordered_json;

std::string label(const Candidate& c) { return fmt::format("{}", fmt::join(c.effects, "+")); }

// Errors on tests left out only where the model was fitted without them.
Json candidate_json(const Bench& bench, const Candidate& c) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const bool judged = c.visible && c.fit.left_out_refitted;
  const Pooled in = pooled(bench, tests, c.fit.calibration), out = pooled(bench, tests, c.fit.left_out);
  const auto of_left_out = [&](double value) { return judged ? number_or_null(value) : Json(nullptr); };
  Json parameters = Json::object();
  for (std::size_t i = 0; i < c.fit.x.size() && c.visible; ++i) {
    const Free& free = c.fit.model.free[i];
    parameters[free.name] = {{"value", c.fit.x[i]}, {"unit", free.unit}};
    add_interval(parameters[free.name], c.fit, i);
  }
  return {{"effect", label(c)},
          {"effects", c.effects},
          {"visible", c.visible},
          {"parameters", parameters},
          {"error_calibration", number_or_null(in.error)},
          {"error_left_out", of_left_out(out.error)},
          {"error_left_out_se", of_left_out(out.standard_error)},
          {"error_left_out_floor_noise_allowed", of_left_out(c.explained)},
          {"chi_square_left_out", of_left_out(c.misfit)},
          {"chi_square_fit", number_or_null(c.misfit_of_fit)},
          {"delta_bic", number_or_null(c.delta_bic)},
          {"score_left_out_above_best", of_left_out(c.difference)},
          {"score_left_out_above_best_se", of_left_out(c.difference_se)},
          {"as_good_as_best", c.rival},
          {"numbers_as_met_in_practice", c.practical},
          {"left_out_refitted", judged},
          {"remark", c.remark.empty() ? Json(nullptr) : Json(c.remark)},
          {"evaluations", c.fit.evaluations}};
}

// What was recovered, and beside it the law of the model that the verdict means; of none, of the base.
Json recovered_json(const Bench& bench, const Diagnosis& d, const Candidate& shown) {
  const ModelFit& base = d.base.fit;
  const double mu = base.model.mu_k.of(base.x);
  const Recovered r = recover(bench, mu, shown.fit.model, shown.fit.x);
  Json json = {{"samples", r.samples},
               {"base_mu", mu},
               {"mean_mu", number_or_null(r.mean_mu)},
               {"sample_noise_mu", number_or_null(r.sample_noise_mu)},
               {"tables", Json::array()}};
  for (const RecoveredTable& t : r.tables) {
    json["tables"].push_back({{"variable", t.variable},
                              {"unit", t.unit},
                              {"edge", numbers_or_null(t.edge)},
                              {"centre", numbers_or_null(t.centre)},
                              {"count", numbers_or_null(t.count)},
                              {"mu", numbers_or_null(t.mu)},
                              {"mu_deviation", numbers_or_null(t.mu_deviation)},
                              {"mu_lower", numbers_or_null(t.mu_lower)},
                              {"mu_upper", numbers_or_null(t.mu_upper)},
                              {"force_mps2", numbers_or_null(t.force_mps2)},
                              {"force_lower_mps2", numbers_or_null(t.force_lower_mps2)},
                              {"force_upper_mps2", numbers_or_null(t.force_upper_mps2)},
                              {"share_explained", number_or_null(t.share_explained)},
                              {"share_of_force_explained", number_or_null(t.share_of_force_explained)},
                              {"share_by_chance", number_or_null(t.share_by_chance)},
                              {"share_of_force_by_chance", number_or_null(t.share_of_force_by_chance)},
                              {"law",
                               {{"effects", shown.effects},
                                {"mu", numbers_or_null(t.law)},
                                {"force_mps2", numbers_or_null(t.law_force_mps2)},
                                {"follows", t.law_follows}}}});
  }
  return json;
}

Json outcome_suggestion_json(const Bench& bench, const Diagnosis& d, const Jobs& jobs) {
  std::vector<ModelFit> rivals;
  std::vector<std::string> names;
  for (const Candidate& c : d.candidates)
    if (c.rival) rivals.push_back(c.fit), names.push_back(fmt::format("{}", fmt::join(c.effects, " and ")));
  const OutcomeSuggestion s = suggest_outcomes(bench, rivals, names, jobs);
  return {{"between", d.effects},
          {"motion", {{"test", s.test}, {"scale", s.scale}}},
          {"specimen", nullptr},
          {"separation_noise_units", nullptr},
          {"probabilities", numbers_or_null(s.probability)},
          {"repeats", s.repeats},
          {"sentence", s.sentence}};
}

Json suggestion_json(const Bench& bench, const Diagnosis& d, const Jobs& jobs) {
  std::vector<ModelFit> rivals;
  for (const Candidate& c : d.candidates)
    if (c.rival) rivals.push_back(c.fit);
  if (rivals.size() < 2) return nullptr;
  if (outcomes_only(bench.data())) return outcome_suggestion_json(bench, d, jobs);
  const Suggestion s = suggest(bench, rivals, effects::find("vertical_shaking"), jobs);
  Json specimen = nullptr;
  if (s.friction_factor != 1)
    specimen = fmt::format("surfaces with about {:.2g} times the friction", s.friction_factor);
  return {{"between", d.effects},
          {"motion",
           {{"pulse", s.pulse},
            {"period_s", s.period_s},
            {"peak_acceleration_g", s.peak_acceleration_g},
            {"vertical_peak_acceleration_g", s.vertical_share * s.peak_acceleration_g}}},
          {"specimen", specimen},
          {"separation_noise_units", number_or_null(s.separation)},
          {"sentence", s.sentence}};
}

// Of outcomes: Brier's score that the base would have if its probabilities were right.
double noise_floor(const Bench& bench, const Diagnosis& d) {
  double square = 0;
  if (outcomes_only(bench.data())) return expected_brier(d.base.fit.calibration).error;
  for (const double e : d.noise_floor) square += e * e / static_cast<double>(d.noise_floor.size());
  return d.noise_floor.empty() ? std::nan("") : std::sqrt(square);
}

// Of the base and of what the verdict names, those that `compare` gives the same fit; of all others by the scores, whatever the refits did.
// Those of outcomes come with the fits. Returned: the numbers of the base that draws suit better; empty: none do.
Values state_intervals(const Bench& bench, Diagnosis& d, const Jobs& jobs) {
  if (outcomes_only(bench.data())) return {};
  std::vector<ModelFit*> named = {&d.base.fit}, others;
  for (Candidate& c : d.candidates)
    if (c.visible) (c.rival ? named : others).push_back(&c.fit);
  if (d.proposal) named.push_back(&d.proposal->fit);
  Values better;
  for (ModelFit* fit : named) {
    ModelFit of_all = *fit;  // draws find the friction of each test themselves
    of_all.model.friction_of_test.clear();
    const Posterior open = posterior(bench, of_all, jobs);
    if (!take_intervals(open, *fit)) others.push_back(fit);
    if (fit == &d.base.fit) better = open.better;
  }
  widen_by_score(bench, others, jobs);
  return better;
}

// `compare` goes on from there (open_numbers() of posterior.hpp), so that it tells other errors of the same base.
std::string other_base(const ModelFit& base, const Values& better) {
  std::vector<std::string> here, there;
  for (std::size_t i = 0; i < better.size(); ++i) {
    here.push_back(fmt::format("{} = {:.4g}", base.model.free[i].name, base.x[i]));
    there.push_back(fmt::format("{:.4g}", better[i]));
  }
  return fmt::format(
      "the base is that of the least error, with {}; draws, which allow for what the floor's noise and friction do in "
      "each test, "
      "suit the tests better at {}, from where `compare` goes on: its errors of the base are others",
      fmt::join(here, ", "), fmt::join(there, ", "));
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

// One factor of friction or force of the law, of one variable, drawn over where friction was recovered. first: of its numbers.
Json part_json(const LawForm& form, const ModelFit& fit, std::size_t first, const Json& recovered) {
  Json json = {{"variable", form.variable},
               {"friction", text_or_null(form.friction())},
               {"force", text_or_null(form.force)},
               {"band", nullptr}};
  for (const Json& table : recovered["tables"]) {
    Values seen, places;
    for (const Json& centre : table["centre"])
      if (centre.is_number()) seen.push_back(centre);
    if (table["variable"] != form.variable || seen.empty()) continue;
    const double low = seen.front(), high = seen.back();
    for (int i = 0; i <= 40; ++i) places.push_back(low + (high - low) * i / 40);
    const auto law = [&](const Values& x) {
      const auto own = x.begin() + static_cast<long>(first);
      return law_at(form, places, fit.model.mu_k.of(x), {own, own + static_cast<long>(fitted_numbers(form.effect))});
    };
    const LawBand band = law_band(fit, law);
    json["band"] = {{"at", places}, {"law", band.law}, {"lower", band.lower}, {"upper", band.upper}};
  }
  return json;
}

// The law, its numbers, and the entry with which `add` takes it into the study.
Json proposal_json(const Bench& bench, const Diagnosis& d, const Json& recovered) {
  if (!d.proposal) return nullptr;
  const Candidate& c = *d.proposal;
  const auto& all = law_forms();
  std::vector<LawForm> parts;
  std::size_t own = 0;
  for (const std::string& name : c.effects) {
    parts.push_back(*std::find_if(all.begin(), all.end(), [&](const LawForm& f) { return f.effect.name == name; }));
    own += fitted_numbers(parts.back().effect);
  }
  const LawForm law = together(parts);
  std::size_t first = c.fit.x.size() - own;
  Json json = candidate_json(bench, c);
  json["variable"] = law.variable;
  json["friction"] = text_or_null(law.friction());
  json["force"] = text_or_null(law.force);
  json["entry"] = entry_of(law, Values(c.fit.x.begin() + static_cast<long>(first), c.fit.x.end()));
  json["parts"] = Json::array();
  for (const LawForm& part : parts) {
    json["parts"].push_back(part_json(part, c.fit, first, recovered));
    first += fitted_numbers(part.effect);
  }
  json["band"] = parts.size() == 1 ? json["parts"][0]["band"] : Json(nullptr);
  return json;
}

// The key, of the document or of each candidate, by which the verdict was reached.
const char* decided_by(const Bench& bench, const Diagnosis& d) {
  const bool faults = std::any_of(d.candidates.begin(), d.candidates.end(), [](const Candidate& c) { return c.rival; });
  if (d.reason == Reason::data && !faults) return "findings";
  if (only_friction_scatters(d)) return "friction_scatter";
  if (!d.chances.empty()) return "tests_of_chance";
  return measurement::kind_of_set(bench) == Kind::history ? "chi_square_left_out" : "score_left_out_above_best";
}

// The diagnosis that lies in the folder; null: none. Throws Error (Exit::usage) where it is that of something else.
Json finished(const std::filesystem::path& folder, const std::string& fingerprint) {
  const std::filesystem::path file = folder / "diagnosis.json";
  if (!is_there(file)) return nullptr;
  Json found = Json::parse(read_text(file), nullptr, false);
  if (found.is_object() && found.value("fingerprint", "") == fingerprint) return found;
  throw Error(
      fmt::format("{} is of another study or program (there is nothing to go on with): name another folder, or "
                  "start again with --overwrite",
                  file.string()));
}

}  // namespace

Json diagnose(const parallel::Communicator& world, const ValidationRun& run, RunFolder& folder) {
  const auto p = prepare(world, run, 32);
  const Bench& bench = *p->bench;
  const std::string fingerprint = fingerprint_of_answers(content(*p));
  if (Json done = finished(folder.path(), fingerprint); !done.is_null()) return done;
  const auto kept = std::make_shared<KeptAnswers>(world, blocks_path(folder.path()), fingerprint);
  folder.begin();
  const Jobs jobs = spread_jobs(
      world, run.quiet, [&] { folder.leave(); }, kept);
  std::vector<const dynamics::Effect*> catalogue;
  for (const auto& effect : effects::all()) catalogue.push_back(&effect);
  DiagnosisOptions options;
  options.start = known_values(p->validation);
  if (options.start.size() != p->model.free.size()) options.start.clear();

  bool moved = measurement::kind_of_set(bench) != Kind::history;
  for (const Test& test : p->data.tests)
    for (const Channel channel : {Channel::slip, Channel::rotation})
      for (const double value : history(test, channel)) moved |= std::abs(value) > 8 * bench.noise(channel);
  if (!moved)
    throw Error(fmt::format("{}: no test shows motion above the noise (there is nothing to diagnose): shake harder",
                            p->measurements),
                Exit::data);

  Diagnosis d = measurement::diagnose(bench, p->model, catalogue, options, jobs);
  std::vector<const dynamics::Effect*> forms;
  for (const LawForm& form : law_forms()) forms.push_back(&form.effect);
  propose_law(bench, p->model, forms, options, jobs, d);
  const Values better = state_intervals(bench, d, jobs);
  std::vector<std::string> findings = d.quality.findings;
  if (!better.empty()) findings.push_back(other_base(d.base.fit, better));
  if (d.best && !d.effects.empty())
    for (std::string& open : undetermined(d.candidates[*d.best].fit)) findings.push_back(std::move(open));
  Json json = {{"format", "freestand-diagnosis/2"},
               {"study", run.study},
               {"measurements", p->measurements},
               {"fingerprint", fingerprint},
               {"name", p->data.name},
               {"error_unit", error_unit(bench)},
               {"verdict", name(d.verdict)},
               {"reason", d.reason == Reason::none ? Json(nullptr) : Json(name(d.reason))},
               {"decided_by", decided_by(bench, d)},
               {"effects", d.effects},
               {"best", d.best ? Json(label(d.candidates[*d.best])) : Json(nullptr)},
               {"sentences", d.sentences},
               {"findings", findings},
               {"noise_floor", number_or_null(noise_floor(bench, d))},
               {"base", candidate_json(bench, d.base)}};
  json["tests_of_chance"] = Json::array();
  for (const Chance& c : d.chances)
    json["tests_of_chance"].push_back({{"question", c.question},
                                       {"about", c.about},
                                       {"p", c.p},
                                       {"level", c.level()},
                                       {"observed", c.observed},
                                       {"chance_reaches", c.usual},
                                       {"simulations", c.simulations},
                                       {"tries", c.tries},
                                       {"told_apart", number_or_null(c.told_apart)}});
  json["sensors"] = Json::object();
  for (const Channel channel : {Channel::slip, Channel::rotation}) {
    const Sensor& s = bench.sensor(channel);
    const auto& powers = s.slow_powers;
    const std::size_t twentieth = powers.size() / 20;
    if (bench.noise(channel) > 0)
      json["sensors"][name(channel)] = {
          {"white", s.white},
          {"coloured", s.coloured},
          {"correlation_s", s.correlation_s},
          {"drift_per_s", s.drift_per_s},
          {"size_error_ln", s.size_error},
          {"slow_power_90",
           powers.empty() ? Json(nullptr) : Json{powers[twentieth], powers.end()[-1 - static_cast<long>(twentieth)]}},
          {"quiet_s", s.quiet_s}};
  }
  json["friction_scatter"] = d.own_friction ? Json{{"standard_deviation_ln", d.own_friction->scatter},
                                                   {"factors", d.own_friction->of_tests},
                                                   {"chi_square_fit", number_or_null(d.own_friction->misfit)}}
                                            : Json(nullptr);
  if (only_friction_scatters(d)) {
    const auto odd = measurement::test_of_other_friction(bench, *d.own_friction);
    json["friction_scatter"]["odd_test"] = odd ? Json(odd->id) : Json(nullptr);
  }
  if (d.own_friction)
    json["friction_scatter"]["beside"] = d.friction_of_base ? Json(nullptr)
                                                            : Json(d.proposal ? "the proposed law, and allowed for"
                                                                              : "the best effect, and allowed for");
  json["enough_if"] = d.enough_if.empty() ? Json(nullptr) : Json(d.enough_if);
  json["candidates"] = Json::array();
  for (const Candidate& c : d.candidates) json["candidates"].push_back(candidate_json(bench, c));
  json["recovered_force"] = recovered_json(bench, d,
                                           d.proposal ? *d.proposal
                                           : d.best   ? d.candidates[*d.best]
                                                      : d.base);
  json["proposed_law"] = proposal_json(bench, d, json["recovered_force"]);
  json["suggested_motion"] = d.verdict == Verdict::ambiguous ? suggestion_json(bench, d, jobs) : Json(nullptr);
  add_provenance(json, world, run);
  return json;
}

}  // namespace freestand::study
