#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace myoid::body {

/// Parses a document; throws ReadError with the line if the text is no XML.
void load_document(pugi::xml_document& document,
                   std::string_view text,
                   const std::filesystem::path& path,
                   pugi::xml_encoding encoding = pugi::encoding_auto);

/// The place of an element's start tag in the text.
struct StartTag {
  std::size_t name = 0;   ///< Place of its first letter.
  std::size_t after = 0;  ///< Place after its '>'.
  bool is_whole = false;  ///< <x/>: the start tag is the whole element.
};

/// The elements of a document by their places in the bytes, whatever the file's character set: the same
/// parser without conversion, so that its offsets count bytes. The text must outlive it.
class RawText {
 public:
  /// Throws ReadError if the text is no XML, ModelError for UTF-16.
  RawText(std::string_view text, const std::filesystem::path& path);
  [[nodiscard]] const pugi::xml_document& document() const { return document_; }
  [[nodiscard]] pugi::xml_node root() const { return document_.child("OpenSimDocument"); }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] std::size_t offset(pugi::xml_node node) const {
    return static_cast<std::size_t>(node.offset_debug()) + mark_;
  }
  [[nodiscard]] StartTag start_tag(pugi::xml_node element) const;
  /// Returns the place of the '<' of the end tag of an element that is not whole.
  [[nodiscard]] std::size_t end_tag(const StartTag& tag) const;

 private:
  std::string_view text_;
  std::size_t mark_ = 0;
  pugi::xml_document document_;
};

/// Returns the number of the line at a place of a text, counted from 1.
[[nodiscard]] std::size_t line_at(std::string_view text, std::size_t offset);

/// An OpenSim document with the elements that stand in files of their own (<ForceSet file="forces.xml"/>) in their
/// places. The text of a document without such elements stays byte for byte.
struct WholeDocument {
  /// A file whose text is part of the document.
  struct File {
    std::filesystem::path path;
    std::string text;
    int version = 0;  ///< Of its <OpenSimDocument>; 0 without one.
  };
  /// The text from `at` on, to the next piece, is that of a file from `from` on.
  struct Piece {
    std::size_t at = 0, file = 0, from = 0;
  };
  std::string text;
  std::deque<File> files;            ///< [0]: the document itself. Empty if no element stands in another file.
  std::vector<Piece> pieces;         ///< In the order of the text; none without other files.
  std::vector<std::string> found;    ///< A sentence for each file that is in another place than named.
  std::vector<std::string> ignored;  ///< A sentence for each element whose content a file replaces.

  /// Returns the piece at a place of the text; there must be files.
  [[nodiscard]] const Piece& piece_at(std::size_t offset) const;
};

/// Puts each element with an attribute `file` (other than empty or "Unassigned") in its place. The file is relative to
/// the document that names it, or to the outermost document; its root element gives attributes and content, whatever
/// the root's name. Throws ReadError with the line for a file that is missing (with the files that are there), holds
/// itself, or is no XML.
[[nodiscard]] WholeDocument whole_document(std::string text, const std::filesystem::path& path);

/// Returns the text of the file as a whole document.
[[nodiscard]] std::string read_whole_text(const std::filesystem::path& path);
/// Returns the other files that hold elements of the document in `path`; none if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& path);

}  // namespace myoid::body
