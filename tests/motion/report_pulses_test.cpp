// The pulses of the report's records (tables 5.1 and 8.1), beside those that are identified: what explains the difference.
//
// identify_pulse takes the type and the period that explain most of the velocity over the whole record. With the report's own
// type, and the misfit counted within the pulse's own extent alone (for pulses of at least 0.6 of the peak velocity: a shorter
// stretch is always fitted better), the report's periods come out:
//
//   record                      report     whole record, fault-normal    report's type, own extent
//   Coyote Lake, Gilroy #6      C1 0.7 s   A  0.5 s   0.7 of it          0.71 s   1.0    fault-normal
//   Loma Prieta, Gavilan        A  0.4 s   A  1.1 s   2.8                0.40 s   1.0    fault-normal
//   Loma Prieta, Los Gatos      B  2.1 s   C1 3.4 s   1.6                1.9 s    0.9    fault-normal
//   Loma Prieta, Corralitos     B  0.6 s   B  0.95 s  1.6                0.53 s   0.9    component 000
//   Loma Prieta, Gilroy Hist.   B  1.5 s   A  0.5 s   0.3                1.4 s    0.95   fault-parallel
//
// So both count: the window throughout, the type where the report's is another. w_p^2, and with it delta, differs by the square:
// 8 times at Gavilan. The report names no component for the last two.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <vector>

#include "motion/fourier.hpp"
#include "motion/identify.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "motion/record.hpp"
#include "record_fixture.hpp"
#include "support/data.hpp"

namespace freestand::motion::report_pulses_test {
namespace {

struct Station {
  const char* name;
  const char* files[2];
  double azimuths[2];
  int late;                    // samples by which the second file begins later (tests/validation/table_7_1_test.cpp)
  double fault_normal, named;  // azimuths: of the fault's normal, of the component whose pulse is compared
  const char* type;
  double period_s;    // of the report
  double whole, own;  // periods over it: identified in the fault-normal component, and as the header says
};

const Station stations[] = {
    {"Gilroy #6",
     {"slammer/Coyote_Lake_1979/G06-230", "slammer/Coyote_Lake_1979/G06-320"},
     {230, 320},
     0,
     66,
     66,
     "C1",
     0.7,
     0.73,
     1.01},
    {"Gavilan",
     {"usgs_gmprocess/RSN763_LOMAP_GIL067.AT2", "usgs_gmprocess/RSN763_LOMAP_GIL337.AT2"},
     {67, 337},
     0,
     218,
     218,
     "A",
     0.4,
     2.81,
     1.01},
    {"Los Gatos",
     {"slammer/Loma_Prieta_1989/LGP-000", "slammer/Loma_Prieta_1989/LGP-090"},
     {0, 90},
     497,
     218,
     218,
     "B",
     2.1,
     1.64,
     0.89},
    {"Corralitos",
     {"peer_ngawest2_corralitos/RSN753_LOMAP_CLS000.AT2", "peer_ngawest2_corralitos/RSN753_LOMAP_CLS090.AT2"},
     {0, 90},
     0,
     218,
     0,
     "B",
     0.6,
     1.58,
     0.89},
    {"Gilroy Hist.",
     {"slammer/Loma_Prieta_1989/GOF-160", "slammer/Loma_Prieta_1989/GOF-250"},
     {160, 250},
     0,
     218,
     128,
     "B",
     1.5,
     0.32,
     0.95},
};

std::vector<double> read(const char* file) {
  const bool at2 = std::string(file).ends_with("AT2");
  return samples(
      read_record(test::records_dir() / file, at2 ? ReadOptions{} : ReadOptions{.dt_s = 0.005, .unit = "g"}));
}

FloorMotion component(const Station& station, double azimuth) {
  std::vector<double> one = read(station.files[0]), other = read(station.files[1]);
  other.insert(other.begin(), static_cast<std::size_t>(station.late), 0.0);
  const std::size_t size = std::max(one.size(), other.size());
  one.resize(size, 0.0);
  other.resize(size, 0.0);
  for (std::size_t i = 0; i < size; ++i)
    one[i] = one[i] * std::cos((azimuth - station.azimuths[0]) * std::numbers::pi / 180) +
             other[i] * std::cos((azimuth - station.azimuths[1]) * std::numbers::pi / 180);
  return piecewise_linear(station.name, 0.005, one);
}

// Of that type: the period, in steps of 2 %, at which the pulse explains the largest share of the velocity's square within its
// own extent, among pulses of at least 0.6 of the peak velocity.
double best_within_own_extent_s(const FloorMotion& motion, const std::string& type) {
  constexpr double least_share = 0.6, first_s = 0.2, last_s = 5, step_s = 0.005;
  const Pulse pulse = find_pulse(type);
  const std::vector<double> velocity = floor_history(motion, step_s).velocity_mps;
  double peak = 0, most = 0, best_s = 0;
  std::vector<double> energy{0};
  for (const double v : velocity) {
    peak = std::max(peak, std::abs(v));
    energy.push_back(energy.back() + v * v);
  }
  const RealTransform transform(2 * transform_size(velocity.size()));
  const RealTransform::Spectrum of_velocity = transform.forward(velocity);
  for (double period = first_s; period <= last_s; period *= 1.02) {
    std::vector<double> shape;
    double own = 0;
    for (double t = 0; t <= pulse.duration; t += step_s / period) {
      shape.push_back(pulse.at(t).velocity / pulse.velocity_amplitude);
      own += shape.back() * shape.back();
    }
    if (shape.size() >= velocity.size()) break;
    RealTransform::Spectrum spectrum = transform.forward(shape);
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] = of_velocity[k] * std::conj(spectrum[k]);
    const std::vector<double> x = transform.inverse(spectrum);
    for (std::size_t lag = 0; lag + shape.size() < velocity.size(); ++lag) {
      if (std::abs(x[lag]) < least_share * peak * own) continue;
      const double explained = x[lag] * x[lag] / own / (energy[lag + shape.size()] - energy[lag]);
      if (explained <= most) continue;
      most = explained;
      best_s = period;
    }
  }
  return best_s;
}

// Within two steps of 2 % what the header says; within 15 % of the report, whose periods are printed to 0.1 s (12 % of 0.4 s).
TEST(PulsesOfTheReport, ComeOutWithItsTypeWithinTheirOwnExtent) {
  FREESTAND_NEEDS_RECORDS();
  for (const Station& station : stations) {
    SCOPED_TRACE(station.name);
    const double own = best_within_own_extent_s(component(station, station.named), station.type) / station.period_s;
    EXPECT_NEAR(own, station.own, 0.04 * station.own);
    EXPECT_NEAR(own, 1, 0.15);
  }
}

TEST(PulsesOfTheReport, AreOthersOverTheWholeRecord) {
  FREESTAND_NEEDS_RECORDS();
  for (const Station& station : stations) {
    SCOPED_TRACE(station.name);
    const double whole = identify_pulse(component(station, station.fault_normal)).period_s / station.period_s;
    EXPECT_NEAR(whole, station.whole, 0.05 * station.whole);
    EXPECT_GT(std::abs(std::log(whole)), std::log(1.25));
  }
}

}  // namespace
}  // namespace freestand::motion::report_pulses_test
