#include "motion/building.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/units.hpp"

namespace freestand::motion {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

template <class Given>
long given_in(const Building& building, Given given) {
  return std::count_if(building.storeys.begin(), building.storeys.end(),
                       [&](const Storey& storey) { return (storey.*given).has_value(); });
}

template <class Given>
void check_positive(const Building& building, Given given, const char* what) {
  for (std::size_t i = 0; i < building.storeys.size(); ++i)
    if (const auto& value = building.storeys[i].*given; value && !(*value > 0 && std::isfinite(*value)))
      throw Error(fmt::format("{} of storey {} is {} (it must be above zero): correct it", what, i + 1, *value));
}

void check_together(const Building& building) {
  const long all = building.floors(), stiff = given_in(building, &Storey::stiffness_npm),
             heavy = given_in(building, &Storey::mass_kg), high = given_in(building, &Storey::height_m);
  if (all == 0) throw Error("the building has no storeys (it would be the ground): give at least one");
  if (stiff != 0 && stiff != all)
    throw Error(
        fmt::format("stiffness_npm is given for {} of {} storeys (one would be guessed): give it for all of "
                    "them, or for none and period_s",
                    stiff, all));
  if (heavy != 0 && heavy != all)
    throw Error(
        fmt::format("mass_kg is given for {} of {} storeys (one would be guessed): give it for all of them, or "
                    "for none where they are alike",
                    heavy, all));
  if (stiff != 0 && heavy == 0)
    throw Error("the storeys have stiffness_npm and no mass_kg (no period follows from it): give mass_kg of each");
  if (stiff != 0 && building.period_s)
    throw Error(
        "period_s and stiffness_npm are both given (one follows from the other): leave out period_s, or the "
        "stiffnesses");
  if (stiff == 0 && !building.period_s)
    throw Error(
        "the building has neither period_s nor the stiffness_npm of its storeys (nothing says how fast it swings): "
        "give period_s, of the first mode");
  if (building.stiffness == Building::Stiffness::straight_first_mode && (stiff != 0 || high != all))
    throw Error(
        stiff != 0
            ? "stiffness: straight_first_mode and stiffness_npm are both given (the one makes the other): remove one"
            : "stiffness: straight_first_mode needs the height_m of every storey (a straight line over which height?): "
              "give it");
}

void check(const Building& building) {
  check_together(building);
  check_positive(building, &Storey::mass_kg, "mass_kg");
  check_positive(building, &Storey::height_m, "height_m");
  check_positive(building, &Storey::stiffness_npm, "stiffness_npm");
  if (building.period_s && !(*building.period_s > 0 && std::isfinite(*building.period_s)))
    throw Error(fmt::format("period_s is {} (it must be above zero): correct it", *building.period_s));
  if (!(building.damping > 0 && building.damping < 1))
    throw Error(
        fmt::format("damping is {} (a share of critical damping, above 0, since a floor would never come to rest "
                    "without, and below 1): 0.05 is usual",
                    building.damping));
}

VectorXd masses(const Building& building) {
  VectorXd mass(building.floors());
  for (int i = 0; i < building.floors(); ++i)
    mass[i] = building.storeys[static_cast<std::size_t>(i)].mass_kg.value_or(1);
  return mass;
}

// Of each storey. Where the first mode is a straight line, phi_i = H_i, the shear under floor i carries w^2 times what is
// above: k_i h_i = w^2 sum_{j >= i} m_j H_j.
VectorXd stiffnesses(const Building& building, const VectorXd& mass) {
  const int n = building.floors();
  VectorXd stiffness = VectorXd::Ones(n);
  double above = 0;
  for (int i = n - 1; i >= 0; --i) {
    const Storey& storey = building.storeys[static_cast<std::size_t>(i)];
    if (storey.stiffness_npm) {
      stiffness[i] = *storey.stiffness_npm;
    } else if (building.stiffness == Building::Stiffness::straight_first_mode) {
      above += mass[i] * *building.height_m(i + 1);
      stiffness[i] = above / *storey.height_m;
    }
  }
  return stiffness;
}

MatrixXd stiffness_matrix(const VectorXd& storey) {
  const Eigen::Index n = storey.size();
  MatrixXd k = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    k(i, i) += storey[i];
    if (i == 0) continue;
    k(i - 1, i - 1) += storey[i];
    k(i, i - 1) -= storey[i];
    k(i - 1, i) -= storey[i];
  }
  return k;
}

// z_m = (alpha / w_m + beta w_m) / 2, the wanted one at two modes.
void damp_by_rayleigh(const Building& building, std::vector<Mode>& modes) {
  const auto [first, second] = *building.rayleigh_modes;
  const int n = building.floors();
  if (!(1 <= first && first < second && second <= n))
    throw Error(fmt::format("rayleigh_modes is [{}, {}] (two modes of the {} that there are, the lower first): {}",
                            first, second, n,
                            n == 1 ? "leave it out, since one mode has one damping" : "write for example [1, 2]"));
  const double a = modes[static_cast<std::size_t>(first) - 1].w_radps,
               b = modes[static_cast<std::size_t>(second) - 1].w_radps;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const double w = modes[m].w_radps;
    modes[m].damping = building.damping * (a * b / w + w) / (a + b);
    if (!(modes[m].damping < 1))
      throw Error(
          fmt::format("mode {} has {:.3g} of critical damping by Rayleigh's rule (it would not swing): lower "
                      "damping, or name other rayleigh_modes",
                      m + 1, modes[m].damping));
  }
}

}  // namespace

double Mode::period_s() const { return 2 * pi / w_radps; }

std::optional<double> Building::height_m(int floor) const {
  double height = 0;
  for (int i = 0; i < floor; ++i) {
    const auto& storey = storeys[static_cast<std::size_t>(i)].height_m;
    if (!storey) return {};
    height += *storey;
  }
  return height;
}

std::vector<Mode> modes(const Building& building) {
  check(building);
  const VectorXd mass = masses(building);
  const MatrixXd m = mass.asDiagonal(), k = stiffness_matrix(stiffnesses(building, mass));
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solved(k, m);
  const VectorXd& w2 = solved.eigenvalues();
  if (solved.info() != Eigen::Success || !(w2[0] > 0) || !std::isfinite(w2[w2.size() - 1]))
    throw Error(
        "the building has no modes that rounding leaves (masses or stiffnesses differ by too many powers of ten): "
        "correct them");
  const double scale = building.period_s ? 2 * pi / *building.period_s / std::sqrt(w2[0]) : 1;
  std::vector<Mode> modes;
  for (Eigen::Index i = 0; i < w2.size(); ++i) {
    const VectorXd phi = solved.eigenvectors().col(i);  // phi^T M phi = 1
    const double participation = phi.dot(mass);
    Mode mode{scale * std::sqrt(w2[i]), building.damping, participation * participation / mass.sum(), {0.0}};
    for (Eigen::Index floor = 0; floor < phi.size(); ++floor) mode.floors.push_back(participation * phi[floor]);
    modes.push_back(std::move(mode));
  }
  if (building.rayleigh_modes) damp_by_rayleigh(building, modes);
  return modes;
}

}  // namespace freestand::motion
