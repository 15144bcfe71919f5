#include "myoid/body/osim/osim_xml.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_update_parts.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {

using ground::equal_ignoring_case;
using ground::parse_number;
using ground::split_words;
using ground::trim;

namespace {

/// Returns true if there is neither text nor an element inside.
bool is_empty(pugi::xml_node node) { return trim(node.text().get()).empty() && !OsimXml::first_element(node); }

/// Returns true for an attribute that OpenSim or XML itself gives a meaning.
bool is_known_attribute(std::string_view name) {
  constexpr std::string_view kKnown[] = {"name", "file", "type", "Version", "version", "xmlns"};
  return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown) ||
         name.find(':') != std::string_view::npos;
}

}  // namespace

OsimXml::OsimXml(std::string text, std::filesystem::path path, Root root)
    : path_(std::move(path)), whole_(whole_document(std::move(text), path_)) {
  load_document(document_, whole_.text, path_);
  root_ = document_.child("OpenSimDocument");
  if (!root_ && root == Root::any) root_ = document_;
  if (!root_) {
    throw ReadError(path_, 1, "expected <OpenSimDocument> as the root; this is not an OpenSim file");
  }
  version_ = root_.attribute("Version").as_int();
  repairs_ = whole_.found;
  ignored_ = whole_.ignored;
  list_attributes();
}

void OsimXml::list_attributes() {
  struct Unknown {
    pugi::xml_node first;
    std::size_t count = 0;
  };
  std::map<std::string, Unknown, std::less<>> unknown;
  for (pugi::xml_node node = document_.first_child(); node;) {
    for (const auto attribute : node.attributes()) {
      if (node.type() != pugi::node_element || is_known_attribute(attribute.name())) continue;
      Unknown& same = unknown[attribute.name()];
      if (same.count++ == 0) same.first = node;
    }
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && !node.next_sibling()) node = node.parent();
    node = node.next_sibling();
  }
  for (const auto& [name, where] : unknown) {
    const bool is_file = nearest_word(name, {"file"}).has_value();
    ignored_.push_back(
        fmt::format("{}: <{}> has an attribute '{}'{}; OpenSim and this program ignore it{}", place_of(where.first),
                    where.first.name(), name, is_file ? " (did you mean 'file'?)" : "",
                    where.count > 1 ? fmt::format(", there and in {} more places", where.count - 1) : ""));
  }
}

void OsimXml::remember_places() {
  for_each_element(document_, [&](pugi::xml_node node) {
    if (node.offset_debug() > 0) places_.emplace(node.hash_value(), static_cast<std::size_t>(node.offset_debug()));
  });
}

std::string OsimXml::tag_of(pugi::xml_node node) const {
  const auto place = places_.find(node.hash_value());
  if (place == places_.end() || whole_.text[place->second - 1] != '<') return node.name();
  return whole_.text.substr(place->second, whole_.text.find_first_of(" \t\r\n/>", place->second) - place->second);
}

std::size_t OsimXml::offset_of(pugi::xml_node where) const {
  // Elements made while upgrading an old document have no place in the text: the place of a parent serves.
  for (pugi::xml_node n = where; n; n = n.parent()) {
    if (const auto place = places_.find(n.hash_value()); place != places_.end()) return place->second;
    if (n.offset_debug() >= 0) return static_cast<std::size_t>(n.offset_debug());
  }
  return 0;
}

OsimXml::Place OsimXml::find(pugi::xml_node where) const {
  const std::size_t offset = offset_of(where);
  if (whole_.files.empty()) return {0, line_at(whole_.text, offset)};
  const WholeDocument::Piece& piece = whole_.piece_at(offset);
  return {piece.file, line_at(whole_.files[piece.file].text, piece.from + (offset - piece.at))};
}

int OsimXml::version(pugi::xml_node where) const {
  if (whole_.files.empty()) return version_;
  const int own = whole_.files[whole_.piece_at(offset_of(where)).file].version;
  return own == 0 ? version_ : own;
}

std::vector<std::filesystem::path> OsimXml::files() const {
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 1; k < whole_.files.size(); ++k) files.push_back(whole_.files[k].path);
  return files;
}

std::string OsimXml::place_of(pugi::xml_node where) const {
  const Place place = find(where);
  return place.file == 0 ? fmt::format("line {}", place.line)
                         : fmt::format("{}, line {}", whole_.files[place.file].path.string(), place.line);
}

void OsimXml::fail(pugi::xml_node where, const std::string& message) const {
  const Place place = find(where);
  throw ReadError(place.file == 0 ? path_ : whole_.files[place.file].path, place.line, message);
}

void OsimXml::set_prototypes(pugi::xml_node defaults) {
  for (const auto node : defaults.children()) prototypes_[node.name()] = node;
}

