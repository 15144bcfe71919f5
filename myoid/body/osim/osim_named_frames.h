#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// A body, or a frame fixed to a body, in a model file.
struct NamedFrame {
  std::string path;  ///< "/bodyset/pelvis", "/bodyset/pelvis/pelvis_imu"
  std::string body;  ///< The body that the frame moves with.
  Pose X_BF{};
};

/// Bodies and offset frames of a model file by their names. Of several with one name: the body,
/// else the first by path. Throws ReadError as parse_osim.
[[nodiscard]] std::map<std::string, NamedFrame> named_frames(std::string_view text, const std::filesystem::path& path);

/// A sensor's frame to place on a body or a frame of a model.
struct SensorPlace {
  std::string name;                ///< "pelvis_imu"
  NamedFrame carrier;              ///< The frame that holds the sensor.
  Vec3 p = Vec3::Zero();           ///< Origin of the sensor in the carrier [m].
  Vec3 angles_rad = Vec3::Zero();  ///< Axes of the sensor in the carrier: body-fixed X-Y-Z angles.
};

/// Returns the text of a model of the newest form (osim_updater.h) with these frames. An offset
/// frame of the sensor's name gets the new orientation; otherwise a frame with an IMU is added.
[[nodiscard]] std::string with_sensors(std::string_view text,
                                       const std::filesystem::path& path,
                                       const std::vector<SensorPlace>& sensors);

}  // namespace myoid::body
