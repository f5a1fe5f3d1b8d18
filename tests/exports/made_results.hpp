// Results made by hand: five bins of PGA, a demand with two capacities, and overturning.
#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <freestand/error.hpp>
#include <fstream>
#include <string>

#include "exports/certificate.hpp"
#include "exports/exporter.hpp"
#include "exports/select.hpp"

namespace freestand::exports::test {

inline constexpr double bins[] = {0.1, 0.3, 0.6, 1.0, 1.6};

inline double phi(double z) { return 0.5 * (1 + std::erf(z / std::sqrt(2.0))); }

// P(slip > capacity) of one bin, by the three parts.
inline double three_parts(double over, double still, double lambda, double omega, double capacity) {
  return over + (1 - over) * (1 - still) * (1 - phi((std::log(capacity) - lambda) / omega));
}

inline fragility::FragilityFunction function(double median, double dispersion, bool adequate) {
  fragility::FragilityFunction f;
  f.median = median;
  f.dispersion = dispersion;
  f.median_se = 0.01 * median;
  f.dispersion_se = 0.02;
  f.im_least = 0.05;
  f.im_most = 1.9;
  f.off_by = adequate ? 0.03 : 0.12;
  f.misfit_p = adequate ? 0.4 : 0.01;
  f.adequate = adequate;
  return f;
}

inline void set_surface(fragility::EdpResult& edp, std::size_t at, double p) {
  edp.surface.probability[at] = edp.surface.empirical[at] = p;
  edp.surface.lower[at] = edp.surface.empirical_lower[at] = p - 0.02;
  edp.surface.upper[at] = edp.surface.empirical_upper[at] = p + 0.02;
}

inline fragility::EdpResult demand(const std::string& name, const std::string& unit, std::vector<double> capacities) {
  fragility::EdpResult edp;
  edp.name = name;
  edp.unit = unit;
  edp.binary = capacities.empty();
  edp.capacity = edp.binary ? std::vector<double>{0.5} : capacities;
  edp.bins.resize(std::size(bins));
  const std::size_t size = edp.bins.size() * edp.capacity.size();
  for (auto* values : {&edp.surface.probability, &edp.surface.lower, &edp.surface.upper, &edp.surface.empirical,
                       &edp.surface.empirical_lower, &edp.surface.empirical_upper})
    values->assign(size, 0);
  return edp;
}

// slip over 0.05 and 0.2 m by three parts; overturned by its share.
inline fragility::Result made_results(bool adequate = true) {
  const double over[] = {0, 0, 0.1, 0.3, 0.6}, still[] = {1, 0.5, 0.1, 0, 0};
  fragility::Result result;
  result.im_name = "pga_g";
  result.im_unit = "g";
  result.im.assign(std::begin(bins), std::end(bins));
  result.im_edge = {0, 0.2, 0.45, 0.8, 1.3, 2};
  result.edps = {demand("peak_slip_m", "m", {0.05, 0.2}), demand("overturned", "1", {})};
  for (std::size_t b = 0; b < std::size(bins); ++b) {
    fragility::BinFit& fit = result.edps[0].bins[b];
    fit = {};
    fit.n = 1000;
    fit.p_over = over[b];
    fit.p_never = still[b];
    fit.n_moved = b == 0 ? 0 : 500;
    fit.status = b == 0 ? fragility::BinStatus::counts_only : fragility::BinStatus::fitted;
    if (b > 0) {
      fit.lambda = std::log(0.1 * bins[b]);
      fit.omega = 0.5;
    }
    for (std::size_t k = 0; k < 2; ++k)
      set_surface(result.edps[0], 2 * b + k,
                  b == 0 ? 0 : three_parts(over[b], still[b], fit.lambda, fit.omega, result.edps[0].capacity[k]));
    result.edps[1].bins[b].n = 1000;
    result.edps[1].bins[b].status = fragility::BinStatus::counts_only;
    set_surface(result.edps[1], b, over[b]);
  }
  result.edps[0].functions = {function(0.5, 0.4, adequate), function(0.9, 0.4, adequate)};
  result.edps[1].functions = {function(1.4, 0.4, adequate)};
  return result;
}

// The same without fitted curves, which lend counted ones their bend: straight lines from bin to bin.
inline fragility::Result without_curves(fragility::Result result = made_results(false)) {
  for (fragility::EdpResult& edp : result.edps)
    for (fragility::FragilityFunction& f : edp.functions) f.median = f.dispersion = std::nan("");
  return result;
}

inline const Intensity pga{"pga_g", "g"};

inline Request request(std::vector<std::string> states = {}) {
  Request wanted;
  wanted.states = std::move(states);
  wanted.id = "fridge";
  wanted.description = "a refrigerator <of a laboratory> & more";
  return wanted;
}

inline Model model(const std::string& format, const Request& wanted = request(),
                   const fragility::Result& result = made_results(), const Intensity& im = pga) {
  return select(result, im, wanted, find(format));
}

// A folder that goes when the test does.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "freestand-exports-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  // All files of a format; the first one's path.
  std::filesystem::path write(const std::vector<File>& files) const {
    for (const File& file : files) write(file.name, file.text);
    return path_ / files.front().name;
  }

 private:
  std::filesystem::path path_;
};

// The text of the Error that `act` throws.
template <class Act>
std::string error_of(Act act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Replaces the one place of `old`.
inline std::string edited(std::string text, const std::string& old, const std::string& next) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old << " in\n" << text;
  return at == std::string::npos ? text : text.replace(at, old.size(), next);
}

}  // namespace freestand::exports::test
