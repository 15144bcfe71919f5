#pragma once

#include <string>
#include <vector>

#include <pugixml.hpp>

#include "myoid/osim/osim_xml.h"

namespace myoid {

/// A sentence for each element in `tool`, at any depth, that OpenSim's class of its parent lacks:
/// line and nearest name of the class. OpenSim ignores such an element in silence, and the default
/// of a misspelt setting stays in force. Elements of unlisted classes, as in a ControllerSet, are
/// not checked.
[[nodiscard]] std::vector<std::string> unknown_elements(const model::OsimXml& xml,
                                                        pugi::xml_node tool);

}  // namespace myoid
