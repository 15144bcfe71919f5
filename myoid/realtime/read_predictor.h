#pragma once

#include <filesystem>

#include "myoid/realtime/predictor.h"

namespace myoid {

/// Reads the method torque of a finished run: parameters, covariance and gains from
/// parameters.json, muscles from the study, geometry from the study's model.
///
/// `study`: the study file, if it is no longer where run.json says. Coordinates that the study does not name stay at
/// the model's default. Throws ReadError or InvalidInput for a folder without results of method torque, for a study
/// with measured resting torques or with `normalised`, and for a built-in arm whose length was measured from the
/// markers: a predictor would differ from the fit.
[[nodiscard]] Predictor read_predictor(const std::filesystem::path& results, const std::filesystem::path& study = {});

}  // namespace myoid
