#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// Keeps results of inverse kinematics, the slow stage, in a folder between runs. An interrupted
/// run, or a run with other settings of later stages, continues from there. An entry is found by
/// the SHA-256 of everything it depends on (program as built, model, settings, the markers as
/// numbers), so it is never out of date. The folder's list (ground/files/result_record.h) holds the hash of each entry;
/// an entry with other bytes counts as absent. Several threads may use one store.
class StageStore {
 public:
  explicit StageStore(std::filesystem::path folder)
      : folder_(std::move(folder)), record_(folder_, "stages", {.replaces_changed = true}) {}

  /// Returns the stored result, to the last bit; empty if there is no entry, or a damaged one.
  [[nodiscard]] std::optional<body::IkResult> find(const std::string& key);
  /// Returns true if there is an entry whose bytes are not those that were kept.
  [[nodiscard]] bool is_damaged(const std::string& key) const;

  /// Keeps a result. Ignores a folder that cannot be written: the next run computes again.
  void keep(const std::string& key, const body::IkResult& result);

  /// Removes the entries that were neither found nor kept by this object.
  void remove_unused();

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& key) const;
  void mark_used(const std::string& key);

  std::filesystem::path folder_;
  RecordedFolder record_;
  std::mutex mutex_;
  std::set<std::string> used_;
};

/// Returns the fingerprint of all inputs of a trial's inverse kinematics, 64 hexadecimal digits.
[[nodiscard]] std::string ik_key(const study::Study& study, std::string_view model_text, const MarkerSeries& markers);

}  // namespace myoid::run
