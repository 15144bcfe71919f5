#include "myoid/cli/held_folders.h"

#include <memory>
#include <vector>

namespace myoid::cli {

recording::FolderLock& hold_folder(const std::filesystem::path& folder) {
  static std::vector<std::unique_ptr<recording::FolderLock>> held;
  return *held.emplace_back(std::make_unique<recording::FolderLock>(folder));
}

}  // namespace myoid::cli
