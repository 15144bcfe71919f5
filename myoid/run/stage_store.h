#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "myoid/files/marker_series.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/study/study.h"

namespace myoid {

/// Keeps results of inverse kinematics, the slow stage, in a folder between runs. An interrupted
/// run, or a run with other settings of later stages, continues from there. An entry is found by
/// the SHA-256 of everything it depends on (program as built, model, settings, the markers as
/// numbers), so it is never out of date; a damaged entry counts as absent. Several
/// threads may use one store.
class StageStore {
 public:
  explicit StageStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns the stored result, to the last bit; empty if there is no readable entry.
  [[nodiscard]] std::optional<kinematics::IkResult> find(const std::string& key);

  /// Keeps a result. Ignores a folder that cannot be written: the next run computes again.
  void keep(const std::string& key, const kinematics::IkResult& result);

  /// Removes the entries that were neither found nor kept by this object.
  void remove_unused();

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& key) const;
  void mark_used(const std::string& key);

  std::filesystem::path folder_;
  std::mutex mutex_;
  std::set<std::string> used_;
};

/// Returns the fingerprint of all inputs of a trial's inverse kinematics, 64 hexadecimal digits.
[[nodiscard]] std::string ik_key(const Study& study,
                                 std::string_view model_text,
                                 const recording::MarkerSeries& markers);

}  // namespace myoid
