#include "myoid/body/osim/osim_writer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "myoid/body/osim/osim_document.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

struct Edit {
  std::size_t at = 0;
  std::size_t length = 0;
  std::string text;
};

std::string text_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + format_number(value);
  return text;
}

/// Number of the object in its set; the set is the model's or, in old documents, the root's.
struct Place {
  bool in_model = true;
  std::ptrdiff_t number = 0;
};

std::optional<Place> place_of(const OsimXml& xml, const OsimChange& change) {
  for (const bool in_model : {true, false}) {
    const auto holder = in_model ? xml.root().child("Model") : xml.root();
    std::ptrdiff_t number = 0;
    for (const auto node : OsimXml::objects(holder.child(change.set.c_str()))) {
      if (OsimXml::name_of(node) == change.object) return Place{in_model, number};
      ++number;
    }
  }
  return std::nullopt;
}

pugi::xml_node object_at(const RawText& raw, const std::string& set, const Place& place) {
  const auto holder = place.in_model ? raw.root().child("Model") : raw.root();
  return OsimXml::objects(holder.child(set.c_str())).at(static_cast<std::size_t>(place.number));
}

/// Returns the blanks between a start tag and the next character: the indentation of the children.
std::string_view indentation(std::string_view text, std::size_t after) {
  const std::size_t next = std::min(text.find_first_not_of(kBlank, after), text.size());
  return next < text.size() && text[next] == '<' ? text.substr(after, next - after) : "";
}

/// Replaces the content of an element by `values`; blanks around it and comments before and after it stay.
Edit fill(const RawText& raw, pugi::xml_node element, const std::string& values) {
  const std::string_view text = raw.text();
  std::optional<std::size_t> first, last;
  for (const auto part : element.children()) {
    if (part.type() != pugi::node_pcdata) continue;
    const std::size_t begin = raw.offset(part);
    const std::size_t end = std::min(text.find('<', begin), text.size());
    const std::string_view inside = text.substr(begin, end - begin);
    if (inside.find_first_not_of(kBlank) == std::string_view::npos) continue;
    if (!first) first = begin + inside.find_first_not_of(kBlank);
    last = begin + inside.find_last_not_of(kBlank);
  }
  if (first) return {*first, *last - *first + 1, values};
  const StartTag tag = raw.start_tag(element);
  if (!tag.is_whole) return {tag.after, 0, values};
  return {tag.after - 2, 2, fmt::format(">{}</{}>", values, element.name())};
}

/// Adds an element that the object lacks.
Edit add(const RawText& raw, pugi::xml_node object, const std::string& property, const std::string& values) {
  const std::string element = fmt::format("<{}>{}</{}>", property, values, property);
  const StartTag tag = raw.start_tag(object);
  if (!tag.is_whole) return {tag.after, 0, std::string(indentation(raw.text(), tag.after)) + element};
  return {tag.after - 2, 2, fmt::format(">{}</{}>", element, object.name())};
}

std::string with_edits(std::string_view text, std::vector<Edit> edits, const std::filesystem::path& path) {
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.at < b.at; });
  std::string result;
  result.reserve(text.size() + 64 * edits.size());
  std::size_t done = 0;
  for (const Edit& e : edits) {
    if (e.at < done) throw ModelError(fmt::format("{}: one number is to be changed twice", path.string()));
    result += text.substr(done, e.at - done);
    result += e.text;
    done = e.at + e.length;
  }
  result += text.substr(done);
  return result;
}

}  // namespace

std::string changed_osim(std::string_view text,
                         const std::filesystem::path& path,
                         const std::vector<OsimChange>& changes) {
  const OsimXml xml(std::string(text), path);
  const RawText raw(xml.text(), path);
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const OsimChange& change = changes[i];
    for (const double value : change.values) {
      if (!std::isfinite(value)) {
        throw ModelError(
            fmt::format("<{}> of '{}': {} cannot be written to a model", change.property, change.object, value));
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (changes[k].set == change.set && changes[k].object == change.object &&
          changes[k].property == change.property) {
        throw ModelError(fmt::format("<{}> of '{}' is to be changed twice", change.property, change.object));
      }
    }
    const auto place = place_of(xml, change);
    if (!place) {
      throw ModelError(fmt::format("{}: there is no '{}' in <{}> to change", path.string(), change.object, change.set));
    }
    const auto object = object_at(raw, change.set, *place);
    const auto element = object.child(change.property.c_str());
    // An equal number keeps its digits, also one from <defaults>.
    if (element && xml.numbers(element) == change.values) continue;
    edits.push_back(element ? fill(raw, element, text_of(change.values))
                            : add(raw, object, change.property, text_of(change.values)));
  }
  return with_edits(xml.text(), std::move(edits), path);
}

}  // namespace myoid::body
