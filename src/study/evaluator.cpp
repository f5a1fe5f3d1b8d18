#include "study/evaluator.hpp"

#include <limits>
#include <utility>

#include "base/passed_over.hpp"
#include "base/units.hpp"
#include "edp/edp.hpp"

namespace freestand::study {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// A sample that overturned, or failed, has no demand.
bool has_value(const edp::Edp& edp, Outcome outcome) {
  if (outcome == Outcome::overturned) return !edp.censored;
  return outcome == Outcome::at_rest || outcome == Outcome::moved;
}

}  // namespace

struct Evaluator::Parts {
  Realiser realise;
  Settings settings;
  MotionSummaries summaries;
  std::vector<Column> columns;

  void append(const Realisation& drawn, Response response, std::vector<double>& values) const {
    for (double* slip : {&response.peak_slip_m, &response.peak_slip_right_m, &response.peak_slip_left_m,
                         &response.residual_slip_m, &response.residual_cross_slip_m, &response.slid_path_m})
      *slip *= drawn.slip_factor;
    values.insert(values.end(), drawn.draws.begin(), drawn.draws.end());
    const edp::Input input{response, drawn.specimen, drawn.pta_g * standard_gravity_mps2,
                           motion::pulse_frequency_radps(summaries[drawn.motion], drawn.shaking.stretch)};
    for (const edp::Edp& edp : edp::all())
      values.push_back(has_value(edp, response.outcome) ? edp.value(input) : nothing);
    values.push_back(static_cast<double>(response.outcome));
    values.push_back(response.events);
  }

  void append_passed_over(const Realisation& drawn, std::vector<double>& values) const {
    values.insert(values.end(), drawn.draws.begin(), drawn.draws.end());
    values.insert(values.end(), edp::all().size(), nothing);
    values.push_back(static_cast<double>(passed_over));
    values.push_back(0);
  }
};

Evaluator::Evaluator(const Study& study, MotionSet motions) : Evaluator(study, motions, summarize(motions, {})) {}

Evaluator::Evaluator(const Study& study, MotionSet motions, MotionSummaries summaries) {
  Realiser realiser(study, std::move(motions));

  std::vector<Column> columns = realiser.draw_columns();
  for (const edp::Edp& edp : edp::all()) columns.push_back({"edp_" + edp.name, edp.unit, edp.summary});
  columns.push_back({"outcome", "1", "how the sample ended", ColumnKind::integer});
  columns.push_back({"events", "1", "changes of mode and impacts", ColumnKind::integer});
  parts_ = std::make_shared<const Parts>(
      Parts{std::move(realiser), integration_settings(study), std::move(summaries), std::move(columns)});
}

const std::vector<Column>& Evaluator::columns() const { return parts_->columns; }

const MotionSet& Evaluator::motions() const { return parts_->realise.motions(); }

const MotionSummaries& Evaluator::summaries() const { return parts_->summaries; }

Table Evaluator::draws(std::size_t count) const {
  Table table{parts_->realise.draw_columns(), {}};
  for (std::uint64_t sample = 0; sample < count; ++sample) {
    const Realisation drawn = parts_->realise(sample);
    table.values.insert(table.values.end(), drawn.draws.begin(), drawn.draws.end());
  }
  return table;
}

Evaluator Evaluator::drawing(const Study& study) const {
  Parts parts = *parts_;
  parts.realise = Realiser(study, motions());
  return Evaluator(std::make_shared<const Parts>(std::move(parts)));
}

Outcome Evaluator::append(std::uint64_t sample, std::vector<double>& values) const {
  return append(sample, 1, values).front();
}

Outcome Evaluator::append_alone(std::uint64_t sample, std::vector<double>& values) const {
  const Realisation drawn = parts_->realise(sample);
  const Response response = respond(drawn.specimen, drawn.shaking, parts_->settings);
  parts_->append(drawn, response, values);
  return response.outcome;
}

std::vector<Outcome> Evaluator::append(std::uint64_t first, std::size_t count, std::vector<double>& values,
                                       const Taken& taken) const {
  std::vector<Realisation> drawn;
  for (std::size_t i = 0; i < count; ++i) drawn.push_back(parts_->realise(first + i));
  std::vector<bool> takes(count, true);
  if (taken) {
    Table draws{parts_->realise.draw_columns(), {}};
    for (const Realisation& one : drawn) draws.values.insert(draws.values.end(), one.draws.begin(), one.draws.end());
    takes = taken(draws);
  }
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (std::size_t i = 0; i < count; ++i)
    if (takes[i]) specimens.push_back(drawn[i].specimen), shakings.push_back(drawn[i].shaking);
  std::vector<Response> responses(specimens.size());
  if (!responses.empty()) respond_batch(specimens, shakings, parts_->settings, responses);

  std::vector<Outcome> outcomes;
  auto response = responses.begin();
  for (std::size_t i = 0; i < count; ++i) {
    outcomes.push_back(takes[i] ? response->outcome : passed_over);
    if (takes[i])
      parts_->append(drawn[i], *response++, values);
    else
      parts_->append_passed_over(drawn[i], values);
  }
  return outcomes;
}

}  // namespace freestand::study
