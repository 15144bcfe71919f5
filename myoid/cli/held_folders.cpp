#include "myoid/cli/held_folders.h"

#include <memory>
#include <vector>

#include <fmt/format.h>

namespace myoid::cli {
namespace {

std::vector<std::unique_ptr<recording::FolderLock>>& held_folders() {
  static std::vector<std::unique_ptr<recording::FolderLock>> held;
  return held;
}

}  // namespace

recording::FolderLock& hold_folder(const std::filesystem::path& folder) {
  return *held_folders().emplace_back(std::make_unique<recording::FolderLock>(folder));
}

void finish_folders() {
  for (const auto& lock : held_folders()) lock->finish();
}

std::string contents_of_folders() {
  std::string text;
  for (const auto& lock : held_folders()) {
    const std::string folder = lock->folder().string();
    text += text.empty() ? "" : "; ";
    text +=
        recording::holds_content(lock->folder())
            ? fmt::format("every file in {} is whole, and the same command takes it over", folder)
            : fmt::format("nothing was written into {}", folder);
  }
  return text;
}

void release_folder(const std::filesystem::path& folder) {
  std::erase_if(held_folders(), [&](const auto& lock) { return lock->folder() == folder; });
}

}  // namespace myoid::cli
