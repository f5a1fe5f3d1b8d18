// Constant registries: things that are found by name and declared one to a file.
//
// Each file holds one `const Registered<Entry> here{{.name = ..., ...}};`. Entries are kept sorted by name, so that the
// order in which the linker placed the files does not show. Modules that register are OBJECT libraries
// (freestand_module
// ... REGISTRY), or the linker would drop the files.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace freestand {

// All entries of one kind, sorted by name. Filled before main begins, constant afterwards.
template <class Entry>
std::vector<Entry>& registry() {
  static std::vector<Entry> entries;
  return entries;
}

template <class Entry>
struct Registered {
  explicit Registered(Entry entry) {
    auto& entries = registry<Entry>();
    const auto before = [](const Entry& a, const Entry& b) { return a.name < b.name; };
    entries.insert(std::upper_bound(entries.begin(), entries.end(), entry, before), std::move(entry));
  }
};

}  // namespace freestand
