#include "edp/edp.hpp"

#include <freestand/error.hpp>
#include <utility>

#include "base/registry.hpp"

namespace freestand::edp {

Register::Register(Edp edp) { Registered<Edp>{std::move(edp)}; }

const std::vector<Edp>& all() { return registry<Edp>(); }

const Edp& find(const std::string& name) {
  std::string known;
  for (const Edp& edp : all()) {
    if (edp.name == name) return edp;
    known += (known.empty() ? "" : ", ") + edp.name;
  }
  throw Error("unknown demand parameter \"" + name + "\" (known: " + known + "): name one of these");
}

}  // namespace freestand::edp
