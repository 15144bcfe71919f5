#include "myoid/opensim/projects/project_xml.h"

#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/files/text_file.h"

namespace myoid::opensim {

body::OsimXml read_document(const std::filesystem::path& path) {
  return {read_text_file(path), path, body::OsimXml::Root::any};
}

std::optional<double> finite_number(const body::OsimXml& xml, pugi::xml_node parent, const char* name) {
  if (!xml.property(parent, name)) return std::nullopt;
  const double value = xml.number(parent, name, 0.0);
  if (!std::isfinite(value)) xml.fail(parent.child(name), "<{}>: expected a finite number", name);
  return value;
}

std::string required_word(const body::OsimXml& xml, pugi::xml_node parent, const char* name) {
  std::string word = xml.word(parent, name);
  if (word.empty()) xml.fail(parent, "<{}> expected in <{}>, found none", name, parent.name());
  return word;
}

void append_text(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

std::string document_text(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

std::string chosen(pugi::xml_node parent, const char* name) {
  return body::OsimXml::first_element(parent.child(name)).name();
}

void note_unknown_elements(const body::OsimXml& xml,
                           pugi::xml_node root,
                           const ElementTable& table,
                           std::vector<Remark>& remarks) {
  struct Kind {
    UnknownElement first;
    std::size_t count = 0;
  };
  std::map<std::pair<std::string, std::string>, Kind> kinds;
  for (const UnknownElement& each : unknown_elements(root, table)) {
    Kind& kind = kinds[{each.parent.name(), each.element.name()}];
    if (kind.count++ == 0) kind.first = each;
  }
  for (const auto& [names, kind] : kinds) {
    remarks.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .where = xml.path().filename().string(),
         .about = names.second,
         .says = fmt::format("{}: <{}> has an element <{}>{}{}; it is not read", xml.place_of(kind.first.element),
                             names.first, names.second,
                             kind.first.nearest ? fmt::format(" (did you mean <{}>?)", *kind.first.nearest) : "",
                             kind.count > 1 ? fmt::format(", there and in {} more places", kind.count - 1) : "")});
  }
}

void note_reading(std::vector<Remark>& remarks,
                  const std::filesystem::path& path,
                  std::string says,
                  std::string about) {
  remarks.push_back({.code = RemarkCode::reading,
                     .severity = Severity::note,
                     .where = path.filename().string(),
                     .about = std::move(about),
                     .says = std::move(says)});
}

}  // namespace myoid::opensim
