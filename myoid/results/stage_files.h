#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/model/body_model.h"

namespace myoid {

/// Columns of a series, one after the other.
struct SeriesColumns {
  std::vector<Channel> channels;
  std::vector<Eigen::VectorXd> values;

  void add(std::string name, Unit unit, Eigen::VectorXd column);
  [[nodiscard]] TimeSeries series(const Eigen::VectorXd& time_s) const;
};

/// Writes coordinates as ik.mot: rotations in degrees, translations in meters.
void write_motion(const model::BodyModel& model,
                  const TimeSeries& q,
                  const std::filesystem::path& path,
                  const std::vector<std::string>& comments);

/// Writes ik_marker_errors.sto: frames with at least one marker, and markers that are in all of these frames.
void write_marker_errors(const kinematics::IkResult& ik, const std::filesystem::path& path);

/// Writes MuscleAnalysis_Length.sto, _MuscleTendonVelocity.sto and a _MomentArm_ file for each coordinate.
void write_muscle_kinematics(const kinematics::MuscleKinematics& muscles, const std::filesystem::path& folder);

/// Writes StaticOptimization_force.sto with the reserves, _activation.sto and _status.csv, the end
/// of each frame's search.
void write_shared_forces(const forces::MuscleForces& shared, const std::filesystem::path& folder);

}  // namespace myoid
