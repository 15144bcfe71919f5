#pragma once

#include <map>
#include <optional>
#include <string>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the label of the same place on the other side. The side is a first or last "R", "L", "right" or "left" that
/// stands apart ("R.Knee", "RASI", "knee_r", "LeftHeel"); empty if there is none.
[[nodiscard]] std::optional<std::string> other_side(const std::string& label);

/// Returns an error if the frame with the most markers fits the model far better with left and right labels exchanged:
/// rms above 40 mm as labelled, and less than half of that and less than 40 mm exchanged. Needs three pairs of labels.
[[nodiscard]] std::optional<Remark> exchanged_sides(const body::BodyModel& model,
                                                    const TrialSpec& trial,
                                                    const MarkerSeries& markers,
                                                    const std::map<std::string, double>& weights);

/// Returns an error if that frame lies more than 40 mm rms from the model, and less than half of that and less than
/// 40 mm with another axis of the laboratory up, or as its mirror image. `up_L` is the axis by which the markers were
/// turned on reading. Needs two segments with three markers or more each.
[[nodiscard]] std::optional<Remark> turned_markers(const body::BodyModel& model,
                                                   const TrialSpec& trial,
                                                   const MarkerSeries& markers,
                                                   const Vec3& up_L,
                                                   const std::map<std::string, double>& weights);

}  // namespace myoid::study
