#include "exports/check_openquake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <limits>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

namespace freestand::exports {
namespace openquake_check {

void broken(const std::filesystem::path& file, const std::string& rule) {
  throw Error(fmt::format("{} is not what OpenQuake reads ({}): export again, and tell the makers of freestand",
                          file.string(), rule),
              Exit::data);
}

void require(bool holds, const std::filesystem::path& file, const std::string& rule) {
  if (!holds) broken(file, rule);
}

pugi::xml_node model(const pugi::xml_document& document, const std::filesystem::path& file, const char* name) {
  const pugi::xml_node root = document.child("nrml");
  require(std::strcmp(root.attribute("xmlns").value(), "http://openquake.org/xmlns/nrml/0.5") == 0, file,
          "the outer element is nrml of version 0.5");
  const pugi::xml_node found = root.first_child();
  require(std::strcmp(found.name(), name) == 0 && !found.next_sibling(), file, std::string("nrml holds one ") + name);
  static const std::regex id("[A-Za-z0-9_:-]{1,75}");
  require(std::regex_match(found.attribute("id").value(), id), file,
          "the model's id has letters, digits and _ : - only");
  for (const char* attribute : {"assetCategory", "lossCategory"})
    require(*found.attribute(attribute).value() != '\0', file, std::string("the model has an ") + attribute);
  const std::string description = found.first_child().child_value();
  require(std::strcmp(found.first_child().name(), "description") == 0 &&
              description.find_first_not_of(" \t\n") != std::string::npos,
          file, "the first element of the model is a description that says something");
  return found;
}

std::vector<double> numbers(const char* text, const std::filesystem::path& file) {
  std::vector<double> values;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    require(error == std::errc{} && end == word.data() + word.size(), file, word + " is a number");
    values.push_back(value);
  }
  return values;
}

Unit unit_of(const std::string& imt, const Intensity& im, const std::filesystem::path& file) {
  std::smatch match;
  static const std::regex spectral("SA\\(([0-9.]+)\\)");
  if (std::regex_match(imt, match, spectral)) {
    require(im.unit == "g" && std::stod(match[1]) == im.period_s, file, "SA is of the period that was fitted");
    return {"g", 1};
  }
  if (imt == "PGA" && im.unit == "g") return {"g", 1};
  if (imt == "PGV" && im.unit == "m/s") return {"cm/s", 0.01};
  if (imt == "PGD" && im.unit == "m") return {"cm", 0.01};
  broken(file, "its imt " + imt + " fits an intensity in " + im.unit);
}

double line(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  return y[i - 1] + (y[i] - y[i - 1]) / (x[i] - x[i - 1]) * (at - x[i - 1]);
}

}  // namespace openquake_check

namespace {

using namespace openquake_check;

// OpenQuake's own least level, where a file says 0 or nothing.
constexpr double least_level = 1e-10;

double cdf(double z) { return 0.5 * std::erfc(-z * std::sqrt(0.5)); }

// Limit states as the file names them.
std::vector<std::string> state_names(const pugi::xml_node& node, const std::filesystem::path& file) {
  require(std::strcmp(node.name(), "limitStates") == 0, file, "limitStates stand behind the description");
  static const std::regex name("[A-Za-z_][A-Za-z0-9_]*");
  std::vector<std::string> names;
  std::istringstream words(node.child_value());
  for (std::string word; words >> word; names.push_back(word))
    require(std::regex_match(word, name), file, "limit states are words of letters, digits and _");
  require(!names.empty(), file, "there is a limit state");
  return names;
}

// The children of a function behind its imls: one for each limit state, in their order.
std::vector<pugi::xml_node> states_of(const pugi::xml_node& function, const char* element,
                                      const std::vector<std::string>& names, const std::filesystem::path& file) {
  std::vector<pugi::xml_node> nodes;
  for (pugi::xml_node node = function.first_child().next_sibling(); node; node = node.next_sibling())
    nodes.push_back(node);
  require(nodes.size() == names.size(), file, "a function has every limit state");
  for (std::size_t s = 0; s < nodes.size(); ++s)
    require(std::strcmp(nodes[s].name(), element) == 0 && nodes[s].attribute("ls").value() == names[s], file,
            "limit states of a function stand in the order of limitStates");
  return nodes;
}

double attribute(const pugi::xml_node& node, const char* name, const std::filesystem::path& file) {
  const std::vector<double> values = numbers(node.attribute(name).value(), file);
  require(values.size() == 1 && values[0] >= 0, file, std::string(name) + " is one number that is not negative");
  return values[0];
}

struct Continuous {
  double no_damage, least, most;
  std::vector<double> median, dispersion;

