#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/geometry.h"

namespace myoid::model {

/// A body, or a frame fixed to one, as a model file has it.
struct NamedFrame {
  std::string path;  ///< "/bodyset/pelvis", "/bodyset/pelvis/pelvis_imu"
  std::string body;  ///< That it moves with.
  Pose X_BF{};
};

/// Bodies and offset frames of a model file, by their own names; of one name twice the body, else
/// the first by its path. Throws ReadError as parse_osim.
[[nodiscard]] std::map<std::string, NamedFrame> named_frames(std::string_view text,
                                                             const std::filesystem::path& path);

/// A sensor's frame to place on a body or a frame of a model.
struct SensorPlace {
  std::string name;                ///< "pelvis_imu"
  NamedFrame carrier;              ///< What it is fixed to.
  Vec3 p = Vec3::Zero();           ///< Its origin in the carrier [m].
  Vec3 angles_rad = Vec3::Zero();  ///< Its axes in the carrier: body-fixed X-Y-Z angles.
};

/// The text of a model of the newest form (osim_updater.h) with these frames: an offset frame of
/// the name that is there gets the new orientation, another is added with an IMU on it.
[[nodiscard]] std::string with_sensors(std::string_view text,
                                       const std::filesystem::path& path,
                                       const std::vector<SensorPlace>& sensors);

}  // namespace myoid::model
