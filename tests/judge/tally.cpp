#include "judge/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace freestand::test {
namespace {

constexpr std::pair<unsigned, const char*> deeds[] = {
    {slid, "slid"}, {rocked, "rocked"}, {slide_rocked, "slide_rocked"}, {flew, "flew"}};
constexpr std::pair<unsigned, const char*> wall_deeds[] = {{struck_by_face, "struck by the face"},
                                                           {struck_by_lower_edge, "struck by the lower edge"},
                                                           {struck_by_upper_edge, "struck by the upper edge"},
                                                           {struck_in_flight, "struck in flight"},
                                                           {leaned, "leaned on"}};

void count(Tally::Count& c, const Judgement& judgement) {
  ++c.cases;
  c.edges += judgement.finding == Finding::on_an_edge;
  c.disagreements += judgement.finding == Finding::disagrees;
  c.compared += judgement.compared;
  c.samples += judgement.samples;
}

}  // namespace

void Tally::add(const JudgedCase& c, const Judgement& judgement) {
  count(total_, judgement);
  std::set<std::string> effects{"any"};
  for (const TruthEffect& effect : c.truth.effects) effects.insert(effect.name);
  for (const auto& [bit, deed] : wall_deeds) visits_["wall_impact"][deed] += (judgement.deeds & bit) != 0;
  visits_["chain"]["broken"] += (judgement.deeds & broke_the_chain) != 0;
  for (const std::string& effect : effects) {
    count(settings_[effect][c.recipe.setting], judgement);
    for (const auto& [bit, deed] : deeds) visits_[effect][deed] += (judgement.deeds & bit) != 0;
  }
}

std::string Tally::table() const {
  std::string text = fmt::format("{:<22}", "cases (disagree)");
  for (int i = 0; i < setting_count; ++i) text += fmt::format("{:>13}", name(static_cast<Setting>(i)));
  text += "  | cases that";
  for (const auto& [bit, deed] : deeds) text += fmt::format("{:>13}", deed);
  text += '\n';
  for (const auto& [effect, row] : settings_) {
    text += fmt::format("{:<22}", effect);
    for (int i = 0; i < setting_count; ++i) {
      const auto found = row.find(static_cast<Setting>(i));
      const Count cell = found == row.end() ? Count{} : found->second;
      text += fmt::format("{:>13}", cell.disagreements ? fmt::format("{} ({})", cell.cases, cell.disagreements)
                                                       : std::to_string(cell.cases));
    }
    text += "  |           ";
    for (const auto& [bit, deed] : deeds) text += fmt::format("{:>13}", visits(effect, deed));
    text += '\n';
  }
  text += "walls that were";
  for (const auto& [bit, deed] : wall_deeds) text += fmt::format(" {}: {};", deed, visits("wall_impact", deed));
  text += fmt::format(" chains broken: {}\n", visits("chain", "broken"));
  return text + fmt::format("{} cases, {:.0f} % of their time compared, {} on an edge, {} disagree\n", total_.cases,
                            100.0 * static_cast<double>(total_.compared) /
                                static_cast<double>(std::max<std::size_t>(1, total_.samples)),
                            total_.edges, total_.disagreements);
}

int Tally::visits(const std::string& effect, const std::string& deed) const {
  const auto row = visits_.find(effect);
  if (row == visits_.end()) return 0;
  const auto cell = row->second.find(deed);
  return cell == row->second.end() ? 0 : cell->second;
}

std::vector<std::string> Tally::empty_cells(Family family) const {
  std::vector<std::string> empty;
  const auto look = [&](const std::string& effect, const std::string& deed) {
    if (visits(effect, deed) == 0) empty.push_back(effect + ": " + deed);
  };
  if (family == Family::bouc_wen) {
    for (const Recipe& recipe : recipes(family))
      for (const std::string& effect : recipe.effects)
        if (recipe.effects.size() == 1) look(effect, "slid");
    look("chain", "broken");
    return empty;
  }
  for (const std::string& effect : judged_effects())
    if (!outside_catalogue(effect))
      for (const auto& [bit, deed] : deeds) look(effect, deed);
  for (const auto& [bit, deed] : wall_deeds) look("wall_impact", deed);
  look("chain", "broken");
  return empty;
}

}  // namespace freestand::test
