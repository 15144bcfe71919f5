#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "myoid/core/geometry.h"

namespace myoid::model {

/// An OpenSim document in memory and the one way to take values from it: an element that an object
/// omits comes from the prototype of its class in `<defaults>`; what is no value of the expected
/// kind throws ReadError with the line. The text must outlive the document.
class OsimXml {
 public:
  /// Which element the document must have at its root; with `any` root() is the document itself
  /// where that is not <OpenSimDocument> (task sets and loads of old set-ups).
  enum class Root { opensim_document, any };
  /// Parses; throws ReadError (with the line) if the text is no XML or its root is not
  /// <OpenSimDocument>.
  OsimXml(std::string_view text, std::filesystem::path path, Root root = Root::opensim_document);

  [[nodiscard]] pugi::xml_node root() const { return root_; }
  /// Document version as OpenSim counts: 10600, 20303, 30000, 40000, ...; 0 if there is none.
  [[nodiscard]] int version() const { return version_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  [[noreturn]] void fail(pugi::xml_node where, const std::string& message) const;
  /// The line of an element in the text, counted from 1.
  [[nodiscard]] std::size_t line_of(pugi::xml_node where) const;

  /// Prototypes of classes: the children of a <defaults> element.
  void set_prototypes(pugi::xml_node defaults);
  /// The child of this name, or the prototype's; one without content counts as absent.
  [[nodiscard]] pugi::xml_node property(pugi::xml_node object, const char* name) const;

  /// Text of an element without blanks around it; an empty string if there is no such element.
  [[nodiscard]] std::string word(pugi::xml_node object, const char* name) const;
  [[nodiscard]] static std::string text_of(pugi::xml_node node);
  [[nodiscard]] static std::string name_of(pugi::xml_node node) {
    return node.attribute("name").value();
  }
  [[nodiscard]] std::vector<std::string> words(pugi::xml_node object, const char* name) const;
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node node) const;
  [[nodiscard]] double number(pugi::xml_node object, const char* name, double otherwise) const;
  [[nodiscard]] Vec3 vec3(pugi::xml_node object, const char* name, const Vec3& otherwise) const;
  [[nodiscard]] bool flag(pugi::xml_node object, const char* name, bool otherwise) const;
  /// A sentence for each element that `number`, `vec3` or `flag` found empty, so that its default
  /// holds.
  [[nodiscard]] const std::vector<std::string>& defaulted() const { return defaulted_; }

  /// The objects of a set: <XSet><objects>...</objects></XSet>.
  [[nodiscard]] static pugi::xml_object_range<pugi::xml_node_iterator> objects(pugi::xml_node set) {
    return set.child("objects").children();
  }
  /// First child that is an element (not a comment), other than those named.
  [[nodiscard]] static pugi::xml_node first_element(pugi::xml_node parent,
                                                    std::initializer_list<const char*> except = {});

 private:
  /// As `property`; an element that is there and empty is told by `defaulted`.
  [[nodiscard]] pugi::xml_node value_of(pugi::xml_node object, const char* name) const;

  std::string_view text_;
  std::filesystem::path path_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  int version_ = 0;
  std::map<std::string, pugi::xml_node, std::less<>> prototypes_;
  mutable std::vector<std::string> defaulted_;
};

}  // namespace myoid::model
