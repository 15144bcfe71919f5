#include "myoid/files/result_folder.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/files/atomic_file.h"

namespace myoid::recording {
namespace {

namespace fs = std::filesystem;

/// Returns "run" of "myoid run study.toml --out results".
std::string_view command_word(std::string_view command_line) {
  const std::size_t first = command_line.find(' ');
  if (first == std::string_view::npos) return {};
  return command_line.substr(first + 1, command_line.find(' ', first + 1) - first - 1);
}

void remove_empty(const std::vector<fs::path>& folders) {
  std::error_code ignored;
  for (const fs::path& folder : folders) {
    if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
  }
}

}  // namespace

void ResultFolder::make() {
  if (path_.empty()) throw InvalidInput("--out is empty; name the folder for the results");
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InvalidInput("{} is a file; --out must name a folder", path_.string());
  }
  for (fs::path part = path_; !part.empty() && !fs::exists(part, error); part = part.parent_path())
    made_.push_back(part);
  fs::create_directories(path_, error);
  if (error) {
    remove_empty(made_);
    throw InvalidInput("cannot create the folder {}: {}", path_.string(), error.message());
  }
}

ResultFolder::ResultFolder(fs::path folder, const std::string& command, bool overwrite, std::string_view unless_only)
    : path_(std::move(folder)) {
  make();
  try {
    lock_ = std::make_unique<FolderLock>(path_);
  } catch (...) {
    remove_empty(made_);
    throw;
  }
  const std::optional<FolderOwner>& dead = lock_->left_behind();
  const bool empty = !holds_content(path_, unless_only);
  const bool unfinished = dead && dead->from_empty && command_word(dead->command) == command_word(command);
  if (!overwrite && !empty && !unfinished) {
    throw InvalidInput("the folder {} is not empty; give --overwrite to write into it, or another --out",
                       path_.string());
  }
  const std::size_t swept = sweep_temporaries(path_);
  if (dead) {
    note_ = fmt::format("note: the folder {} is taken over from a command that did not finish ({}){}", path_.string(),
                        dead->sentence(), swept > 0 ? fmt::format("; {} half-written files are removed", swept) : "");
  }
  lock_->sign(command, empty || unfinished);
}

ResultFolder::ResultFolder(fs::path folder, const std::string& command)
    : path_(std::move(folder)), lock_(std::make_unique<FolderLock>(path_)) {
  lock_->sign(command, false);
}

ResultFolder::~ResultFolder() {
  lock_.reset();  // its file goes first, so that the folder can be empty
  remove_empty(made_);
}

void ResultFolder::finish() { lock_->finish(); }

}  // namespace myoid::recording
