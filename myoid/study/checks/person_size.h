#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::study {

/// The lengths of a trial that stay in one person: between two markers of one body, and the forearm. Medians; lengths
/// that are short or change within the trial by more than the limits are left out.
struct TrialSize {
  std::string trial;
  std::map<std::string, double> lengths_m;
};
[[nodiscard]] TrialSize size_of(const body::BodyModel& model, const std::string& trial, const MarkerSeries& markers);

/// Returns a warning if the lengths of two trials, at the median over all lengths, differ by more than the limit.
[[nodiscard]] std::optional<Remark> unlike_sizes(const std::vector<TrialSize>& trials);

}  // namespace myoid::study
