#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "myoid/core/geometry.h"
#include "myoid/recording/laboratory_up.h"

namespace myoid::pipeline {

/// [markers] up where the study does not say it: each file tells, and y where the file does not.
inline constexpr char kUpOfTheFile = 'a';

/// [markers] up as a unit vector; empty where each file tells.
[[nodiscard]] std::optional<Vec3> stated_up(char markers_up);

/// Up in the laboratory of a file of the study: [markers] up, else as the file says, else y. Throws
/// ReadError where the file contradicts itself.
[[nodiscard]] recording::LaboratoryUp trial_up(char markers_up, const std::filesystem::path& file);

/// "the laboratory is turned from z up to y up (POINT:Y_SCREEN says that z points up; ...)".
[[nodiscard]] std::string up_note(const recording::LaboratoryUp& up);

}  // namespace myoid::pipeline
