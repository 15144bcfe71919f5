#include "myoid/body/model/opensim_defects/compat.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {

Compat parse_compat(std::string_view name) {
  if (name == "exact") return {};
  if (name == "opensim") return kOpenSim452;
  throw InvalidInput(fmt::format("compat: expected exact or opensim, found '{}'", name));
}

std::string_view name_of(const Compat& compat) { return compat == Compat{} ? "exact" : "opensim"; }

}  // namespace myoid::body
