#include "exports/openquake_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <iterator>

#include "base/shown_text.hpp"
#include "exports/ground.hpp"

namespace freestand::exports::openquake {
namespace {

constexpr std::size_t longest_id = 75;

// Splits [a, b] until a straight line across each piece is off by at most 1e-7 at its quarters. The largest error of a
// line across a short smooth piece is at most 4/3 of that at a quarter, so 2e-7 holds everywhere.
void refine(const Curve& curve, double a, double b, int depth, std::vector<double>& nodes) {
  const double pa = probability(curve, a), pb = probability(curve, b);
  bool straight = depth > 0;  // the first pieces are as wide as the curve itself
  for (const double share : {0.25, 0.5, 0.75})
    if (std::fabs(probability(curve, a + (b - a) * share) - (pa + (pb - pa) * share)) > 1e-7) straight = false;
  if (!straight && depth < 30) {
    refine(curve, a, (a + b) / 2, depth + 1, nodes);
    refine(curve, (a + b) / 2, b, depth + 1, nodes);
  } else {
    nodes.push_back(b);
  }
}

}  // namespace

Imt imt_of(const Intensity& im) {
  const std::string name = ground_name(im);
  if (name == "pga_g" || name == "pta_g") return {"PGA", 1};
  if (name == "pgv_mps") return {"PGV", 100};
  if (name == "pgd_m") return {"PGD", 100};
  if (name == "sa_g") return {fmt::format("SA({:#})", im.period_s), 1};
  throw Error(
      fmt::format("OpenQuake has no name for the intensity {} (it knows PGA, PGV, PGD and SA of the ground, none of a "
                  "floor or of a block): {}",
                  im.name, fit_over_the_ground));
}

std::vector<std::string> notes_on(const Model& model) { return {of_the_ground(model.im, "OpenQuake")}; }

// OpenQuake Engine, user guide, inputs, "Fragility Models" and "Vulnerability Models": the attribute lossCategory.
void refuse_loss_category(const Model& model, bool of_vulnerability) {
  std::vector<std::string> known{"structural", "nonstructural", "contents", "business_interruption"};
  if (of_vulnerability) known.emplace_back("occupants");
  if (std::find(known.begin(), known.end(), model.loss_category) == known.end())
    throw Error(
        fmt::format("OpenQuake has no loss category {} (its lossCategory is one of {}): give one of them with "
                    "--loss-category",
                    shown(model.loss_category), fmt::join(known, ", ")));
}

void refuse(const Model& model) {
  imt_of(model.im);
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' ||
           c == '-';
  };
  if (model.id.empty() || model.id.size() > longest_id || !std::all_of(model.id.begin(), model.id.end(), allowed))
    throw Error(
        fmt::format("OpenQuake refuses the id {} (letters, digits and _ : - only, no dot, at most {} of them): give "
                    "another one with --id",
                    shown(model.id, 2 * longest_id), longest_id));
  if (model.description.find_first_not_of(" \t\n") == std::string::npos)
    throw Error("OpenQuake refuses an empty description (it must say what this is): give one with --description");
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result;
}

std::string document(const std::string& body) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n{}</nrml>\n",
      body);
}

std::vector<double> levels(const std::vector<LimitState>& states, double im_most) {
  std::vector<double> nodes;
  for (const LimitState& state : states)
    if (state.curve.form == Form::lognormal) {
      refine(state.curve, 0, im_most, 0, nodes);
    } else {
      for (const Point& point : state.curve.points) nodes.push_back(point.im);
    }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::erase_if(nodes, [](double im) { return !(im > 0); });
  return nodes;
}

std::string numbers(const std::vector<double>& values) { return fmt::format("{}", fmt::join(values, " ")); }

}  // namespace freestand::exports::openquake
