#include "exports/exporter.hpp"

#include <freestand/error.hpp>
#include <utility>

#include "base/registry.hpp"

namespace freestand::exports {

Register::Register(Format format) { Registered<Format>{std::move(format)}; }
RegisterCheck::RegisterCheck(Check check) { Registered<Check>{std::move(check)}; }

const std::vector<Format>& all() { return registry<Format>(); }

const Format& find(const std::string& name) {
  std::string known;
  for (const Format& format : all()) {
    if (format.name == name) return format;
    known += (known.empty() ? "" : ", ") + format.name;
  }
  throw Error("unknown format " + name + " (known: " + known + "): name one of these");
}

const Check& check_of(const std::string& format) {
  for (const Check& check : registry<Check>())
    if (check.name == format) return check;
  throw Error("format " + format + " has no check (nothing would prove what is written): add check_" + format + ".cpp");
}

}  // namespace freestand::exports
