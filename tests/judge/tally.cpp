#include "judge/tally.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace freestand::test {
namespace {

constexpr std::pair<unsigned, const char*> deeds[] = {
    {slid, "slid"}, {rocked, "rocked"}, {slide_rocked, "slide_rocked"}, {flew, "flew"}};

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
    for (const auto& [bit, deed] : deeds) text += fmt::format("{:>13}", visits_.at(effect).at(deed));
    text += '\n';
  }
  return text + fmt::format("{} cases, {:.0f} % of their time compared, {} on an edge, {} disagree\n", total_.cases,
                            100.0 * static_cast<double>(total_.compared) / static_cast<double>(std::max<std::size_t>(1, total_.samples)),
                            total_.edges, total_.disagreements);
}

std::vector<std::string> Tally::empty_cells() const {
  std::vector<std::string> empty;
  for (const std::string& effect : catalogue_effects())
    for (const auto& [bit, deed] : deeds) {
      const auto row = visits_.find(effect);
      if (row == visits_.end() || row->second.at(deed) == 0) empty.push_back(effect + ": " + deed);
    }
  return empty;
}

}  // namespace freestand::test
