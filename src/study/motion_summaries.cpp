#include "study/motion_summaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <freestand/error.hpp>
#include <limits>
#include <string_view>

#include "intensity/intensity.hpp"

namespace freestand::study {
namespace {

// Numbers of the types in the file: none, and those of a record's pulse.
const std::vector<std::string>& pulse_types() {
  static const std::vector<std::string> types = [] {
    std::vector<std::string> all{""};
    all.insert(all.end(), motion::pulse_types().begin(), motion::pulse_types().end());
    return all;
  }();
  return types;
}

const std::vector<Column>& columns() {
  static const std::vector<Column> columns = {
      {"pga_mps2", "m/s2", "peak acceleration at scale 1"},
      {"pgv_mps", "m/s", "peak velocity at scale 1"},
      {"pgd_m", "m", "peak displacement at scale 1"},
      {"housner_m", "m", "Housner's intensity at scale 1; nan for pulses, whose period each sample has for itself"},
      {"pulse_type", "1", "pulse in the record: 0 none, 1 A, 2 B, 3 C1, 4 C2; -1: the motion is a pulse itself",
       ColumnKind::integer},
      {"pulse_period_s", "s", "period T_p of the pulse in the record; of a pulse itself 1"},
      {"pulse_velocity_mps", "m/s", "amplitude v_p of the pulse in the record; negative: mirrored"},
      {"pulse_start_s", "s", "when the pulse in the record starts"},
      {"pulse_explained", "1", "share of the integral of velocity^2 that the pulse explains"},
      {"pulse_given", "1",
       "of that pulse the study or its table of records gives: 0 nothing, 1 the type, 2 the period, 3 both",
       ColumnKind::integer},
      {"arias_mps", "m/s", "Arias intensity at scale 1"},
      {"cav_mps", "m/s", "cumulative absolute velocity at scale 1"},
  };
  return columns;
}

std::vector<double> row_of(const motion::MotionSummary& s) {
  const auto type = std::find(pulse_types().begin(), pulse_types().end(), s.pulse.type) - pulse_types().begin();
  return {s.peaks.pga_mps2,
          s.peaks.pgv_mps,
          s.peaks.pgd_m,
          s.housner_m,
          s.is_pulse ? -1.0 : static_cast<double>(type),
          s.pulse.period_s,
          s.pulse.velocity_mps,
          s.pulse.start_s,
          s.pulse.explained,
          (s.pulse.type_given ? 1.0 : 0.0) + (s.pulse.period_given ? 2.0 : 0.0),
          s.arias_mps,
          s.cav_mps};
}

// Of a record, from its row and its ordinates.
motion::MotionSummary record_summary(const double* row, const std::vector<double>& period_s, const double* sa_mps2) {
  motion::MotionSummary s;
  s.peaks = {row[0], row[1], row[2]};
  s.housner_m = row[3];
  const bool known = row[4] >= 0 && row[4] < static_cast<double>(pulse_types().size());
  s.pulse = {known ? pulse_types()[static_cast<std::size_t>(row[4])] : "",
             row[5],
             row[6],
             row[7],
             row[8],
             row[9] == 1 || row[9] == 3,
             row[9] == 2 || row[9] == 3};
  s.arias_mps = row[10];
  s.cav_mps = row[11];
  s.spectrum = {period_s, std::vector<double>(sa_mps2, sa_mps2 + period_s.size())};
  return s;
}

// Columns of what tables of records give.
constexpr std::string_view given_prefix = "record_";

std::vector<std::pair<std::string, double>> given_of(const MotionSet& motions, std::size_t i) {
  std::vector<std::pair<std::string, double>> given;
  for (std::size_t n = 0; n < motions.numbers.size(); ++n)
    given.emplace_back(motions.numbers[n].name, (*motions.entries)[i].numbers[n]);
  return given;
}

// Of each column in the file. Files of earlier versions lack the last three.
constexpr std::size_t absent = std::numeric_limits<std::size_t>::max();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
std::vector<std::size_t> places(const std::vector<Column>& in_file) {
  constexpr std::size_t always = 9;
  std::vector<std::size_t> found;
  for (const Column& column : columns()) {
    const bool there =
        std::any_of(in_file.begin(), in_file.end(), [&](const Column& c) { return c.name == column.name; });
    found.push_back(there || found.size() < always ? column_index(in_file, column.name) : absent);
  }
  return found;
}

motion::MotionSummary summary_of(const MotionSet& motions, std::size_t i, const std::vector<double>& sa_period_s) {
  if (motions.is_pulse(i)) return motion::summarize(motion::find_pulse(motions.motion(i).name));
  motion::MotionSummary summary = motion::summarize(
      motions.motion(i), {.pulse = true, .known_pulse = (*motions.entries)[i].known_pulse, .sa_period_s = sa_period_s});
  summary.given = given_of(motions, i);
  return summary;
}

std::vector<double> periods_of(const Study& study) {
  std::vector<double> periods = motion::kept_periods_s();
  if (study.fragility.im.period_s) periods.push_back(*study.fragility.im.period_s);
  std::sort(periods.begin(), periods.end());
  periods.erase(std::unique(periods.begin(), periods.end()), periods.end());
  return periods;
}

// Each floor gets the ground's, which stands among them.
void give_grounds(MotionSummaries& summaries, const std::vector<std::size_t>& ground) {
  const MotionSummaries own = summaries;
  for (std::size_t i = 0; i < summaries.size(); ++i)
    if (ground[i] != i) summaries[i].ground = std::make_shared<const motion::MotionSummary>(own[ground[i]]);
}

// Column of sweeps in a building: of each motion the one of the ground.
constexpr const char* ground_column = "ground";

std::vector<std::size_t> grounds(const MotionSet& motions) {
  std::vector<std::size_t> ground;
  for (std::size_t i = 0; i < motions.size(); ++i) ground.push_back(motions.ground(i));
  return ground;
}

}  // namespace

MotionSummaries summarize(const MotionSet& motions, const std::vector<double>& sa_period_s) {
  MotionSummaries summaries;
  for (std::size_t i = 0; i < motions.size(); ++i) summaries.push_back(summary_of(motions, i, sa_period_s));
  give_grounds(summaries, grounds(motions));
  return summaries;
}

MotionSummaries summarize_together(const parallel::Communicator& world, const Study& study, const MotionSet& motions,
                                   parallel::StepDisplay* display) {
  const std::vector<double> periods = periods_of(study);
  const std::size_t width = columns().size() + periods.size();
  parallel::Words words(motions.size() * width, 0);
  for (std::size_t i = static_cast<std::size_t>(world.rank()); i < motions.size();
       i += static_cast<std::size_t>(world.size())) {
    if (motions.is_pulse(i)) continue;
    const motion::MotionSummary summary = summary_of(motions, i, periods);
    std::vector<double> values = row_of(summary);
    values.insert(values.end(), summary.spectrum.sa_mps2().begin(), summary.spectrum.sa_mps2().end());
    std::transform(values.begin(), values.end(), words.begin() + static_cast<std::ptrdiff_t>(i * width),
                   [](double x) { return std::bit_cast<std::int64_t>(x); });
    if (display) display->show("spectra of the motions", i + 1, motions.size());
  }
  world.sum_in_place(words);  // each is of one rank, 0 on the others
  std::vector<double> values(words.size());
  std::transform(words.begin(), words.end(), values.begin(), [](std::int64_t x) { return std::bit_cast<double>(x); });
  MotionSummaries summaries;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double* row = values.data() + i * width;
    summaries.push_back(motions.is_pulse(i) ? summary_of(motions, i, {})
                                            : record_summary(row, periods, row + columns().size()));
    if (!motions.is_pulse(i)) summaries.back().given = given_of(motions, i);
  }
  give_grounds(summaries, grounds(motions));
  return summaries;
}

