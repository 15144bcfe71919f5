#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/remark.h"
#include "myoid/opensim/setup_elements.h"

namespace myoid::opensim {

/// Reads a document of any root. Throws ReadError with the line if it is no XML.
[[nodiscard]] body::OsimXml read_document(const std::filesystem::path& path);

/// Returns the number in an element; empty if the element is absent or empty. Throws ReadError with the line unless it
/// is one finite number.
[[nodiscard]] std::optional<double> finite_number(const body::OsimXml& xml, pugi::xml_node parent, const char* name);

/// Returns the text of an element; throws ReadError with the line of the parent if there is none.
[[nodiscard]] std::string required_word(const body::OsimXml& xml, pugi::xml_node parent, const char* name);

/// Appends an element with this text.
void append_text(pugi::xml_node parent, const char* name, const std::string& text);

/// Returns the text of a document that is written.
[[nodiscard]] std::string document_text(const pugi::xml_document& document);

/// Returns the name of the first element inside an element: "stiff" of <tendon><stiff/></tendon>.
[[nodiscard]] std::string chosen(pugi::xml_node parent, const char* name);

/// Adds a remark of one kind of unknown element each, with the line of the first.
void note_unknown_elements(const body::OsimXml& xml,
                           pugi::xml_node root,
                           const ElementTable& table,
                           std::vector<Remark>& remarks);

/// Adds a remark on how a file was read.
void note_reading(std::vector<Remark>& remarks,
                  const std::filesystem::path& path,
                  std::string says,
                  std::string about = {});

}  // namespace myoid::opensim
