#include "app/times.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "parallel/progress.hpp"

namespace freestand::app {

std::string short_duration(double seconds) {
  return seconds < 9.95 ? fmt::format("{:.1f} s", seconds) : parallel::duration_text(seconds);
}

std::string times_text(const study::SweepSummary& sweep, double fit_s, int ranks) {
  std::vector<std::string> parts;
  if (sweep.computed > 0)
    parts = {"motions and spectra " + short_duration(sweep.motions_s),
             fmt::format("sweep {} ({:.0f} samples/s)", short_duration(sweep.compute_s), sweep.samples_per_s),
             "accuracy check " + short_duration(sweep.accuracy_s), "writing " + short_duration(sweep.write_s)};
  if (fit_s > 0) parts.push_back("fit " + short_duration(fit_s));
  const bool resumed = sweep.computed + sweep.passed_over < sweep.samples;
  const std::string passed =
      sweep.passed_over > 0 ? fmt::format(" ({} passed over{})", sweep.passed_over, resumed ? " by this run" : "") : "";
  return fmt::format("{} samples{} in {} on {} {}{}{}", sweep.samples, passed, short_duration(sweep.wall_s + fit_s),
                     ranks, ranks == 1 ? "rank" : "ranks", parts.empty() ? "" : ": ", fmt::join(parts, ", "));
}

std::string warnings_text(const study::FitSummary& fit, const std::string& folder) {
  if (fit.warnings.empty()) return "";
  constexpr std::size_t most = 4;
  const std::string where = (std::filesystem::path(folder) / "summary.json").string();
  const std::size_t shown = std::min(most, fit.warnings.size()), more = fit.warnings.size() - shown;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += "warning: " + fit.warnings[i] + "\n";
  return text + (more ? fmt::format("({} more warning{} in {})\n", more, more == 1 ? "" : "s", where) : "");
}

}  // namespace freestand::app
