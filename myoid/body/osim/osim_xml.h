#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "myoid/body/osim/osim_document.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// An OpenSim document in memory with the one way to read its values. Elements that stand in files of their own are in
/// their places (osim_document.h). For an element that an object omits, the prototype of its class in `<defaults>`
/// gives the value. A text that is no value of the expected kind throws ReadError with the file and the line.
class OsimXml {
 public:
  /// The element that the document must have at its root. With `any`, root() is the document itself
  /// unless its root is <OpenSimDocument> (task sets and loads of old set-ups).
  enum class Root { opensim_document, any };
  /// Parses; throws ReadError (with the line) if the text is no XML or its root is not <OpenSimDocument>.
  OsimXml(std::string text, std::filesystem::path path, Root root = Root::opensim_document);

  [[nodiscard]] pugi::xml_node root() const { return root_; }
  /// Returns the document version in OpenSim's count: 10600, 20303, 30000, 40000, ...; 0 without a version.
  [[nodiscard]] int version() const { return version_; }
  /// Returns the version of the file that holds an element; the document's, if that file has none.
  [[nodiscard]] int version(pugi::xml_node where) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Returns the text of the whole document.
  [[nodiscard]] const std::string& text() const { return whole_.text; }
  /// Returns the other files that hold elements of this document.
  [[nodiscard]] std::vector<std::filesystem::path> files() const;

  [[noreturn]] void fail(pugi::xml_node where, const std::string& message) const;
  template <typename First, typename... Rest>
  [[noreturn]] void fail(pugi::xml_node where,
                         fmt::format_string<First, Rest...> text,
                         First&& first,
                         Rest&&... rest) const {
    fail(where, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  /// Returns "line 12", counted from 1; "forces.xml, line 12" for an element in another file.
  [[nodiscard]] std::string place_of(pugi::xml_node where) const;

  /// Remembers the place and the name of each element, for messages, before elements are renamed and moved.
  void remember_places();
  /// Returns the name of an element in its file.
  [[nodiscard]] std::string tag_of(pugi::xml_node node) const;

  /// Prototypes of classes: the children of a <defaults> element.
  void set_prototypes(pugi::xml_node defaults);
  /// Returns the child of this name, or the prototype's; a child without content counts as absent.
  [[nodiscard]] pugi::xml_node property(pugi::xml_node object, const char* name) const;

  /// Returns the text of an element without blanks around it; empty without such an element.
  [[nodiscard]] std::string word(pugi::xml_node object, const char* name) const;
  [[nodiscard]] static std::string text_of(pugi::xml_node node);
  [[nodiscard]] static std::string name_of(pugi::xml_node node) { return node.attribute("name").value(); }
  [[nodiscard]] std::vector<std::string> words(pugi::xml_node object, const char* name) const;
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node node) const;
  [[nodiscard]] double number(pugi::xml_node object, const char* name, double otherwise) const;
  [[nodiscard]] Vec3 vec3(pugi::xml_node object, const char* name, const Vec3& otherwise) const;
  [[nodiscard]] bool flag(pugi::xml_node object, const char* name, bool otherwise) const;
  /// Returns a sentence for each empty element for which `number`, `vec3` or `flag` took the default, and for each file
  /// that is in another place than named.
  [[nodiscard]] const std::vector<std::string>& repairs() const { return repairs_; }
  /// Returns a sentence for each attribute that has no meaning, and for each element whose content a file replaces.
  [[nodiscard]] const std::vector<std::string>& ignored() const { return ignored_; }

  /// Returns the elements in the <objects> of a set: <XSet><objects>...</objects></XSet>.
  [[nodiscard]] static std::vector<pugi::xml_node> objects(pugi::xml_node set);
  /// Returns the first child that is an element (not a comment) with another name than these.
  [[nodiscard]] static pugi::xml_node first_element(pugi::xml_node parent,
                                                    std::initializer_list<const char*> except = {});

 private:
  /// A place in a file: [0] is the document itself.
  struct Place {
    std::size_t file = 0, line = 0;
  };
  [[nodiscard]] Place find(pugi::xml_node where) const;
  /// Returns the place of an element in the text of the whole document.
  [[nodiscard]] std::size_t offset_of(pugi::xml_node where) const;
  /// Returns the element as `property` does; lists an empty element in `repairs`.
  [[nodiscard]] pugi::xml_node value_of(pugi::xml_node object, const char* name) const;
  /// Lists the attributes that have no meaning.
  void list_attributes();

  std::filesystem::path path_;
  WholeDocument whole_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  int version_ = 0;
  std::unordered_map<std::size_t, std::size_t> places_;  ///< Place of an element in the text by its hash.
  std::map<std::string, pugi::xml_node, std::less<>> prototypes_;
  mutable std::vector<std::string> repairs_;
  std::vector<std::string> ignored_;
};

/// Returns the items of a list in any of SimTK's forms: "1 2 3", "1, 2, 3", "(1 2 3)", "[1,2,3]", "~[1,2,3]". Where
/// commas separate, blanks do not: "0,5 0,7" has the items "0", "5 0" and "7".
[[nodiscard]] std::vector<std::string_view> list_items(std::string_view text);
/// Returns the child of this name, else the child of the other name.
[[nodiscard]] pugi::xml_node either_child(pugi::xml_node parent, const char* name, const char* other);
/// Returns the child of this name, appended if there is none.
pugi::xml_node child_or_new(pugi::xml_node parent, const char* name);
/// Sets an attribute, appended if there is none.
void set_attribute(pugi::xml_node node, const char* name, const std::string& value);
/// Replaces the capital letters of ASCII.
[[nodiscard]] std::string lower_case(std::string_view text);

}  // namespace myoid::body
