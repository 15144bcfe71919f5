#pragma once

#include <filesystem>

#include "myoid/results/realtime/predictor.h"

namespace myoid::results {

/// The two readings of a run's numbers (docs/guide/verdicts.md#readings).
enum class Reading {
  person,                      ///< The person's numbers, whose intervals hold errors of geometry and sensors, too.
  geometry_and_sensors_exact,  ///< The numbers if moment arms, tendons and sensors were exact.
};

/// Reads the method torque of a finished run: parameters, covariance and gains from
/// parameters.json, muscles from the study, geometry from the study's model.
///
/// The covariance of the reading given geometry and sensors is that of the person, scaled in each unknown by the ratio
/// of the widths of both intervals (of logarithms, where the unknown is one): parameters.json holds one covariance.
///
/// `study`: the study file, if it is no longer where run.json says. Coordinates that the study does not name stay at
/// the model's default. Throws ReadError or InvalidInput for a folder without results of method torque, for a study
/// with measured resting torques or with `normalised`, and for a built-in arm whose length was measured from the
/// markers: a predictor would differ from the fit.
[[nodiscard]] Predictor read_predictor(const std::filesystem::path& results,
                                       const std::filesystem::path& study = {},
                                       Reading reading = Reading::person);

}  // namespace myoid::results
