#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// The measured forces on bodies of one trial: of an OpenSim ExternalLoads file, or of a load cell
/// whose instrument (a model of its own) follows its markers in `markers`, in the laboratory of the
/// model. Empty if the trial names neither. `remember` is told every file that was read; `remarks`
/// get notes on the reading. Throws ReadError or InvalidInput: a body, channel or marker that is
/// not there, a matrix that is not 6 x 6, loads that do not cover the trial.
[[nodiscard]] std::optional<dynamics::ExternalLoads> read_trial_loads(
    const Study& study,
    const TrialSpec& trial,
    const model::BodyModel& model,
    const std::optional<recording::MarkerSeries>& markers,
    const std::function<void(const std::filesystem::path&)>& remember,
    std::vector<Remark>& remarks);

}  // namespace myoid
