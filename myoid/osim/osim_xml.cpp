#include "myoid/osim/osim_xml.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/document_limits.h"
#include "myoid/core/error.h"
#include "myoid/files/file_format.h"
#include "myoid/files/text_file.h"

namespace myoid::model {

using recording::equal_ignoring_case;
using recording::parse_number;
using recording::split_words;
using recording::trim;

namespace {

/// Returns true if there is neither text nor an element inside, nor a file that holds them.
bool is_empty(pugi::xml_node node) {
  return trim(node.text().get()).empty() && !OsimXml::first_element(node) && !node.attribute("file");
}

std::size_t line_at(std::string_view text, std::ptrdiff_t offset) {
  const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
  return static_cast<std::size_t>(1 + std::count(text.begin(), text.begin() + end, '\n'));
}

}  // namespace

OsimXml::OsimXml(std::string text, std::filesystem::path path, Root root)
    : text_(std::move(text)), path_(std::move(path)) {
  if (const auto fault = xml_fault(text_)) {
    throw ReadError(path_, line_at(text_, static_cast<std::ptrdiff_t>(fault->offset)), fault->message);
  }
  const auto parsed = document_.load_buffer(text_.data(), text_.size(), pugi::parse_default);
  if (!parsed) {
    using recording::FileFormat;
    const std::string other =
        recording::wrong_kind(path_, {FileFormat::model, FileFormat::set_up}, "a model (.osim) or a set-up (.xml)");
    if (!other.empty()) throw ReadError(path_, 0, other);
    throw ReadError(path_, line_at(text_, parsed.offset),
                    fmt::format("not valid XML: {}; the file may be cut off", parsed.description()));
  }
  root_ = document_.child("OpenSimDocument");
  if (!root_ && root == Root::any) root_ = document_;
  if (!root_) {
    throw ReadError(path_, 1, "expected <OpenSimDocument> as the root; this is not an OpenSim file");
  }
  version_ = root_.attribute("Version").as_int();
}

std::size_t OsimXml::line_of(pugi::xml_node where) const {
  // Elements made while upgrading an old document have no place in the text: the place of a parent serves.
  std::ptrdiff_t offset = where.offset_debug();
  for (pugi::xml_node n = where; offset < 0 && n; n = n.parent()) offset = n.offset_debug();
  return line_at(text_, offset);
}

void OsimXml::fail(pugi::xml_node where, const std::string& message) const {
  throw ReadError(path_, line_of(where), message);
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
    std::string sentence = fmt::format("line {}: <{}> is empty; its default holds", line_of(own), name);
    if (std::find(defaulted_.begin(), defaulted_.end(), sentence) == defaulted_.end())
      defaulted_.push_back(std::move(sentence));
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
  for (const std::string_view w : split_words(text)) {
    const auto value = parse_number(w);
    if (!value || std::isnan(*value)) fail(node, "<{}>: expected numbers, found '{}'", node.name(), w);
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
  if (values.size() != 1) fail(node, "<{}>: expected one number, found {}", name, values.size());
  return values[0];
}

Vec3 OsimXml::vec3(pugi::xml_node object, const char* name, const Vec3& otherwise) const {
  const auto node = value_of(object, name);
  if (!node) return otherwise;
  const auto values = numbers(node);
  if (values.size() != 3) fail(node, "<{}>: expected three numbers, found {}", name, values.size());
  return {values[0], values[1], values[2]};
}

bool OsimXml::flag(pugi::xml_node object, const char* name, bool otherwise) const {
  const auto node = value_of(object, name);
  if (!node) return otherwise;
  const std::string text = text_of(node);
  if (text.empty()) return otherwise;
  if (equal_ignoring_case(text, "true") || text == "1") return true;
  if (equal_ignoring_case(text, "false") || text == "0") return false;
  fail(node, "<{}>: expected true or false, found '{}'", name, text);
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

}  // namespace myoid::model
