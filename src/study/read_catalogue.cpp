#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "base/shown_text.hpp"
#include "exports/exporter.hpp"
#include "study/catalogue.hpp"
#include "study/common_block.hpp"
#include "study/paths.hpp"
#include "study/read_parts.hpp"
#include "study/read_reference.hpp"
#include "study/specimen_table.hpp"

namespace freestand::study {
namespace {

constexpr std::size_t longest_id = 75;  // what other programs take

// Of an entry, beside the keys of a study.
constexpr const char* entry_keys[] = {"id", "class", "description", "source", "reference", "floor"};
// Of the file, beside the keys of a study.
constexpr const char* file_keys[] = {"format",    "name",        "revision", "classes", "floors",
                                     "frictions", "intensities", "entries",  "table",   "exports"};

template <class Keys>
bool contains(const Keys& keys, const std::string& key) {
  return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

// Is there such a key? A look-up in a node that may change would leave the key behind.
bool has(const YAML::Node& map, const std::string& key) { return static_cast<bool>(map[key]); }

// The keys of a mapping with the lines they stand on, without some of them and without those that `root` has.
template <class Keys>
void take(YAML::Node& root, const YAML::Node& from, const Keys& without) {
  for (const auto& pair : from)
    if (!contains(without, pair.first.Scalar()) && !has(root, pair.first.Scalar()))
      root.force_insert(pair.first, pair.second);
}

// Names with what they stand for: `floors`, `frictions`.
using Named = std::vector<std::pair<std::string, YAML::Node>>;

bool is_name(const std::string& text) {
  const auto may_stand = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  return !text.empty() && text.size() <= longest_id && std::all_of(text.begin(), text.end(), may_stand);
}

// One entry on one floor with one friction.
struct Variant {
  std::string suffix, floor, friction;
  YAML::Node motions, friction_node;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const Known& known)
      : path_(file), known_(known), problems_(file.string()) {}

  Catalogue read() {
    const auto root = parse_yaml(read_text(path_), problems_);
    problems_.throw_if_any();
    root_ = *root;
    Section file(root_, "", 1, problems_);
    problems_.throw_if_any();
    read_head(file);
    problems_.throw_if_any();
    check_common();
    problems_.throw_if_any();
    if (const YAML::Node* entries = file.find("entries")) {
      if (!entries->IsSequence() || (entries->size() == 0 && !file.has("table")))
        file.problem("entries", "entries is no list, or has nothing in it (each entry is an item): write - {id: ...}");
      for (const YAML::Node& entry : *entries)
        if (entries->IsSequence()) read_entry(entry, line_of(entry), problems_, path_);
    }
    if (file.find("table"))
      read_table(file);
    else
      problems_.throw_if_any();
    return std::move(catalogue_);
  }

 private:
  void read_head(Section& file) {
    if (const std::string format = file.text("format", ""); format != catalogue_format)
      file.problem("format", fmt::format("format is \"{}\" (this program reads {}): write format: {}", shown(format),
                                         catalogue_format, catalogue_format));
    catalogue_.name = file.text("name", path_.stem().string());
    catalogue_.revision = file.text("revision", "1");
    if (const YAML::Node* node = file.find("classes")) {
      if (const auto names = read_names(*node, "classes", file.line("classes"), problems_))
        catalogue_.classes = names->values;
      closed_ = true;
    }
    if (const YAML::Node* node = file.find("exports")) read_exports(*node, file);
    floors_ = read_named(file, "floors");
    frictions_ = read_named(file, "frictions");
    if (!floors_.empty() && file.has("motions"))
      file.problem("floors", "floors and motions are both given (a floor is a list of motions): remove one");
    if (!frictions_.empty() && file.has("friction"))
      file.problem("frictions", "friction and frictions are both given (which one counts?): remove one");
    if (const YAML::Node* node = file.find("intensities")) {
      if (!node->IsSequence() || node->size() == 0)
        file.problem("intensities", "intensities is no list (each is an item): write [pga_g, pgv_mps]");
      if (has(root_, "fragility") && root_["fragility"].IsMap() && has(root_["fragility"], "im"))
        file.problem("intensities",
                     "intensities and fragility.im are both given (the first of the one is the other): "
                     "remove fragility.im");
      wanted_ = *node;
    }
    if (!file.has("entries") && !file.has("table"))
      file.problem("entries",
                   "entries is missing (there is nothing to sweep): add entries: [...] or table: specimens.csv");
  }

  void read_exports(const YAML::Node& node, Section& file) {
    const auto names = read_names(node, "exports", file.line("exports"), problems_);
    std::vector<std::string> known;
    for (const exports::Format& format : exports::all()) known.push_back(format.name);
    for (const std::string& name : names ? names->values : std::vector<std::string>{})
      if (contains(known, name))
        catalogue_.exports.push_back(name);
      else
        file.problem("exports",
                     fmt::format("exports names {} (formats are {}): correct it", shown(name), joined(known)));
  }

  Named read_named(Section& file, const char* key) {
    const YAML::Node* node = file.find(key);
    Named named;
    if (!node) return named;
    if (!node->IsMap() || node->size() == 0) {
      file.problem(
          key, fmt::format("{} is no mapping (names and what they stand for are needed): write {}: {{name: ...}}", key,
                           key));
      return named;
    }
    for (const auto& pair : *node) {
      if (!is_name(pair.first.Scalar()))
        problems_.add(line_of(pair.first),
                      fmt::format("{}.{} is no name (it becomes a part of ids): use letters, digits, _ "
                                  "and -",
                                  key, shown(pair.first.Scalar())));
      named.emplace_back(pair.first.Scalar(), pair.second);
    }
    return named;
  }

  // The common parts with some block, so that what is wrong with them is told once, and as theirs. Walls and chains may
  // come with the entries.
  void check_common() {
    Known known = known_;
    for (KnownEdp& edp : known.edps)
      edp.wants =
          edp.wants == edp::Wants::chain_force || edp.wants == edp::Wants::contents || edp.wants == edp::Wants::legs
              ? edp::Wants::forces
          : edp.wants == edp::Wants::wall || edp.wants == edp::Wants::chain ? edp::Wants::nothing
                                                                            : edp.wants;
    Named floors = floors_;
    if (floors.empty()) floors.emplace_back("", YAML::Node());
    for (const auto& [name, motions] : floors) {
      YAML::Node root(YAML::NodeType::Map);
      if (!name.empty()) root["motions"] = motions;
      if (name.empty() && !has(root_, "motions"))
        root["motions"] = YAML::Load("[{pulse: B, period_s: 1, peak_acceleration_g: 1}]");
      if (!has(root_, "samples") && !has(root_, "until")) root["samples"] = 1;
      if (has(root_, "block")) root["block"] = block_to_check(root_["block"]);
      take(root, root_, file_keys);
      YAML::Node rest = YAML::Load(
          "{block: {width_m: {uniform: [0.5, 0.6]}, height_m: {uniform: [1, 2]}, mass_kg: "
          "{uniform: [1, 2]}}, friction: {mu: {uniform: [0.1, 0.2]}}}");
      take(root, rest, std::initializer_list<std::string>{});
      Problems found(path_.string());
      read_study_of(root, found, 1, known);
      problems_.add(found);
      if (found.empty() && intensities_.empty()) read_intensities(root);
    }
    for (const auto& [name, friction] : frictions_) {
      YAML::Node root = YAML::Load("{block: {width_m: 1, height_m: 1}}");
      root.force_insert("friction", friction);
      Problems found(path_.string());
      Section section(root, "", line_of(friction), found);
      read_model(section);
      problems_.add(found);
    }
  }

  // Each as a study reads its own.
  void read_intensities(const YAML::Node& root) {
    if (!wanted_.IsSequence()) return;
    for (const YAML::Node& wanted : wanted_) {
      YAML::Node one = YAML::Clone(root), fragility(YAML::NodeType::Map);
      fragility.force_insert("im", wanted);
      one["fragility"] = fragility;
      Problems found(path_.string());
      intensities_.push_back(read_study_of(one, found, line_of(wanted), known_).fragility.im);
      problems_.add(found, line_of(wanted));
    }
  }

  // Relative paths start where those of the catalogue do, wherever an entry stands.
  Study read_study_of(const YAML::Node& root, Problems& problems, int line, const Known& known) {
    try {
      return read_sweep(root, path_, known, Files::look, problems, line);
    } catch (const Error& error) {
      if (problems.empty()) throw;
      return {};
    }
  }

  void read_table(Section& file) {
    const std::filesystem::path table = read_paths_from(file, path_) / file.text("table", "");
    Problems problems(table.string());
    if (std::error_code ignored; !std::filesystem::is_regular_file(table, ignored))
      file.problem("table",
                   fmt::format("table {} cannot be read (there is no such file): correct the name", table.string()));
    else
      for (const SpecimenRow& row : read_specimen_table(table, problems)) {
        Problems of_row(table.string());
        read_entry(row.entry, row.line, of_row, table);
        problems.add(of_row, row.line);
      }
    if (problems_.empty()) problems.throw_if_any();
    if (!problems.empty()) throw Error(problems_.text() + "\n" + problems.text());
    problems_.throw_if_any();
  }

  // One item of `entries`, or one row: all its variants.
  void read_entry(const YAML::Node& node, int line, Problems& problems, const std::filesystem::path& path) {
    Section section(node, "the entry", line, problems);
    if (!node.IsMap()) return;
    database::Entry words;
    words.id = section.text("id", "");
    if (!section.has("id"))
      section.problem("id", "the entry has no id (files and questions name it by that): add id: some-name");
    else if (!is_name(words.id))
      section.problem("id",
                      fmt::format("id \"{}\" is no name (other programs take letters, digits, _ and -, at most {}): "
                                  "change it",
                                  shown(words.id), longest_id));
    words.equipment = section.text("class", "");
    check_class(section, words.equipment);
    words.description = section.text("description", "");
    words.source = section.text("source", "not stated");
    if (const YAML::Node* reference = section.find("reference"))
      read_reference(*reference, section.line("reference"), known_, words, problems);
    const std::size_t before = problems.count();
    for (const Variant& variant : variants(section, node)) {
      if (problems.count() != before) return;
      add(node, variant, words, section, path);
    }
  }

  void check_class(Section& section, const std::string& name) {
    if (!section.has("class")) {
      section.problem("class", "the entry has no class (it is what is looked for in a database): add class: bookcase");
      return;
    }
    if (name.empty() || contains(catalogue_.classes, name)) return;
    if (closed_)
      section.problem("class", fmt::format("class {} is not among `classes` ({}): choose one of {}, or add it there",
                                           shown(name), hint(name, catalogue_.classes), joined(catalogue_.classes)));
    else if (const std::string near = nearest(name, classes_of_other_words(name));
             !near.empty() && edit_distance(name, near) <= 2)
      section.problem("class",
                      fmt::format("class {} is nearly {} (one of them is a slip?): write it alike, or list both "
                                  "under `classes`",
                                  shown(name), near));
    else
      catalogue_.classes.push_back(name);
  }

  // Names that differ in digits only are two of a kind (kind_1, kind_2), no slip.
  std::vector<std::string> classes_of_other_words(const std::string& name) const {
    const auto words = [](std::string text) {
      std::erase_if(text, [](unsigned char c) { return std::isdigit(c); });
      return text;
    };
    std::vector<std::string> others = catalogue_.classes;
    std::erase_if(others, [&](const std::string& other) { return words(other) == words(name); });
    return others;
  }

  // Names of `floors` or `frictions` that an entry takes; parted: they go behind its id.
  struct Taken {
    Named named;
    bool parted = false;
  };

  Taken taken(Section& section, const std::string& key, const Named& all, const YAML::Node* node) {
    if (!node) return {all, true};
    const auto names = read_names(*node, section.name(key), section.line(key), section.problems());
    Taken taken{{}, node->IsSequence()};
    std::vector<std::string> choices;
    for (const auto& [name, ignored] : all) choices.push_back(name);
    for (const std::string& name : names ? names->values : std::vector<std::string>{}) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
      if (found != all.end())
        taken.named.push_back(*found);
      else
        section.problem(key, fmt::format("{} {} is not among `{}s` of the catalogue ({}): correct it", key, shown(name),
                                         key, choices.empty() ? "it has none" : hint(name, choices)));
    }
    return taken;
  }

