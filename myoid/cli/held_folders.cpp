#include "myoid/cli/held_folders.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/files/folder_lock.h"

namespace myoid::cli {
namespace {

std::vector<std::unique_ptr<recording::ResultFolder>>& held_folders() {
  static std::vector<std::unique_ptr<recording::ResultFolder>> held;
  return held;
}

}  // namespace

void hold_folder(std::unique_ptr<recording::ResultFolder> folder) { held_folders().push_back(std::move(folder)); }

void finish_folders() {
  for (const auto& held : held_folders()) held->finish();
}

std::string contents_of_folders() {
  std::string text;
  for (const auto& held : held_folders()) {
    const std::string folder = held->path().string();
    text += text.empty() ? "" : "; ";
    text += recording::holds_content(held->path())
                ? fmt::format("every file in {} is whole, and the same command takes it over", folder)
                : fmt::format("nothing was written into {}", folder);
  }
  return text;
}

void release_folders() { held_folders().clear(); }

}  // namespace myoid::cli
