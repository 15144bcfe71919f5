#pragma once

#include <string>
#include <vector>

#include <pugixml.hpp>

#include "myoid/body/osim/osim_xml.h"

namespace myoid::opensim {

/// Returns a sentence for each element in `tool`, at any depth, that OpenSim's class of its parent lacks, with its line
/// and the class's nearest name. OpenSim ignores such an element without a message, and the default of a misspelt
/// setting stays in force. Elements of unlisted classes, as in a ControllerSet, are not checked.
[[nodiscard]] std::vector<std::string> unknown_elements(const body::OsimXml& xml, pugi::xml_node tool);

}  // namespace myoid::opensim
