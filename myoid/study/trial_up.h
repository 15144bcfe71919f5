#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "myoid/core/geometry.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/recording/laboratory_up.h"

namespace myoid {

/// [markers] up where the study does not say it: each file tells, and where the file does not, its
/// laboratory is the model's.
inline constexpr char kUpOfTheFile = 'a';

/// [markers] up as a unit vector; empty where each file tells.
[[nodiscard]] std::optional<Vec3> stated_up(char markers_up);

/// Up of a model: the axis of ground that lies nearest to the direction against gravity; y of a
/// model without gravity.
[[nodiscard]] Vec3 model_up(const model::BodyModel& model);

/// The rotation that brings `up_L`, along an axis and either way, onto `model_up`.
[[nodiscard]] Mat3 rotation_onto(const model::BodyModel& model, const Vec3& up_L);

/// Returns the cosine of the angle between `up` and the vertical of the model, whose markers at
/// its default pose are laid on the first complete frame; empty if fewer than four markers are
/// known.
[[nodiscard]] std::optional<double> upright(const model::BodyModel& model,
                                            const recording::MarkerSeries& markers,
                                            const Vec3& up_L);

/// Up in the laboratory of a file of the study: [markers] up, else as the file says, else
/// `model_up`. Throws ReadError where the file contradicts itself.
[[nodiscard]] recording::LaboratoryUp trial_up(char markers_up,
                                               const std::filesystem::path& file,
                                               const model::BodyModel& model);

/// "laboratory turned from z up to y up (POINT:Y_SCREEN says that z points up; ...)", or "z is up
/// (...)" where the model's up is the same.
[[nodiscard]] std::string up_note(const recording::LaboratoryUp& up, const model::BodyModel& model);

}  // namespace myoid
