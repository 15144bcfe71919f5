#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/files/named_file.h"

namespace myoid::opensim {

/// An XML file, told by its content.
struct RootedFile {
  std::filesystem::path path;
  std::vector<std::string> roots;  ///< The names of the outermost element and of the first one inside it.
};

/// Returns the names of the outermost element and of the first element inside it; of a text that is cut off, as many
/// as there are. The text need not be valid. Declarations and comments may stand before.
[[nodiscard]] std::vector<std::string> root_elements(std::string_view text);

/// The files in and below a folder.
class ProjectFolder {
 public:
  /// Lists a folder to a depth of 6 and at most 20,000 entries; links to folders and hidden folders are passed over.
  /// For a file the list holds that file alone.
  explicit ProjectFolder(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// All files, by name.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  /// XML files (.xml, .osimx), by name.
  [[nodiscard]] const std::vector<RootedFile>& documents() const { return documents_; }
  /// True if the folder has more entries than are listed.
  [[nodiscard]] bool is_cut() const { return is_cut_; }

  /// Returns the documents with this outermost element.
  [[nodiscard]] std::vector<RootedFile> with_root(std::string_view name) const;
  /// Finds the file that a document names: as `find_named_file` from the document's folder, then from each folder above
  /// it, for names may be relative to the folder of the program; then the only listed file of that name.
  [[nodiscard]] NamedFile find(const std::filesystem::path& document, std::string_view name) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  std::vector<RootedFile> documents_;
  bool is_cut_ = false;
};

}  // namespace myoid::opensim
