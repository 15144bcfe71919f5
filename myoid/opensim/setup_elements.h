#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "myoid/body/osim/osim_xml.h"

namespace myoid::opensim {

/// The elements that the elements of a document may hold: by the name of the parent, names with blanks between.
using ElementTable = std::map<std::string, std::string, std::less<>>;

/// An element that a table lacks.
struct UnknownElement {
  pugi::xml_node parent, element;
  std::optional<std::string> nearest;  ///< The most similar name that the parent may hold.
};

/// Returns each element in `tool`, at any depth, that the table lacks for its parent. Elements of parents without an
/// entry are not checked.
[[nodiscard]] std::vector<UnknownElement> unknown_elements(pugi::xml_node tool, const ElementTable& table);

/// Returns a sentence for each element in `tool`, at any depth, that OpenSim's class of its parent lacks, with its line
/// and the class's nearest name. OpenSim ignores such an element without a message, and the default of a misspelt
/// setting stays in force. Elements of unlisted classes, as in a ControllerSet, are not checked.
[[nodiscard]] std::vector<std::string> unknown_elements(const body::OsimXml& xml, pugi::xml_node tool);

}  // namespace myoid::opensim
