#pragma once

#include <array>
#include <optional>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/study/intake/body_points.h"

namespace myoid::study {

/// One force on the ground in one frame. Distances are those of its center of pressure [m], infinite where the frame
/// shows no point of a body.
struct GroundContact {
  Vec3 force_n = Vec3::Zero();
  Vec3 center_m = Vec3::Zero();  ///< Center of pressure, in ground.
  std::vector<double> near_m;    ///< From each body with its neighbors across a joint.
  std::vector<double> alone_m;   ///< From each body alone.
  std::array<double, 4>
      turned_m{};  ///< From the force's body after turns by 0, 90, 180, 270 degrees about the vertical.
};

/// One frame of a trial.
struct ContactFrame {
  double time_s = 0.0;                           ///< On the clock of the motion.
  std::vector<std::optional<GroundContact>> of;  ///< Per force; empty where it is not loaded.
  std::vector<std::optional<Vec3>> lowest_m;     ///< Lowest point of each body.
  std::vector<double> speed_mps;                 ///< Speed of this point; infinite where it is unknown.
};

/// A force on a body, measured in ground.
struct ContactForce {
  const body::ExternalForce* force = nullptr;
  double largest_n = 0.0;  ///< Its largest value, positive.
};

/// The contacts of a trial with the ground, at 1500 frames or all.
struct ContactTable {
  std::vector<ContactForce> forces;
  std::vector<ContactFrame> frames;
  Vec3 up = Vec3::UnitY();  ///< Against gravity.
};

/// Returns the contacts of all forces whose center of pressure the loads define: the point of a force, or, for a
/// plate's force about the middle of its surface, the point in the horizontal plane through that middle where the
/// moment has no horizontal part. A force is loaded from a twentieth of its largest value on. Model and loads must
/// outlive the table.
[[nodiscard]] ContactTable contact_table(const body::BodyModel& model,
                                         const body::ExternalLoads& loads,
                                         BodyPoints points);

}  // namespace myoid::study
