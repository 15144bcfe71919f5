#include "myoid/body/osim/osim_document.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/document_limits.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/named_file.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kXmlBlank = " \t\r\n";
constexpr std::size_t kMostFiles = 1000, kMostBytes = std::size_t{1} << 28;
constexpr int kDeepestFile = 32;

/// Returns the position after the '>' of the tag whose name begins at `at`.
std::size_t after_tag(std::string_view text, std::size_t at) {
  char quote = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at + 1;
    }
  }
  return text.size();
}

/// Returns true if the text may hold an attribute `file`: most documents hold none and are parsed once.
bool may_name_files(std::string_view text) {
  constexpr std::string_view kFile = "file";
  for (auto at = text.find(kFile); at != std::string_view::npos; at = text.find(kFile, at + kFile.size())) {
    if (at == 0 || kXmlBlank.find(text[at - 1]) == std::string_view::npos) continue;
    const auto next = text.find_first_not_of(kXmlBlank, at + kFile.size());
    if (next != std::string_view::npos && text[next] == '=') return true;
  }
  return false;
}

/// Returns the file that an element names; empty if the element stands in its document.
std::string named_file_of(pugi::xml_node node) {
  const std::string file(trim(node.attribute("file").value()));
  return equal_ignoring_case(file, "Unassigned") ? std::string() : file;
}

/// Adds the outermost elements below `parent` that name a file, in the order of the text.
void collect_named(pugi::xml_node parent, std::vector<pugi::xml_node>& found) {
  for (pugi::xml_node node = parent.first_child(); node;) {
    const bool names = node.type() == pugi::node_element && !named_file_of(node).empty();
    if (names) found.push_back(node);
    if (!names && node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != parent && !node.next_sibling()) node = node.parent();
    node = node == parent ? pugi::xml_node() : node.next_sibling();
  }
}

pugi::xml_node first_element_of(pugi::xml_node parent) {
  for (const auto child : parent.children())
    if (child.type() == pugi::node_element && std::string_view(child.name()) != "defaults") return child;
  return {};
}

/// Builds the text of a document from the files that hold its parts.
class Assembly {
 public:
  WholeDocument run(std::string text, const fs::path& path) {
    whole_.files.push_back({path, std::move(text), 0});
    const RawText raw(whole_.files[0].text, path);
    whole_.files[0].version = raw.root().attribute("Version").as_int();
    chain_.push_back(canonical(path));
    copy(0, raw, raw.document(), 0, raw.text().size());
    if (whole_.files.size() == 1) return {std::move(whole_.files[0].text), {}, {}, {}, {}};
    return std::move(whole_);
  }

 private:
  static fs::path canonical(const fs::path& path) {
    std::error_code ignored;
    auto full = fs::weakly_canonical(path, ignored);
    return ignored ? path : full;
  }

  [[noreturn]] void refuse(std::size_t file, std::size_t offset, const std::string& message) const {
    throw ReadError(whole_.files[file].path, line_at(whole_.files[file].text, offset), message);
  }

  void append(std::size_t file, std::size_t from, std::string_view text) {
    if (text.empty()) return;
    if (whole_.text.size() + text.size() > kMostBytes)
      refuse(file, from, fmt::format("the files of this document have more than {} MB together", kMostBytes >> 20));
    whole_.pieces.push_back({whole_.text.size(), file, from});
    whole_.text += text;
  }

  /// Copies the bytes from `begin` to `end` with the elements below `parent` that stand in files.
  void copy(std::size_t file, const RawText& raw, pugi::xml_node parent, std::size_t begin, std::size_t end) {
    std::vector<pugi::xml_node> named;
    collect_named(parent, named);
    for (const auto node : named) {
      const StartTag tag = raw.start_tag(node);
      append(file, begin, raw.text().substr(begin, tag.name - 1 - begin));
      insert(file, raw, node, node.name());
      begin = tag.after;
      if (tag.is_whole) continue;
      begin = after_tag(raw.text(), raw.end_tag(tag));
      if (first_element_of(node)) {
        whole_.ignored.push_back(fmt::format(
            "{}, line {}: <{}> is in the file '{}'; the elements that stand inside it "
            "here are not read",
            whole_.files[file].path.string(), line_at(raw.text(), tag.name), node.name(), named_file_of(node)));
      }
    }
    append(file, begin, raw.text().substr(begin, end - begin));
  }

  /// Returns the place of the file that `node` names, beside its document or beside the outermost one.
  fs::path find(std::size_t file, const RawText& raw, pugi::xml_node node) {
    const std::string name = named_file_of(node);
    const fs::path folder = whole_.files[file].path.parent_path(), first = whole_.files[0].path.parent_path();
    NamedFile found = find_named_file(folder, name);
    if (!found.exists && folder != first) found = find_named_file(first, name);
    if (!found.exists) {
      refuse(file, raw.offset(node),
             fmt::format("<{}> is in the file '{}', and {}", node.name(), name, missing_file(folder, name)));
    }
    if (!found.note.empty()) whole_.found.push_back(fmt::format("<{}>: {}", node.name(), found.note));
    return found.path;
  }

