#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace myoid::body {

/// Brings every element of a document to its present form, as far as the form does not depend on other elements: names
/// of classes and properties, switches, sockets of markers, path points, forces and constraints. `version` returns the
/// version of an element's form.
void update_parts(pugi::xml_node document, const std::function<int(pugi::xml_node)>& version);

/// Visits an element (or document) and all elements below it; each before its children.
template <typename Visit>
void for_each_element(pugi::xml_node top, const Visit& visit) {
  std::vector<pugi::xml_node> waiting{top};
  while (!waiting.empty()) {
    const pugi::xml_node node = waiting.back();
    waiting.pop_back();
    visit(node);
    for (const auto child : node.children())
      if (child.type() == pugi::node_element) waiting.push_back(child);
  }
}

/// Returns true for the text of a flag that is set.
[[nodiscard]] bool is_true(std::string_view text);
/// Renames a child unless a child of the new name exists.
void rename_child(pugi::xml_node object, const char* old_name, const char* new_name);
/// Returns the path of a body by its name in an old document: "/bodyset/x", "/ground".
[[nodiscard]] std::string body_path(std::string_view name);
/// Appends <name>text</name>.
pugi::xml_node append_text(pugi::xml_node parent, const char* name, const std::string& text);
/// Returns the text of a child without blanks around it; empty without such a child.
[[nodiscard]] std::string child_text(pugi::xml_node parent, const char* name);
/// Appends <PhysicalOffsetFrame name=...> with its parent and place.
pugi::xml_node append_frame(pugi::xml_node parent,
                            const std::string& name,
                            const std::string& body,
                            const std::string& translation,
                            const std::string& orientation);
/// Moves a value into an object, in place of the object's own of this name; nothing without a value.
void move_value(pugi::xml_node value, pugi::xml_node object, const char* new_name);

}  // namespace myoid::body
