#pragma once

#include <string>
#include <vector>

#include <pugixml.hpp>

#include "myoid/osim/osim_xml.h"

namespace myoid {

/// A sentence for each element in `tool`, at any depth, that OpenSim's class of its parent does not
/// have: its line, and the nearest name that the class has. OpenSim ignores such an element in
/// silence, so that a misspelt setting leaves its default in force. Classes whose elements are not
/// listed here, such as those of a ControllerSet, are not looked into.
[[nodiscard]] std::vector<std::string> unknown_elements(const model::OsimXml& xml,
                                                        pugi::xml_node tool);

}  // namespace myoid
