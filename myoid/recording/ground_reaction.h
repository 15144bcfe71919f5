#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

struct GroundReactionOptions {
  Mat3 R_YG = Mat3::Identity();          ///< Turns the laboratory to the model's ground, whose y points up.
  double least_force_n = kLeastForce_n;  ///< Force and torque are 0 below it.
};

/// Returns force plates in the form of OpenSim's external loads, on the analog clock. Plate k has the columns
///
///   ground_force_k_vx vy vz [N]   ground_force_k_px py pz [m]   ground_torque_k_x y z [N m]
///
/// which hold its action on the person after `stand_plates`. Where a plate does not bear the
/// person, force and torque are 0, and the point moves straight from its last to its next position,
/// so that no value is missing. Throws InvalidInput without plates.
[[nodiscard]] TimeSeries ground_reaction(const std::vector<ForcePlate>& plates,
                                         const GroundReactionOptions& options,
                                         std::vector<Repair>& repairs);

/// Returns an ExternalLoads file that applies plate k to `bodies[k]` of the model, with `data_file`
/// beside it. An empty body leaves the plate out.
[[nodiscard]] std::string format_external_loads(const std::string& name,
                                                const std::vector<int>& plate_numbers,
                                                const std::vector<std::string>& bodies,
                                                const std::string& data_file);

}  // namespace myoid::recording