nlohmann::ordered_json record_pulses_json(const MotionSummaries& summaries) {
  int records = 0, given = 0, identified = 0;
  for (const motion::MotionSummary& summary : summaries) {
    if (summary.is_pulse) continue;
    ++records;
    given += summary.pulse.period_given;
    identified += !summary.pulse.period_given && summary.pulse.period_s > 0;
  }
  return {{"records", records}, {"period_given", given}, {"period_identified", identified}};
}

io::MotionRows motion_rows(const MotionSet& motions, const MotionSummaries& summaries) {
  io::MotionRows rows{.names = motions.names(),
                      .group = motions.groups(),
                      .table = {columns(), {}},
                      .sa_period_s = motion::kept_periods_s(),
                      .sa_mps2 = {},
                      .fingerprint = motions.fingerprint()};
  for (const motion::RecordNumber& number : motions.numbers)
    rows.table.columns.push_back({std::string(given_prefix) + number.name, number.unit,
                                  intensity::find("record." + number.name).summary + "; here at scale 1"});
  const bool floors = motions.has_floors();
  if (floors) {
    rows.table.columns.push_back(
        {ground_column, "1",
         "number of the motion of the ground under the building; of a motion that is of no floor, its own",
         ColumnKind::integer});
    rows.table.columns.push_back({"storey", "1", "how many floors above the ground", ColumnKind::integer});
  }
  const auto in_plane = [&](std::size_t i) { return !motions.is_pulse(i) && !motions.motion(i).cross_mps2.empty(); };
  bool pairs = false;
  for (std::size_t i = 0; i < motions.size(); ++i) pairs = pairs || in_plane(i);
  if (pairs)
    rows.table.columns.push_back(
        {"cross", "1",
         "1: the floor shakes in both horizontal directions, all else here is of the first; 0: along a line",
         ColumnKind::integer});
  for (const motion::MotionSummary& s : summaries)
    if (!s.is_pulse) rows.sa_period_s = s.spectrum.period_s();
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const motion::MotionSummary& s = summaries[i];
    std::vector<double> values = row_of(s);
    for (const motion::RecordNumber& number : motions.numbers) values.push_back(s.given_value(number.name));
    if (floors)
      values.insert(values.end(),
                    {static_cast<double>(motions.ground(i)), static_cast<double>((*motions.entries)[i].storey)});
    if (pairs) values.push_back(in_plane(i));
    rows.table.values.insert(rows.table.values.end(), values.begin(), values.end());
    for (const double period : rows.sa_period_s)
      rows.sa_mps2.push_back(motion::spectral_acceleration_mps2(s, period, 1));
  }
  return rows;
}

