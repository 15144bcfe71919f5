#include "myoid/opensim/tool_folders.h"

#include <system_error>

#include "myoid/ground/core/error.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;

fs::path same_for_all(const fs::path& file) {
  std::error_code error;
  fs::path name = fs::weakly_canonical(fs::absolute(file), error);
  return error ? file.lexically_normal() : name;
}

}  // namespace

void ToolFolders::claim(const fs::path& file, const fs::path& setup) {
  const std::scoped_lock lock(mutex_);
  const auto [place, first] = owners_.try_emplace(same_for_all(file), setup);
  if (!first && place->second != setup)
    throw InvalidInput("{}: {} writes this file too; give the results of one of them another name, or --out FOLDER",
                       file.string(), place->second.string());
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  folders_.try_emplace(folder, folder, "run-tool", RecordTerms{.replaces_alike = true});
}

std::vector<std::string> ToolFolders::finish() {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> notes;
  for (auto& [folder, held] : folders_) {
    held.finish();
    for (std::string& note : held.take_notes()) notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace myoid::opensim