  /// Appends the element of the file that `node` names, as an element of the name `tag_name`.
  void insert(std::size_t file, const RawText& raw, pugi::xml_node node, const std::string& tag_name) {
    const fs::path path = find(file, raw, node);
    const fs::path full = canonical(path);
    if (std::find(chain_.begin(), chain_.end(), full) != chain_.end()) {
      chain_.push_back(full);
      std::vector<std::string> names;
      for (const fs::path& link : chain_) names.push_back(link.filename().string());
      refuse(file, raw.offset(node), fmt::format("the files hold each other: {}", fmt::join(names, " -> ")));
    }
    if (static_cast<int>(chain_.size()) > kDeepestFile || whole_.files.size() > kMostFiles)
      refuse(file, raw.offset(node),
             fmt::format("more than {} files, or {} within each other, make this document", kMostFiles, kDeepestFile));
    const std::size_t inner = whole_.files.size();
    whole_.files.push_back({path, read_text_file(path), 0});
    const RawText other(whole_.files[inner].text, path);
    whole_.files[inner].version = other.root().attribute("Version").as_int();
    const auto top = first_element_of(other.root() ? other.root() : pugi::xml_node(other.document()));
    if (!top) refuse(inner, 0, fmt::format("expected a <{}>, found no element", tag_name));
    chain_.push_back(full);
    if (!named_file_of(top).empty()) {
      insert(inner, other, top, tag_name);
    } else {
      tell_other_class(node, tag_name, top, path);
      const StartTag tag = other.start_tag(top);
      const std::size_t behind_name = tag.name + std::string_view(top.name()).size();
      append(inner, tag.name, "<" + tag_name);
      append(inner, behind_name, other.text().substr(behind_name, tag.after - behind_name));
      if (!tag.is_whole) {
        const std::size_t end = other.end_tag(tag);
        copy(inner, other, top, tag.after, end);
        append(inner, end, "</" + tag_name + ">");
      }
    }
    chain_.pop_back();
  }

  /// Tells of a file whose root is of another class: "IKTaskSet" and "TaskSet" are one.
  void tell_other_class(pugi::xml_node node, std::string_view wanted, pugi::xml_node top, const fs::path& path) {
    const std::string_view own = top.name();
    if (wanted.ends_with(own) || own.ends_with(wanted)) return;
    whole_.ignored.push_back(fmt::format("{}: expected a <{}>, found a <{}>; its content is read as <{}>",
                                         path.string(), wanted, own, node.name()));
  }

  WholeDocument whole_;
  std::vector<fs::path> chain_;  ///< The documents that hold the present one, outermost first.
};

}  // namespace

void load_document(pugi::xml_document& document,
                   std::string_view text,
                   const fs::path& path,
                   pugi::xml_encoding encoding) {
  if (const auto fault = xml_fault(text)) throw ReadError(path, line_at(text, fault->offset), fault->message);
  const auto parsed = document.load_buffer(text.data(), text.size(), pugi::parse_default, encoding);
  if (parsed) return;
  using ground::FileFormat;
  const std::string other =
      wrong_kind(path, {FileFormat::model, FileFormat::set_up}, "a model (.osim) or a set-up (.xml)");
  if (!other.empty()) throw ReadError(path, 0, other);
  throw ReadError(path, line_at(text, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, parsed.offset))),
                  fmt::format("not valid XML: {}; the file may be cut off", parsed.description()));
}

RawText::RawText(std::string_view text, const fs::path& path) : text_(text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw ModelError(
        fmt::format("{}: a document in UTF-16 cannot be changed in place; save it as UTF-8", path.string()));
  }
  // The parser's offsets do not count the byte-order mark.
  if (text.starts_with("\xEF\xBB\xBF")) mark_ = 3;
  load_document(document_, text.substr(mark_), path, pugi::encoding_utf8);
}

StartTag RawText::start_tag(pugi::xml_node element) const {
  const std::size_t name = offset(element);
  const std::size_t after = after_tag(text_, name);
  return {name, after, text_[after - 2] == '/'};
}

std::size_t RawText::end_tag(const StartTag& tag) const {
  const auto skip = [&](std::size_t at, std::string_view end) {
    const auto found = text_.find(end, at);
    return found == std::string_view::npos ? text_.size() : found + end.size();
  };
  std::size_t at = tag.after;
  for (int depth = 1;;) {
    at = text_.find('<', at);
    if (at == std::string_view::npos) return text_.size();
    const std::string_view rest = text_.substr(at);
    if (rest.starts_with("<!--")) {
      at = skip(at + 4, "-->");
    } else if (rest.starts_with("<![CDATA[")) {
      at = skip(at, "]]>");
    } else if (rest.starts_with("<?")) {
      at = skip(at, "?>");
    } else if (rest.starts_with("</")) {
      if (--depth == 0) return at;
      at = after_tag(text_, at);
    } else {
      at = after_tag(text_, at);
      if (text_[at - 2] != '/') ++depth;
    }
  }
}

std::size_t line_at(std::string_view text, std::size_t offset) {
  const auto end = static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return static_cast<std::size_t>(1 + std::count(text.begin(), text.begin() + end, '\n'));
}

const WholeDocument::Piece& WholeDocument::piece_at(std::size_t offset) const {
  const auto next = std::upper_bound(pieces.begin(), pieces.end(), offset,
                                     [](std::size_t place, const Piece& piece) { return place < piece.at; });
  return next == pieces.begin() ? pieces.front() : *(next - 1);
}

WholeDocument whole_document(std::string text, const fs::path& path) {
  if (!may_name_files(text)) return {std::move(text), {}, {}, {}, {}};
  return Assembly().run(std::move(text), path);
}

std::string read_whole_text(const fs::path& path) { return whole_document(read_text_file(path), path).text; }

std::vector<fs::path> files_of(const fs::path& path) {
  std::vector<fs::path> files;
  try {
    const WholeDocument whole = whole_document(read_text_file(path), path);
    for (std::size_t k = 1; k < whole.files.size(); ++k) files.push_back(whole.files[k].path);
  } catch (const InvalidInput&) {
    // The reader reports the fault.
  }
  return files;
}

}  // namespace myoid::body
