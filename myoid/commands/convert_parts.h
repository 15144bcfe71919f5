#pragma once

#include <string>
#include <vector>

#include "myoid/commands/convert.h"
#include "myoid/core/geometry.h"
#include "myoid/recording/recording.h"

namespace myoid::commands {

/// The rotation from the laboratory, whose vertical is up_L, to y up, followed by the turns of the
/// options about the axes, one after the other. Throws InvalidInput for a turn of another form.
[[nodiscard]] Mat3 rotation_of(const ConvertOptions& options, const Vec3& up_L);

/// Replaces blanks in names, which .trc cannot hold, by '_'; a repair says so.
void without_blanks(recording::MarkerSeries& markers, std::vector<recording::Repair>& repairs);

/// True if the file is a .sto or .mot.
[[nodiscard]] bool is_storage(const std::string& file);

/// The channels that have another clock than the first one's.
[[nodiscard]] std::vector<std::string> other_clocks(const recording::Recording& file);

/// The numbers of the force plates. Throws InvalidInput where the options give more or fewer bodies
/// than there are plates.
[[nodiscard]] std::vector<int> plate_numbers(const ConvertOptions& options,
                                             const recording::Recording& file);

/// An even clock at the options' rate over the time of the old one. Throws InvalidInput where that
/// makes no or too many samples.
[[nodiscard]] Eigen::VectorXd new_clock(const ConvertOptions& options, const Eigen::VectorXd& old);

}  // namespace myoid::commands
