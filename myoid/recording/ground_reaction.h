#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/time_series.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

struct GroundReactionOptions {
  Mat3 R_YG = Mat3::Identity();          ///< From the laboratory to the model's ground,
                                         ///< whose y points up.
  double least_force_n = kLeastForce_n;  ///< Below it force and torque are 0.
};

/// Force plates as OpenSim's external loads want them, on the analog clock: for plate k the columns
///
///   ground_force_k_vx vy vz [N]   ground_force_k_px py pz [m]   ground_torque_k_x y z [N m]
///
/// The plates' action on the person, whose sides `stand_plates` has found. Where a plate does not
/// bear the person all is 0, and the point goes straight from the last one before to the first one
/// after, so that no value is missing. Throws InvalidInput without plates.
[[nodiscard]] TimeSeries ground_reaction(const std::vector<ForcePlate>& plates,
                                         const GroundReactionOptions& options,
                                         std::vector<Repair>& repairs);

/// An ExternalLoads file that applies plate k to `bodies[k]` of the model, with `data_file` beside
/// it. An empty body leaves the plate out.
[[nodiscard]] std::string format_external_loads(const std::string& name,
                                                const std::vector<int>& plate_numbers,
                                                const std::vector<std::string>& bodies,
                                                const std::string& data_file);

}  // namespace myoid::recording
