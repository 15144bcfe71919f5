#include "myoid/ground/files/result_folder.h"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

namespace myoid::inline ground {
namespace {

namespace fs = std::filesystem;

/// Returns "run" of "myoid run study.toml --out results".
std::string_view command_word(std::string_view command_line) {
  const std::size_t first = command_line.find(' ');
  if (first == std::string_view::npos) return {};
  return command_line.substr(first + 1, command_line.find(' ', first + 1) - first - 1);
}

void remove_empty(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders)
    if (rmdir(folder.c_str()) != 0) return;
}

}  // namespace

bool is_of_earlier_version(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / kRecordFile, ignored)) return false;
  const auto says = [&](const char* name, std::initializer_list<std::string_view> words) {
    std::ifstream stream(folder / name);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    return std::ranges::all_of(words, [&](std::string_view word) { return text.find(word) != std::string::npos; });
  };
  return says("run.json", {"\"program\": \"myoid\""}) || says("parameters.json", {"\"program\": \"myoid\""}) ||
         says("simulation.json", {"\"program\": \"myoid\""}) || says("outcome.json", {"\"outcome\"", "\"build\""});
}

void require_results(const fs::path& folder, std::string_view name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return;
  std::vector<fs::path> inside;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (std::error_code none; fs::exists(it->path() / name, none)) inside.push_back(it->path());
  std::ranges::sort(inside);
  throw ReadError(folder, 0,
                  fmt::format("holds no results ({}); {}", name,
                              inside.empty() ? "run the study (myoid run) and give its folder"
                                             : fmt::format("did you mean {}?", inside.front().string())));
}

void require_results_place(const fs::path& folder) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(folder, ignored);
  if (!whole.empty() && whole == whole.root_path())
    throw InvalidInput("--out {} is the root of the file system; name a folder for the results, as in --out results",
                       folder.string());
}

void ResultFolder::make() {
  if (path_.empty()) throw InvalidInput("--out is empty; name the folder for the results");
  require_results_place(path_);
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
  lock(command, std::string(command_word(command)), overwrite, false, unless_only);
}

ResultFolder::ResultFolder(fs::path folder, const std::string& command, std::string word, bool overwrite)
    : path_(std::move(folder)) {
  lock(command, word, overwrite, true, "");
}

void ResultFolder::lock(
    const std::string& command, const std::string& word, bool overwrite, bool continues, std::string_view unless_only) {
  make();
  try {
    lock_ = std::make_unique<FolderLock>(path_);
  } catch (...) {
    remove_empty(made_);
    throw;
  }
  const std::optional<FolderOwner>& dead = lock_->left_behind();
  record_ = std::make_unique<RecordedFolder>(
      path_, word, RecordTerms{.earlier_version = is_of_earlier_version(path_), .alone = true});
  const bool own = record_->is_signed_by(word);
  const bool empty = !holds_content(path_, unless_only);
  const bool unfinished = dead && dead->from_empty && command_word(dead->command) == command_word(command);
  if (!overwrite && !empty && !unfinished && !(continues && own)) {
    throw InvalidInput("the folder {} is not empty; give --overwrite to write into it, or another --out",
                       path_.string());
  }
  const std::size_t swept = dead || record_->is_signed() ? sweep_temporaries(path_) : 0;
  if (dead) {
    note_ = fmt::format("note: the folder {} is taken over from a command that did not finish ({}){}", path_.string(),
                        dead->sentence(), swept > 0 ? fmt::format("; {} half-written files are removed", swept) : "");
  }
  lock_->sign(command, empty || unfinished);
}

ResultFolder::~ResultFolder() {
  record_.reset();
  lock_.reset();  // its file goes first, so that the folder can be empty
  remove_empty(made_);
}

void ResultFolder::finish() {
  record_->finish();
  lock_->finish();
}

}  // namespace myoid::inline ground