  std::vector<Variant> variants(Section& section, const YAML::Node& node) {
    Taken floors, frictions;
    if (!node["motions"] || section.has("floor")) floors = taken(section, "floor", floors_, section.find("floor"));
    const YAML::Node friction = node["friction"];
    if (!friction || !friction.IsMap())
      frictions = taken(section, "friction", frictions_, friction ? section.find("friction") : nullptr);
    if (floors.named.empty()) floors = {{{"", YAML::Node()}}, false};
    if (frictions.named.empty()) frictions = {{{"", YAML::Node()}}, false};
    std::vector<Variant> all;
    for (const auto& [friction_name, friction_node] : frictions.named)
      for (const auto& [floor_name, motions] : floors.named)
        all.push_back({(frictions.parted ? "_" + friction_name : "") + (floors.parted ? "_" + floor_name : ""),
                       floor_name, friction_name, motions, friction_node});
    return all;
  }

  void add(const YAML::Node& node, const Variant& variant, database::Entry words, Section& section,
           const std::filesystem::path& path) {
    YAML::Node root(YAML::NodeType::Map);
    if (!variant.floor.empty()) root.force_insert("motions", variant.motions);
    if (!variant.friction.empty()) root.force_insert("friction", variant.friction_node);
    const YAML::Node own = node["block"], common = root_["block"];
    if (own && common && own.IsMap() && common.IsMap()) root["block"] = joined_block(own, common);
    take(root, node, entry_keys);
    take(root, root_, file_keys);
    Problems found(path.string());
    Study study = read_study_of(root, found, section.line(), known_);
    words.id += variant.suffix;
    words.floor = variant.floor;
    words.friction = variant.friction;
    if (words.id.size() > longest_id)
      section.problem(
          "id", fmt::format("id {} is longer than {} (other programs take no more): shorten it", words.id, longest_id));
    const std::string place = fmt::format("{}:{}", path.string(), section.line());
    if (const auto [first, fresh] = ids_.try_emplace(words.id, place); !fresh)
      section.problem("id", fmt::format("id {} stands twice (first at {}): rename one", words.id, first->second));
    // What an entry makes wrong of the common parts, which are sound, is its own.
    section.problems().add(found, section.line(), section.line());
    if (!found.empty()) return;
    study.name = words.id;
    if (!intensities_.empty()) study.fragility.im = intensities_.front();
    if (study.until && intensities_.size() > 1) study.until->everywhere = true;  // the other intensities want them
    describe(study, words);
    catalogue_.entries.push_back({std::move(words), std::move(study), place, {}});
    if (!intensities_.empty()) catalogue_.entries.back().others.assign(intensities_.begin() + 1, intensities_.end());
  }

  const std::filesystem::path path_;
  const Known& known_;
  Problems problems_;
  YAML::Node root_;
  Named floors_, frictions_;
  YAML::Node wanted_;  // intensities
  std::vector<IntensityPart> intensities_;
  bool closed_ = false;                     // classes are listed
  std::map<std::string, std::string> ids_;  // -> place
  Catalogue catalogue_;
};

}  // namespace

Catalogue read_catalogue(const std::filesystem::path& file, const Known& known) { return Reader(file, known).read(); }

}  // namespace freestand::study
