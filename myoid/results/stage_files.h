#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::results {

/// Columns of a series, one after the other.
struct SeriesColumns {
  std::vector<Channel> channels;
  std::vector<Eigen::VectorXd> values;

  void add(std::string name, Unit unit, Eigen::VectorXd column);
  [[nodiscard]] TimeSeries series(const Eigen::VectorXd& time_s) const;
};

/// Writes coordinates as ik.mot: rotations in degrees, translations in meters.
void write_motion(const body::BodyModel& model,
                  const TimeSeries& q,
                  const std::filesystem::path& path,
                  const std::vector<std::string>& comments);

/// Writes ik_marker_errors.sto: frames with at least one marker, and markers that are in all of these frames.
void write_marker_errors(const body::IkResult& ik, const std::filesystem::path& path);

/// Writes MuscleAnalysis_Length.sto, _MuscleTendonVelocity.sto and a _MomentArm_ file for each coordinate.
void write_muscle_kinematics(const body::MuscleKinematics& muscles, const std::filesystem::path& folder);

/// Writes StaticOptimization_force.sto with the reserves, _activation.sto and _status.csv, the end
/// of each frame's search.
void write_shared_forces(const body::MuscleForces& shared, const std::filesystem::path& folder);

}  // namespace myoid::results
