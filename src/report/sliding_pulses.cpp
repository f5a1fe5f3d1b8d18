// A block that slides under a pulse: demand over intensity is one curve for each type of pulse, whatever period, amplitude
// and friction; Newmark's rectangular pulse has it in closed form, U w^2/a_p = 2 pi^2 (a_p/(mu g) - 1) [KM05 5.10].
#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "report/peaks.hpp"
#include "report/table_pulses.hpp"

namespace freestand::report {
namespace {

constexpr double im_most = 7, im_step = 0.1;

double slid(TablePulses& pulses, const std::string& type, double im, double mu, double period_s) {
  Specimen specimen{Block::rectangular(1, 1, 1), {mu, mu}, {}};
  specimen.model = Model::slide;
  const double peak_g = mu * (1 + im);
  return demand(respond(specimen, pulses.shaking_g(type, period_s, peak_g)).peak_slip_m, period_s, peak_g);
}

Item sliding_pulses(const Sources&) {
  TablePulses pulses;
  Item item;
  Sheet sheet{"sliding_pulses", {"im", "delta"}, {}};
  double off_newmark = 0, off_similar = 0;
  for (const char* type : {"A", "B", "C1", "C2", "rectangular"})
    for (int i = 1; im_step * i < im_most + 1e-9; ++i) {
      const double im = im_step * i, delta = slid(pulses, type, im, 0.2, 0.6);
      sheet.rows.push_back({std::string(type), im, delta});
      off_similar = std::max(off_similar, std::abs(slid(pulses, type, im, 0.45, 1.7) / delta - 1));
      if (type == std::string("rectangular"))
        off_newmark = std::max(off_newmark, std::abs(delta / (2 * pi * pi * im) - 1));
    }
  constexpr double small = 1e-9;  // of the integration
  const auto text = [](double off) {
    return off < small ? std::string("to 1e-9 of it") : "off by a share of " + std::to_string(off);
  };
  item.statements = {
      {"sliding_pulses.newmark", "slip under a rectangular pulse is 2π² (a_p/(μ g) − 1) a_p/ω² [KM05 5.10]",
       text(off_newmark), "closed form", off_newmark < small ? Verdict::agrees : Verdict::disagrees, ""},
      {"sliding_pulses.similar", "friction, period and amplitude matter by IM alone [KM05 5.6, 5.7]", text(off_similar),
       "one curve for each type", off_similar < small ? Verdict::agrees : Verdict::disagrees, ""}};
  for (const char* type : {"A", "B", "C1", "C2"})
    item.numbers.push_back({.id = std::string("sliding_pulses.") + type,
                            .what = std::string("Δ of a ") + type + " pulse at IM = 2",
                            .ours = slid(pulses, type, 2, 0.2, 0.6)});
  item.sheets = {sheet};
  return item;
}

const RegisteredItem sliding_pulses_here{{.name = "sliding_pulses",
                                          .order = 502,
                                          .chapter = 5,
                                          .place = "Figures 5.1 to 5.8, [KM05 5.6-5.10]",
                                          .what = "dimensionless slip under each type of pulse",
                                          .compute = sliding_pulses}};

}  // namespace
}  // namespace freestand::report
