// Databases whose curves are lognormal with parameters by rule, so that every answer has a closed form.
#pragma once

#include <gsl/gsl_cdf.h>

#include <cmath>

#include "database/database.hpp"

namespace freestand::database::test {

inline double lognormal(double im, double median, double dispersion) {
  return gsl_cdf_ugaussian_P(std::log(im / median) / dispersion);
}

// Points at im = 0.1, 0.2 ... 1.6 of a lognormal, its band those of medians 20 % higher and lower.
inline Curve curve(std::size_t entry, double capacity, double median, double dispersion) {
  Curve made{.entry = entry, .im = "pga_g", .demand = "peak_slip_m", .capacity = capacity};
  made.im_least = 0.1;
  made.im_most = 1.6;
  made.n = 5000000;
  made.family = lognormal_family;
  made.median = median;
  made.dispersion = dispersion;
  for (double im = 0.1; im < 1.7; im *= 2)
    made.points.push_back({im, lognormal(im, median, dispersion), lognormal(im, 1.2 * median, dispersion),
                           lognormal(im, median / 1.2, dispersion), 1000000});
  return made;
}

// Median of the entry at friction mu, height h, capacity c: a power law in each, so that Phi^-1(P) is linear in all logarithms.
inline constexpr double dispersion = 0.6;
inline double median(double mu, double height, double capacity) {
  return 0.9 * std::pow(mu, 0.8) * std::pow(height, -0.5) * std::pow(capacity / 0.05, 0.3);
}

// A class "rack" on a grid of friction 0.2, 0.3, 0.5 and height 1, 2 (width 0.6), and one bookcase.
inline Database made_database() {
  Database db{.name = "made", .revision = "7", .classes = {"rack", "bookcase"}};
  db.intensities = {{"pga_g", "g", "PGA", "peak acceleration of the floor"}};
  db.demands = {{"peak_slip_m", "m", "U", "largest slip"}, {"overturned", "1", "", "fell", true}};
  const auto add = [&](const std::string& id, const std::string& equipment, double mu, double height) {
    Entry entry;
    entry.id = id;
    entry.equipment = equipment;
    entry.mu_k = mu;
    entry.mu_s = 1.2 * mu;
    entry.width_m = 0.6;
    entry.height_m = height;
    entry.mass_kg = 100 * height;
    entry.samples = 5000000;
    for (const double capacity : {0.05, 0.2})
      db.curves.push_back(curve(db.entries.size(), capacity, median(mu, height, capacity), dispersion));
    db.entries.push_back(entry);
  };
  for (const double mu : {0.2, 0.3, 0.5})
    for (const double height : {1.0, 2.0})
      add("rack_" + std::to_string(static_cast<int>(mu * 100 + 0.5)) + "_" + std::to_string(static_cast<int>(height)),
          "rack", mu, height);
  add("bookcase", "bookcase", 0.4, 1.8);
  return db;
}

}  // namespace freestand::database::test
