#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace myoid::inline ground {

/// Limits of a document (JSON, XML) that a parser turns into a tree: the tree takes up to 13 times the bytes of the
/// text, and programs walk a tree by calls that nest as its elements do. Models, set-ups and results nest to 20.
inline constexpr std::size_t kLargestDocument_bytes = std::size_t{128} << 20U;
inline constexpr std::size_t kDeepestNesting = 200;

/// The reason why a text may not be parsed, with its place in the text.
struct DocumentFault {
  std::size_t offset = 0;  ///< In bytes.
  std::string message;
};

/// Returns the fault of a JSON text whose arrays and objects nest too deep, or which is too large. One pass; the text
/// need not be valid.
[[nodiscard]] std::optional<DocumentFault> json_fault(std::string_view text);

/// Returns the fault of an XML text whose elements nest too deep, or which is too large. One pass; the text need not be
/// valid. Comments, CDATA sections, processing instructions and quoted attributes hold no elements.
[[nodiscard]] std::optional<DocumentFault> xml_fault(std::string_view text);

}  // namespace myoid::inline ground