std::vector<std::size_t> grounds(const io::MotionRows& rows) {
  std::vector<std::size_t> ground;
  const std::vector<Column>& columns = rows.table.columns;
  const auto found =
      std::find_if(columns.begin(), columns.end(), [](const Column& c) { return c.name == ground_column; });
  for (std::size_t i = 0; i < rows.names.size(); ++i) {
    const double number = found == columns.end() ? static_cast<double>(i)
                                                 : rows.table.at(i, static_cast<std::size_t>(found - columns.begin()));
    if (!(number >= 0 && number < static_cast<double>(rows.names.size())))
      throw Error(fmt::format("motion {} stands on the ground of motion {} (there are {}): the samples are damaged", i,
                              number, rows.names.size()),
                  Exit::data);
    ground.push_back(static_cast<std::size_t>(number));
  }
  return ground;
}

MotionSummaries motion_summaries(const io::MotionRows& rows) {
  const std::vector<std::size_t> place = places(rows.table.columns);
  MotionSummaries summaries;
  for (std::size_t i = 0; i < rows.names.size(); ++i) {
    if (rows.group[i] < 0) {
      summaries.push_back(motion::summarize(motion::find_pulse(rows.names[i])));
      continue;
    }
    std::vector<double> row;
    for (const std::size_t column : place) row.push_back(column == absent ? nothing : rows.table.at(i, column));
    summaries.push_back(
        record_summary(row.data(), rows.sa_period_s, rows.sa_mps2.data() + i * rows.sa_period_s.size()));
    for (std::size_t column = 0; column < rows.table.columns.size(); ++column)
      if (const std::string& name = rows.table.columns[column].name; name.starts_with(given_prefix))
        summaries.back().given.emplace_back(name.substr(given_prefix.size()), rows.table.at(i, column));
  }
  give_grounds(summaries, grounds(rows));
  return summaries;
}

}  // namespace freestand::study
