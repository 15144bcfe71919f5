#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// The label of the same place on the other side, told by a first or last "R", "L", "right" or
/// "left" that stands apart ("R.Knee", "RASI", "knee_r", "LeftHeel"); empty if there is none.
[[nodiscard]] std::optional<std::string> other_side(const std::string& label);

/// An error if the frame in which most markers were seen fits the model far better with left and
/// right labels exchanged: more than 40 mm rms as they are, and less than half of that, and less
/// than 40 mm, exchanged. Three pairs of labels are needed, else nothing is looked at.
[[nodiscard]] std::optional<Remark> exchanged_sides(const model::BodyModel& model,
                                                    const TrialSpec& trial,
                                                    const recording::MarkerSeries& markers,
                                                    const std::map<std::string, double>& weights);

}  // namespace myoid