pugi::xml_node OsimXml::property(pugi::xml_node object, const char* name) const {
  if (const auto child = object.child(name); child && !is_empty(child)) return child;
  if (prototypes_.empty()) return {};
  const auto it = prototypes_.find(std::string_view(object.name()));
  return it == prototypes_.end() ? pugi::xml_node() : it->second.child(name);
}

pugi::xml_node OsimXml::value_of(pugi::xml_node object, const char* name) const {
  if (const auto own = object.child(name); own && is_empty(own)) {
    std::string sentence = fmt::format("{}: <{}> is empty; its default holds", place_of(own), tag_of(own));
    if (std::find(repairs_.begin(), repairs_.end(), sentence) == repairs_.end())
      repairs_.push_back(std::move(sentence));
  }
  return property(object, name);
}

std::string OsimXml::text_of(pugi::xml_node node) {
  std::string text = node.text().get();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return std::string(trim(text));
}

std::string OsimXml::word(pugi::xml_node object, const char* name) const { return text_of(property(object, name)); }

std::vector<std::string> OsimXml::words(pugi::xml_node object, const char* name) const {
  std::vector<std::string> result;
  const std::string text = word(object, name);
  for (const std::string_view w : split_words(text)) result.emplace_back(w);
  return result;
}

std::vector<double> OsimXml::numbers(pugi::xml_node node) const {
  std::vector<double> values;
  const std::string text = text_of(node);
  for (const std::string_view w : list_items(text)) {
    const auto value = parse_number(w);
    if (!value || std::isnan(*value)) fail(node, "<{}>: expected numbers, found '{}'", tag_of(node), w);
    values.push_back(*value);
  }
  return values;
}

double OsimXml::number(pugi::xml_node object, const char* name, double otherwise) const {
  const auto node = value_of(object, name);
  if (!node) return otherwise;
  const std::string_view text = trim(node.text().get());
  if (const auto value = parse_number(text); value && !std::isnan(*value)) return *value;
  const auto values = numbers(node);
  if (values.size() != 1) fail(node, "<{}>: expected one number, found {}", tag_of(node), values.size());
  return values[0];
}

Vec3 OsimXml::vec3(pugi::xml_node object, const char* name, const Vec3& otherwise) const {
  const auto node = value_of(object, name);
  if (!node) return otherwise;
  const auto values = numbers(node);
  if (values.size() != 3) fail(node, "<{}>: expected three numbers, found {}", tag_of(node), values.size());
  return {values[0], values[1], values[2]};
}

bool OsimXml::flag(pugi::xml_node object, const char* name, bool otherwise) const {
  const auto node = value_of(object, name);
  if (!node) return otherwise;
  const std::string text = text_of(node);
  if (text.empty()) return otherwise;
  if (equal_ignoring_case(text, "true") || text == "1") return true;
  if (equal_ignoring_case(text, "false") || text == "0") return false;
  fail(node, "<{}>: expected true or false, found '{}'", tag_of(node), text);
}

std::vector<pugi::xml_node> OsimXml::objects(pugi::xml_node set) {
  std::vector<pugi::xml_node> elements;
  for (const auto child : set.child("objects").children())
    if (child.type() == pugi::node_element) elements.push_back(child);
  return elements;
}

pugi::xml_node OsimXml::first_element(pugi::xml_node parent, std::initializer_list<const char*> except) {
  for (const auto child : parent.children()) {
    if (child.type() != pugi::node_element) continue;
    if (std::any_of(except.begin(), except.end(),
                    [&](const char* name) { return std::strcmp(child.name(), name) == 0; }))
      continue;
    return child;
  }
  return {};
}

std::vector<std::string_view> list_items(std::string_view text) {
  text = trim(text);
  if (text.starts_with('~')) text = trim(text.substr(1));
  const bool in_brackets =
      text.size() > 1 && ((text.front() == '(' && text.back() == ')') || (text.front() == '[' && text.back() == ']'));
  if (in_brackets) text = text.substr(1, text.size() - 2);
  if (text.find(',') == std::string_view::npos) return split_words(text);
  std::vector<std::string_view> items;
  for (const std::string_view item : split(text, ',')) items.push_back(trim(item));
  return items;
}

pugi::xml_node either_child(pugi::xml_node parent, const char* name, const char* other) {
  const auto child = parent.child(name);
  return child ? child : parent.child(other);
}

pugi::xml_node child_or_new(pugi::xml_node parent, const char* name) {
  const auto child = parent.child(name);
  return child ? child : parent.append_child(name);
}

void set_attribute(pugi::xml_node node, const char* name, const std::string& value) {
  auto attribute = node.attribute(name);
  (attribute ? attribute : node.append_attribute(name)).set_value(value.c_str());
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return lower;
}

}  // namespace myoid::body
