#pragma once

#include <string>

#include "myoid/recording/tables/storage_reader.h"

namespace myoid::recording {

/// Returns the unit of a channel in a series that a run writes (`ik.mot`, `id.sto`,
/// `MuscleAnalysis_Length.sto`, ...), by the name of the file without its ending: "deg" or "rad",
/// "m", "m/s", "m^2", "N", "N m", "1" for an activation. Empty: the name is none of these.
[[nodiscard]] std::string result_unit(const std::string& series, const std::string& channel, bool in_degrees);

/// Returns true for the name of a column, or the title of a file, that speaks of another quantity than an angle: a
/// force, a speed, an activation, EMG, ...
[[nodiscard]] bool names_other_quantity(const std::string& name);

/// Returns true if a file may hold angles: neither its title nor all of its channels speak of forces, speeds or EMG,
/// and its columns are not all vectors (NAMEx, NAMEy, NAMEz). The header `inDegrees=yes` stands in files of forces,
/// too.
[[nodiscard]] bool may_hold_angles(const Storage& file);

/// Returns true if a column of a file whose header says `inDegrees=yes` is an angle in degrees: the file may hold
/// angles, and the name is neither that of a translation (`pelvis_tx`) nor of a force or an EMG channel.
[[nodiscard]] bool is_angle_in_degrees(const Storage& file, const std::string& channel);

}  // namespace myoid::recording
