#pragma once

#include <string>
#include <vector>

#include "myoid/commands/emg.h"
#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"

namespace myoid::commands {

/// Collects warnings until the end: one that several channels or files share is said
/// once. They are told although an exception leaves the scope.
class GroupedWarnings {
 public:
  explicit GroupedWarnings(Remarks& remarks) : remarks_(remarks) {}
  GroupedWarnings(const GroupedWarnings&) = delete;
  GroupedWarnings& operator=(const GroupedWarnings&) = delete;
  ~GroupedWarnings();

  /// `where` is the file and channel; warnings of one code and one matter (`about`) are alike.
  void add(RemarkCode code, std::string where, std::string about, std::string says);

 private:
  Remarks& remarks_;
  std::vector<Remark> found_;
};

/// The inputs, then the maximal contractions.
[[nodiscard]] std::vector<std::string> emg_paths(const EmgOptions& options);

/// The raw EMG of all these files, of the channels that all have and that can be filtered and
/// normalized; another one is left out with a warning. Throws ReadError where that leaves none, or
/// one that was asked for, and for a file that is rectified and smoothed already.
[[nodiscard]] std::vector<TimeSeries> read_raw_emg(const EmgOptions& options,
                                                   GroupedWarnings& warnings);

}  // namespace myoid::commands