  double at(std::size_t state, double level) const {
    level = std::max(std::min(level, most), least);
    return level <= no_damage ? 0 : cdf(std::log(level / median[state]) / dispersion[state]);
  }
};

Continuous continuous(const pugi::xml_node& function, const std::vector<std::string>& names,
                      const std::filesystem::path& file) {
  require(std::strcmp(function.attribute("shape").value(), "logncdf") == 0, file, "a continuous function is a logncdf");
  const pugi::xml_node imls = function.first_child();
  Continuous found{
      attribute(imls, "noDamageLimit", file), attribute(imls, "minIML", file), attribute(imls, "maxIML", file), {}, {}};
  if (found.no_damage == 0) found.no_damage = least_level;
  if (found.least == 0) found.least = least_level;
  require(found.least < found.most, file, "minIML is below maxIML");
  for (const pugi::xml_node& node : states_of(function, "params", names, file)) {
    const double mean = attribute(node, "mean", file), variance = std::pow(attribute(node, "stddev", file), 2);
    found.dispersion.push_back(std::sqrt(std::log(variance / (mean * mean) + 1)));
    found.median.push_back(mean * mean / std::sqrt(variance + mean * mean));
  }
  return found;
}

struct Discrete {
  double no_damage;
  std::vector<double> levels;
  std::vector<std::vector<double>> poes;  // [state][level]

  double at(std::size_t state, double level) const { return level < no_damage ? 0 : line(levels, poes[state], level); }
};

std::vector<double> begun_with(double first, const std::vector<double>& rest) {
  std::vector<double> all{first};
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

// The reader refuses none of what is asked of the probabilities here, but counts wrong with them.
Discrete discrete(const pugi::xml_node& function, const std::vector<std::string>& names,
                  const std::filesystem::path& file) {
  const pugi::xml_node imls = function.first_child();
  Discrete found{imls.attribute("noDamageLimit") ? attribute(imls, "noDamageLimit", file) : 0,
                 numbers(imls.child_value(), file),
                 {}};
  if (found.no_damage == 0) found.no_damage = least_level;
  require(found.levels.size() > 1, file, "there are levels");
  require(std::adjacent_find(found.levels.begin(), found.levels.end(), std::greater_equal<>()) == found.levels.end() &&
              found.no_damage < found.levels.front(),
          file, "levels rise, above noDamageLimit");
  for (const pugi::xml_node& node : states_of(function, "poes", names, file)) {
    std::vector<double> values = numbers(node.child_value(), file);
    require(values.size() == found.levels.size(), file, "there is a probability for each level");
    require(std::is_sorted(values.begin(), values.end()) && values.front() >= 0 && values.back() <= 1, file,
            "probabilities do not fall, and lie within 0 and 1");
    values = begun_with(0, values);
    if (!found.poes.empty())
      for (std::size_t i = 0; i < values.size(); ++i)
        require(values[i] <= found.poes.back()[i] + 1e-6, file, "limit states do not cross");
    found.poes.push_back(values);
  }
  found.levels = begun_with(found.no_damage, found.levels);
  return found;
}

// The function of that id, or the only one: id "".
ReadBack open_one(const std::filesystem::path& file, const Intensity& im, const std::string& id) {
  pugi::xml_document document;
  require(static_cast<bool>(document.load_file(file.c_str())), file, "it is XML");
  const pugi::xml_node fragility = model(document, file, "fragilityModel");
  const pugi::xml_node states = fragility.first_child().next_sibling();
  pugi::xml_node function = states.next_sibling();
  const std::vector<std::string> names = state_names(states, file);
  std::set<std::string> ids;
  for (pugi::xml_node one = function; one; one = one.next_sibling()) {
    require(std::strcmp(one.name(), "fragilityFunction") == 0 && *one.attribute("id").value() != '\0' &&
                ids.insert(one.attribute("id").value()).second,
            file, "fragilityFunctions, each with an id of its own, stand behind limitStates");
    if (id == one.attribute("id").value()) function = one;
  }
  require(id.empty() ? ids.size() == 1 : ids.contains(id), file,
          id.empty() ? "it holds one function" : "it holds the function " + id);
  require(std::strcmp(function.first_child().name(), "imls") == 0, file, "imls are first in a function");
  const Unit unit = unit_of(function.first_child().attribute("imt").value(), im, file);
  ReadBack back{names, {}, unit.text, "", 0};
  if (std::strcmp(function.attribute("format").value(), "continuous") == 0) {
    const Continuous found = continuous(function, names, file);
    back.probability = [found, unit](std::size_t s, double value) { return found.at(s, value / unit.in_si); };
  } else {
    const Discrete found = discrete(function, names, file);
    back.probability = [found, unit](std::size_t s, double value) { return found.at(s, value / unit.in_si); };
  }
  return back;
}

ReadBack open(const std::filesystem::path& file, const Intensity& im) { return open_one(file, im, ""); }

const RegisterCheck here{{.name = "openquake", .open = open, .open_one = open_one}};

}  // namespace
}  // namespace freestand::exports
