#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "myoid/body/model/expression.h"
#include "myoid/body/model/functions.h"
#include "myoid/body/model/path_geometry.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// The fields that all actuators share. An actuator makes optimal_force times its control.
struct ActuatorBase {
  std::string name;
  double optimal_force = 1.0;  ///< [N] or [N m]
  double min_control = -std::numeric_limits<double>::infinity();
  double max_control = std::numeric_limits<double>::infinity();
  bool applies_force = true;
};

/// A generalized force on one coordinate (reserve actuator).
struct CoordinateActuator : ActuatorBase {
  int coordinate = -1;
};

/// A force along `direction` at a point of a body (PointActuator).
struct PointActuator : ActuatorBase {
  BodyIndex body = 0;
  Vec3 point = Vec3::Zero();
  bool point_is_global = false;
  Vec3 direction = Vec3::UnitX();  ///< Unit.
  bool force_is_global = false;
};

/// A torque about `axis` on body A, and the opposite torque on body B.
struct TorqueActuator : ActuatorBase {
  BodyIndex body_a = 0, body_b = 0;
  Vec3 axis = Vec3::UnitZ();     ///< Unit.
  bool torque_is_global = true;  ///< Otherwise the axis is given in body A.
};

/// A tension along a path.
struct PathActuator : ActuatorBase {
  MusclePath path;
};

/// OpenSim's CoordinateLimitForce, in SI: beyond a limit the stiffness rises smoothly to its full
/// value over `transition`.
struct CoordinateLimitForce {
  int coordinate = -1;
  double upper_limit = 0.0, lower_limit = 0.0;          ///< [rad] or [m]
  double upper_stiffness = 1.0, lower_stiffness = 1.0;  ///< [N m/rad] or [N/m]
  double damping = 0.001;                               ///< [N m s/rad] or [N s/m]
  double transition = 0.1;                              ///< [rad] or [m]
};

/// -stiffness (q - rest) - viscosity qdot on one coordinate (SpringGeneralizedForce).
struct CoordinateSpring {
  int coordinate = -1;
  double stiffness = 0.0, rest = 0.0, viscosity = 0.0;
};

/// A formula in q and qdot of one coordinate (ExpressionBasedCoordinateForce).
struct CoordinateFormula {
  int coordinate = -1;
  Expression force;
};

/// Linear spring and damper between frames F1 (on body 1) and F2, in rotation (body-fixed X-Y-Z
/// angles of F2 in F1) and translation (in F1). Instead of stiffnesses each of the six deflections
/// may have a function (FunctionBasedBushingForce), or each force a formula in all deflections
/// (ExpressionBasedBushingForce). Functions and formulas give the restoring force.
struct Bushing {
  BodyIndex body1 = 0, body2 = 0;
  Pose X_BF1, X_BF2;
  Vec3 rotational_stiffness = Vec3::Zero(), translational_stiffness = Vec3::Zero();
  Vec3 rotational_damping = Vec3::Zero(), translational_damping = Vec3::Zero();
  std::vector<Function> functions{};   ///< Six or none.
  std::vector<Expression> formulas{};  ///< Six or none.
};

/// stiffness (length - rest) along the line between two points.
struct PointSpring {
  BodyIndex body1 = 0, body2 = 0;
  Vec3 p_B1 = Vec3::Zero(), p_B2 = Vec3::Zero();
  double stiffness_npm = 0.0, rest_length_m = 0.0;
};

/// A formula in the distance d of two points and its rate ddot, pulling them together
/// (ExpressionBasedPointToPointForce).
struct PointFormula {
  BodyIndex body1 = 0, body2 = 0;
  Vec3 p_B1 = Vec3::Zero(), p_B2 = Vec3::Zero();
  Expression force;
};

/// Force and torque on a frame F of a body over time (PrescribedForce). A force without point acts
/// at the frame's origin.
struct PrescribedForce {
  BodyIndex body = 0;
  Pose X_BF;
  bool point_is_global = false, force_is_global = true;  ///< In ground, else in F.
  std::vector<Function> force{}, point{}, torque{};      ///< Three or none.
};

/// Contact of a sphere with a half-space (the side of +x of its frame) or another sphere by the
/// laws of Hertz and Hunt and Crossley, with friction (HuntCrossleyForce; smooth:
/// SmoothSphereHalfSpaceForce).
struct Contact {
  BodyIndex sphere_body = 0, other_body = 0;
  Vec3 p_BS = Vec3::Zero();  ///< Center of the sphere.
  double radius_m = 0.0;
  Pose X_BO;                               ///< The half-space's frame, or the other's center.
  std::optional<double> other_radius_m{};  ///< Radius of another sphere; empty for a half-space.
  /// A material has a modulus [N/m^2], a dissipation [s/m] and coefficients of friction
  /// (static, dynamic and viscous [s/m]).
  struct Material {
    double stiffness = 0.0, dissipation = 0.0;
    double static_friction = 0.0, dynamic_friction = 0.0, viscous_friction = 0.0;
  };
  std::array<Material, 2> materials{};
  double transition_velocity_mps = 0.01;
  struct Smoothing {
    double constant = 1e-5, hertz = 300.0, hunt_crossley = 50.0;
  };
  std::optional<Smoothing> smoothing{};
};

/// Tension along a path: stiffness (length - rest)(1 + dissipation dl/dt), zero when slack. The
/// spring pushes in shortening faster than 1 / dissipation, as in OpenSim.
struct PathSpring {
  MusclePath path;
  double stiffness_npm = 0.0, rest_length_m = 0.0, dissipation = 0.0;
};

/// Tension along a path: scale times a curve of length / resting length, zero when slack.
struct Ligament {
  MusclePath path;
  double rest_length_m = 0.0, scale_n = 1.0;
  Function force_length;
};

/// A force of the model that is neither muscle nor actuator and acts in inverse dynamics.
struct PassiveForce {
  std::string name;
  std::string class_name;
  std::variant<CoordinateLimitForce,
               CoordinateSpring,
               CoordinateFormula,
               Bushing,
               PointSpring,
               PointFormula,
               PrescribedForce,
               Contact,
               PathSpring,
               Ligament>
      law;
};

}  // namespace myoid::body
