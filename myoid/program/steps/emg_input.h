#pragma once

#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/program/steps/emg.h"

namespace myoid::program {

/// Collects warnings until the end of the scope. A warning that several channels or files share is
/// given once. An exception that leaves the scope does not suppress the warnings.
class GroupedWarnings {
 public:
  explicit GroupedWarnings(Remarks& remarks) : remarks_(remarks) {}
  GroupedWarnings(const GroupedWarnings&) = delete;
  GroupedWarnings& operator=(const GroupedWarnings&) = delete;
  ~GroupedWarnings();

  /// Adds a warning about `where`, file and channel; warnings of equal code and `about` are joined.
  void add(RemarkCode code, std::string where, std::string about, std::string says);

 private:
  Remarks& remarks_;
  std::vector<Remark> found_;
};

/// Returns the inputs, then the maximal contractions.
[[nodiscard]] std::vector<std::string> emg_paths(const EmgOptions& options);

/// Returns the raw EMG of all these files, with the channels that all have and that can be filtered
/// and normalized. Other channels are left out with a warning. Throws ReadError if none remains, or
/// a requested channel does not, and for a file that is rectified and smoothed already.
[[nodiscard]] std::vector<TimeSeries> read_raw_emg(const EmgOptions& options, GroupedWarnings& warnings);

}  // namespace myoid::program
