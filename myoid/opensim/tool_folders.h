#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "myoid/ground/files/result_record.h"

namespace myoid::opensim {

/// The folders into which runs of OpenSim's tools write, each held once, and the files that the runs claim there. Runs
/// on several threads may share one object.
class ToolFolders {
 public:
  /// Holds the folder of a result, and remembers that the set-up writes this file. Throws InvalidInput if another
  /// set-up of these runs writes it.
  void claim(const std::filesystem::path& file, const std::filesystem::path& setup);
  /// States that the results are complete. Returns sentences on files that were kept or moved aside.
  [[nodiscard]] std::vector<std::string> finish();

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, RecordedFolder> folders_;
  std::map<std::filesystem::path, std::filesystem::path> owners_;  ///< The set-up of each claimed file.
};

}  // namespace myoid::opensim
