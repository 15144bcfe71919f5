#pragma once

#include <optional>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Warns of markers that lie more than 4 cm rms from the model's after inverse kinematics (`marker_misfit`), with the
/// setting that lets the trunk of the built-in arm move.
[[nodiscard]] std::optional<Remark> far_markers(const Study& study,
                                                const TrialSpec& trial,
                                                const body::BodyModel& model,
                                                const MarkerSeries& markers,
                                                const body::IkResult& solved);

/// Solves inverse kinematics in a few frames that are spread over a trial, and warns as the gates of `run` do
/// (GateLimits::marker_error_m). Throws as `inverse_kinematics` and `trial_model`. Empty without markers.
[[nodiscard]] std::optional<Remark> distant_markers(const Study& study,
                                                    const TrialSpec& trial,
                                                    const body::BodyModel& model,
                                                    const TrialInput& input);

}  // namespace myoid::study
