#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"

namespace myoid {

/// The lengths of a trial that stay in one person: between two markers of one body, and the forearm. Medians; lengths
/// that are short or change within the trial by more than the limits are left out.
struct TrialSize {
  std::string trial;
  std::map<std::string, double> lengths_m;
};
[[nodiscard]] TrialSize size_of(const model::BodyModel& model,
                                const std::string& trial,
                                const recording::MarkerSeries& markers);

/// Returns a warning if the lengths of two trials, at the median over all lengths, differ by more than the limit.
[[nodiscard]] std::optional<Remark> unlike_sizes(const std::vector<TrialSize>& trials);

}  // namespace myoid
