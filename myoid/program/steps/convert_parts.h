#pragma once

#include <string>
#include <vector>

#include "myoid/ground/core/geometry.h"
#include "myoid/program/steps/convert.h"
#include "myoid/recording/recording.h"

namespace myoid::program {

/// Returns the rotation from the laboratory, whose vertical is up_L, to y up, followed by the turns
/// of the options about the axes in order. Throws InvalidInput for a turn of another form.
[[nodiscard]] Mat3 rotation_of(const ConvertOptions& options, const Vec3& up_L);

/// Replaces blanks in names, which .trc cannot hold, by '_', and adds a repair.
void without_blanks(MarkerSeries& markers, std::vector<Repair>& repairs);

/// Returns true if the file is a .sto or .mot.
[[nodiscard]] bool is_storage(const std::string& file);

/// Returns the channels whose clock differs from the first channel's.
[[nodiscard]] std::vector<std::string> other_clocks(const recording::Recording& file);

/// Returns the numbers of the force plates. Throws InvalidInput unless the options give one body for each plate.
[[nodiscard]] std::vector<int> plate_numbers(const ConvertOptions& options, const recording::Recording& file);

/// Returns an even clock at the options' rate over the time of the old one. Throws InvalidInput if
/// the clock would have no or too many samples.
[[nodiscard]] Eigen::VectorXd new_clock(const ConvertOptions& options, const Eigen::VectorXd& old);

}  // namespace myoid::program
