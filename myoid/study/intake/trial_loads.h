#pragma once

#include <optional>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/intake/trial_clock.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Reads the measured forces on bodies in one trial, in the laboratory of the model: from an
/// OpenSim ExternalLoads file, or from a load cell whose instrument (a model of its own) follows
/// its markers in `markers`. Empty if the trial names neither. `remember` receives every file that
/// was read; `remarks` get notes on the reading. Throws ReadError or InvalidInput for an unknown
/// body, channel or marker, a matrix that is not 6 x 6, and loads that do not cover the trial.
[[nodiscard]] std::optional<body::ExternalLoads> read_trial_loads(const Study& study,
                                                                  const TrialSpec& trial,
                                                                  const body::BodyModel& model,
                                                                  const std::optional<MarkerSeries>& markers,
                                                                  const Remember& remember,
                                                                  std::vector<Remark>& remarks);

}  // namespace myoid::study
