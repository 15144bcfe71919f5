#include "myoid/opensim/projects/project_files.h"

#include <algorithm>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 6, kMostParents = 8;
constexpr std::size_t kMostEntries = 20000;
constexpr std::uintmax_t kLargestDocument_bytes = std::uintmax_t{16} << 20U;

bool is_document(const fs::path& path) {
  const std::string ending = extension_of(path);
  return ending == ".xml" || ending == ".osimx";
}

/// Reads what an XML file is; a file that is none has no roots.
RootedFile rooted(const fs::path& path) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) > kLargestDocument_bytes) return {path, {}};
  try {
    return {path, root_elements(read_text_file(path))};
  } catch (const InvalidInput&) {
    return {path, {}};  // the reader of the file reports the fault, if the project names it
  }
}

}  // namespace

std::vector<std::string> root_elements(std::string_view text) {
  std::vector<std::string> names;
  std::size_t at = 0;
  while (names.size() < 2 && (at = text.find('<', at)) != std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    const std::string_view end = rest.starts_with("<!--") ? "-->" : rest.starts_with("<?") ? "?>" : ">";
    if (rest.size() > 1 && rest[1] == '/') break;
    if (rest.size() > 1 && rest[1] != '?' && rest[1] != '!')
      names.emplace_back(rest.substr(1, rest.find_first_of(" \t\r\n/>", 1) - 1));
    at = text.find(end, at + 1);
    if (at == std::string_view::npos) break;
    if (!names.empty() && text[at - 1] == '/') break;
  }
  return names;
}

ProjectFolder::ProjectFolder(const fs::path& path) : folder_(path) {
  if (!fs::is_directory(path)) {
    folder_ = path.parent_path();
    files_ = {path};
  } else {
    std::error_code ignored;
    std::size_t entries = 0;
    fs::recursive_directory_iterator entry(path, fs::directory_options::skip_permission_denied, ignored);
    for (; entry != fs::recursive_directory_iterator(); entry.increment(ignored)) {
      if (++entries > kMostEntries) {
        is_cut_ = true;
        break;
      }
      const bool is_hidden = entry->path().filename().string().starts_with('.');
      if (entry->is_directory(ignored) && (is_hidden || entry.depth() >= kDeepest)) entry.disable_recursion_pending();
      if (entry->is_regular_file(ignored)) files_.push_back(entry->path());
    }
    std::sort(files_.begin(), files_.end());
  }
  for (const fs::path& file : files_) {
    if (!is_document(file)) continue;
    RootedFile document = rooted(file);
    if (!document.roots.empty()) documents_.push_back(std::move(document));
  }
}

std::vector<RootedFile> ProjectFolder::with_root(std::string_view name) const {
  std::vector<RootedFile> found;
  for (const RootedFile& document : documents_)
    if (document.roots.front() == name) found.push_back(document);
  return found;
}

NamedFile ProjectFolder::find(const fs::path& document, std::string_view name) const {
  NamedFile found = find_named_file(document.parent_path(), name);
  if (found.exists || trim(name).empty()) return found;
  fs::path folder = fs::absolute(document).parent_path();
  for (int k = 0; k < kMostParents && folder.has_relative_path(); ++k) {
    folder = folder.parent_path();
    const fs::path named = native_path(folder, name);
    std::error_code ignored;
    if (!is_windows_path(name) && fs::is_regular_file(named, ignored)) return {named, true};
  }
  const std::string last = last_part(name);
  std::vector<fs::path> alike;
  for (const fs::path& file : files_)
    if (equal_ignoring_case(file.filename().string(), last)) alike.push_back(file);
  return alike.size() == 1 ? NamedFile{alike.front(), true} : found;
}

}  // namespace myoid::opensim
