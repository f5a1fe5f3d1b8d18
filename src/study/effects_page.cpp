#include "study/effects_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "effects/effects.hpp"
#include "sampling/distribution.hpp"

namespace freestand::study {
namespace {

using dynamics::Effect;
using dynamics::Parameter;
using sampling::number_text;

constexpr std::size_t text_width = 96;

// Words on lines up to the right edge, behind a label and under one another.
std::string wrapped(std::string result, const std::string& text, std::size_t margin) {
  const std::size_t width = text_width + 12 - margin;
  std::string line;
  bool first = true;
  const auto flush = [&] {
    result += (first ? "" : std::string(margin, ' ')) + line + "\n";
    first = false;
    line.clear();
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (!line.empty() && line.size() + 1 + end - at > width) flush();
    if (!line.empty()) line += ' ';
    line += text.substr(at, end - at);
    at = end + 1;
  }
  flush();
  return result;
}

std::string paragraph(const std::string& label, const std::string& text) {
  constexpr std::size_t margin = 12;
  return text.empty() ? "" : wrapped(fmt::format("  {:<{}}", label, margin - 2), text, margin);
}

std::string bound(double x) { return std::isfinite(x) ? number_text(x) : "inf"; }

std::string parameter_line(const Parameter& p) {
  std::string text = fmt::format("    {:<14} {:<5} {}{}, {}]", p.name, p.unit, p.lower_open ? "(" : "[", bound(p.lower),
                                 bound(p.upper));
  std::string summary = p.summary;
  if (p.neutral) summary += fmt::format("; no effect at {}", bound(*p.neutral));
  if (p.fallback) summary += fmt::format("; {} where a study does not say", number_text(*p.fallback));
  if (!p.fitted) summary += ", and in diagnose and add";
  return wrapped(fmt::format("{:<42} ", text), summary, 43);
}

// An entry of a study in the middle of the usual ranges.
std::string example(const Effect& effect) {
  std::string text = "{name: " + effect.name;
  for (const auto& p : effect.parameters) {
    const double middle = p.low > 0 ? std::sqrt(p.low * p.high) : 0.5 * (p.low + p.high) + 0.25 * (p.high - p.low);
    text += fmt::format(", {}: {:.2g}", p.name, middle);
  }
  return text + "}";
}

nlohmann::ordered_json number(std::optional<double> x) {
  if (!x || !std::isfinite(*x)) return nullptr;
  return *x;
}

}  // namespace

std::string effects_list() {
  std::size_t width = 0;
  for (const auto& effect : effects::all()) width = std::max(width, effect.name.size());
  std::string text;
  for (const auto& effect : effects::all()) text += fmt::format("{:<{}}  {}\n", effect.name, width, effect.summary);
  return text +
         "\n`freestand effects NAME` tells law, parameters, source and when to suspect it. A law of your own "
         "goes into\nthe study as a formula: effects: [{name: my_seam, friction: \"mu*(1 + a*sin(2*pi*u/l))\", "
         "parameters: {a: 0.3, l_m: 0.05}}]\n"
         "\nA formula looks at\n"
         "  u, v          displacement of the middle of the base [m], its rate\n"
         "  theta, omega  rotation [rad], its rate\n"
         "  speed, sigma  of the slip [m/s], and its direction: 1 to the right, -1 to the left\n"
         "  path          slid so far [m]\n"
         "  rest          for how long the contact has stood still, since a slip, flight or blow [s]\n"
         "  normal        normal force over the weight\n"
         "  side          1 on the right corner, -1 on the left one, 0 on both\n"
         "  t             time [s]\n"
         "  mu, g, pi     and the effect's own numbers\n"
         "through + - * / ^ < > exp log sqrt sin cos tanh abs min max step if(x, where x > 0, else).\n";
}

std::string effect_page(const Effect& effect) {
  std::string text = fmt::format("{}: {}\n", effect.name, effect.summary);
  text += paragraph("law", effect.law) + "  parameters\n";
  for (const auto& p : effect.parameters) text += parameter_line(p);
  text += paragraph("suspect", effect.suspect.empty() ? "" : "it when " + effect.suspect);
  text += paragraph("twins", effect.twins);
  if (!effect.excludes.empty()) text += paragraph("not with", fmt::format("{}", fmt::join(effect.excludes, ", ")));
  return text + paragraph("source", effect.source) + paragraph("study", "effects: [" + example(effect) + "]");
}

nlohmann::ordered_json effect_json(const Effect& effect) {
  nlohmann::ordered_json json = {{"name", effect.name},         {"summary", effect.summary}, {"law", effect.law},
                                 {"source", effect.source},     {"suspect", effect.suspect}, {"twins", effect.twins},
                                 {"excludes", effect.excludes}, {"example", example(effect)}};
  json["parameters"] = nlohmann::ordered_json::array();
  for (const auto& p : effect.parameters)
    json["parameters"].push_back({{"name", p.name},
                                  {"unit", p.unit},
                                  {"summary", p.summary},
                                  {"lower", number(p.lower)},
                                  {"upper", number(p.upper)},
                                  {"neutral", number(p.neutral)},
                                  {"default", number(p.fallback)},
                                  {"fitted", p.fitted},
                                  {"low", p.low},
                                  {"high", p.high}});
  return json;
}

nlohmann::ordered_json effects_json(const Study& study) {
  auto all = nlohmann::ordered_json::array();
  for (const EffectPart& part : study.model.effects) {
    nlohmann::ordered_json entry = {{"name", part.name},
                                    {"summary", part.effect->summary},
                                    {"law", part.effect->law},
                                    {"source", part.effect->source}};
    entry["parameters"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < part.parameters.size(); ++i) {
      const Parameter& p = part.effect->parameters[i];
      entry["parameters"].push_back({{"name", p.name},
                                     {"unit", part.parameters[i].unit},
                                     {"summary", p.summary},
                                     {"value", to_string(part.parameters[i].value)}});
    }
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace freestand::study
