#include "myoid/ground/core/document_limits.h"

#include <fmt/format.h>

namespace myoid::inline ground {
namespace {

std::optional<DocumentFault> too_large(std::string_view text) {
  if (text.size() <= kLargestDocument_bytes) return std::nullopt;
  return DocumentFault{0, fmt::format("the document has {} MB; expected at most {} MB: numbers of a recording belong "
                                      "into a table (.sto, .csv)",
                                      text.size() >> 20U, kLargestDocument_bytes >> 20U)};
}

DocumentFault too_deep(std::size_t offset) {
  return {offset,
          fmt::format("elements nest more than {} deep; no model, set-up or result does, so the file is damaged",
                      kDeepestNesting)};
}

/// Returns the offset behind a section that ends with `end`; the end of the text where it does not end.
std::size_t behind(std::string_view text, std::size_t from, std::string_view end) {
  const std::size_t at = text.find(end, from);
  return at == std::string_view::npos ? text.size() : at + end.size();
}

/// Returns the offset of the '>' that ends a tag; the end of the text where the tag does not end.
std::size_t end_of_tag(std::string_view text, std::size_t at) {
  for (char quote = '\0'; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      break;
    }
  }
  return at;
}

}  // namespace

std::optional<DocumentFault> json_fault(std::string_view text) {
  if (auto fault = too_large(text)) return fault;
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted) {
      if (c == '\\') ++at;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestNesting) return too_deep(at);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return std::nullopt;
}

std::optional<DocumentFault> xml_fault(std::string_view text) {
  if (auto fault = too_large(text)) return fault;
  std::size_t depth = 0;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = behind(text, at + 4, "-->");
    } else if (rest.starts_with("<![CDATA[")) {
      at = behind(text, at + 9, "]]>");
    } else if (rest.starts_with("<?")) {
      at = behind(text, at + 2, "?>");
    } else if (rest.starts_with("</")) {
      if (depth > 0) --depth;
      at = behind(text, at, ">");
    } else if (rest.starts_with("<!")) {
      at += 2;
    } else {
      const std::size_t end = end_of_tag(text, at);
      const bool empty = end > at && end < text.size() && text[end - 1] == '/';
      if (!empty && ++depth > kDeepestNesting) return too_deep(at);
      at = end;
    }
  }
  return std::nullopt;
}

}  // namespace myoid::inline ground
