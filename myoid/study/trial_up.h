#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/laboratory_up.h"

namespace myoid::study {

/// Value of [markers] up without a statement of the study: each file states its vertical, and a
/// file without one has the model's.
inline constexpr char kUpOfTheFile = 'a';

/// Returns [markers] up as a unit vector; empty: each file states its own.
[[nodiscard]] std::optional<Vec3> stated_up(char markers_up);

/// Returns up of a model: the axis of ground nearest to the direction against gravity; y for a model without gravity.
[[nodiscard]] Vec3 model_up(const body::BodyModel& model);

/// Returns the rotation that brings `up_L`, along an axis in either direction, onto `model_up`.
[[nodiscard]] Mat3 rotation_onto(const body::BodyModel& model, const Vec3& up_L);

/// Returns the cosine of the angle between `up` and the model's vertical after a fit of the markers at the model's
/// default pose to the first complete frame; empty if fewer than four markers are known.
[[nodiscard]] std::optional<double> upright(const body::BodyModel& model,
                                            const MarkerSeries& markers,
                                            const Vec3& up_L);

/// An axis of the laboratory, and `upright` by it.
struct UprightAxis {
  std::string name;  ///< "z", "-y".
  double cosine = 0.0;
};

/// Returns the axis by which all markers stand the most upright: `init` writes it, and `check` asks whether it differs
/// from the study's. Empty as `upright`. The first of equal axes wins.
[[nodiscard]] std::optional<UprightAxis> upright_axis(const body::BodyModel& model,
                                                      const MarkerSeries& markers,
                                                      const std::vector<std::string>& axes);

/// Returns up in the laboratory of a file of the study: [markers] up, else the file's statement,
/// else `model_up`. Throws ReadError if the file contradicts itself.
[[nodiscard]] recording::LaboratoryUp trial_up(char markers_up,
                                               const std::filesystem::path& file,
                                               const body::BodyModel& model);

/// Returns "laboratory turned from z up to y up (POINT:Y_SCREEN says that z points up; ...)", or "z
/// is up (...)" if the model's up is the same.
[[nodiscard]] std::string up_note(const recording::LaboratoryUp& up, const body::BodyModel& model);

}  // namespace myoid::study
