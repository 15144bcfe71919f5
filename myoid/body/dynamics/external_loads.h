#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/math/spline.h"

namespace myoid::body {

/// Three columns of a loads file as functions of time: natural cubic splines (straight lines for
/// two or three rows, a constant for one).
struct LoadColumns {
  std::vector<math::Spline> splines{};  ///< Three, or none for a constant.
  Vec3 constant = Vec3::Zero();
  /// Returns the columns of values on these knots.
  [[nodiscard]] static LoadColumns interpolate(const math::SplineKnots& knots, const Eigen::MatrixX3d& values);
  [[nodiscard]] Vec3 at(double time_s) const;
};

/// One measured force on a body.
struct ExternalForce {
  std::string name;
  body::BodyIndex body = 0;           ///< The body on which the force acts.
  body::BodyIndex force_frame = 0;    ///< Force and torque are expressed in this body's frame.
  body::BodyIndex point_frame = 0;    ///< The point is given in this body's frame.
  std::optional<LoadColumns> force;   ///< [N]
  std::optional<LoadColumns> point;   ///< [m]; absent: the origin of `body`.
  std::optional<LoadColumns> torque;  ///< [N m]
};

struct ExternalLoads {
  std::vector<ExternalForce> forces;
  double start_s = 0.0,
         end_s = 0.0;    ///< First and last time of the data; lines continue the splines.
  double rate_hz = 0.0;  ///< Of the data; 0 for one row.
  /// Time of the motion = time of the data + offset_s + 1e-6 drift_ppm x time of the data.
  /// `start_s` and `end_s` are times of the motion.
  double offset_s = 0.0, drift_ppm = 0.0;
  std::vector<Remark> notes;  ///< Repairs and omissions, a sentence each.

  /// Returns the time of the data at a time of the motion.
  [[nodiscard]] double data_time_s(double motion_time_s) const;
  /// Puts the data on another clock.
  void set_clock(double offset_s, double drift_ppm);

  /// Appends the wrenches about the origins of the loaded bodies, in ground, at the posture in `state` (compute_poses).
  void append_wrenches(const body::BodyState& state, double time_s, std::vector<body::BodyWrench>& wrenches) const;
};

/// Reads <ExternalLoads> of OpenSim and the data file that the element names (relative to its own file). Each
/// ExternalForce takes the columns that begin with its identifier: three for each of force, point and torque. Straight
/// lines between the points under load replace points that are NaN or kilometers away while no force acts, with a note.
/// Throws ReadError with the line for bad XML, an unknown body or an identifier without its three columns; InvalidInput
/// for a force that is NaN.
[[nodiscard]] ExternalLoads read_external_loads(const body::BodyModel& model, const std::filesystem::path& path);

}  // namespace myoid::body
