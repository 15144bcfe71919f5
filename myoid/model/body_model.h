#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/units.h"
#include "myoid/model/functions.h"

namespace myoid::model {

/// Index of a body in BodyModel::bodies; 0 is ground.
using BodyIndex = int;

struct Body {
  std::string name;
  double mass_kg = 0.0;
  Vec3 p_BBcm_B = Vec3::Zero();  ///< Mass center [m].
  Mat3 I_BBcm_B =
      Mat3::Zero();  ///< Inertia about the mass center, body axes [kg m^2]; used as it is.
};

enum class MotionType { rotational, translational, coupled };

struct Coordinate {
  std::string name;
  int joint = -1;  ///< Index in BodyModel::joints.
  MotionType motion = MotionType::rotational;
  double default_value = 0.0;  ///< [rad] or [m]
  double lower = -10.0;        ///< Of `range`, [rad] or [m].
  double upper = 10.0;
  bool clamped = false;
  bool locked = false;
};

/// One of the six axes of a joint: turns about, or moves along, `axis` by function(q of
/// coordinate).
struct TransformAxis {
  Vec3 axis = Vec3::Zero();  ///< Unit; expressed in the frame that the preceding axes have made
                             ///< (rotations) or in F (translations).
  int coordinate =
      -1;  ///< Index in BodyModel::coordinates; -1: the function's value at 0 is constant.
  Function function = Constant{0.0};
};

/// X_PB = X_PF X_FM(q) X_BM^-1; X_FM: rotation R(a1,f1) R(a2,f2) R(a3,f3), translation sum f_i a_i
/// in F. Every OpenSim joint whose speeds are the coordinates' rates is written in this form.
struct Joint {
  std::string name;
  std::string class_name;  ///< As in the file: "CustomJoint", "PinJoint", ...
  BodyIndex parent = 0;
  Pose X_PF;
  BodyIndex child = 0;
  Pose X_BM;
  std::vector<int> coordinates;  ///< Indices in BodyModel::coordinates.
  std::array<TransformAxis, 3> rotation;
  std::array<TransformAxis, 3> translation;
};

struct Marker {
  std::string name;
  BodyIndex body = 0;
  Vec3 p_BM = Vec3::Zero();  ///< [m]
};

/// A point that a muscle passes. With a condition it is there only while lower - 1e-5 <= q <= upper
/// + 1e-5.
struct PathPoint {
  struct Condition {
    int coordinate = -1;
    double lower = 0.0;
    double upper = 0.0;
  };
  /// Location as functions of one coordinate [m].
  struct Moving {
    int coordinate = -1;
    std::array<Function, 3> location;
  };
  std::string name;
  BodyIndex body = 0;
  Vec3 p_BP = Vec3::Zero();  ///< [m]
  std::optional<Condition> condition;
  std::optional<Moving> moving;
};

struct CylinderShape {
  double radius_m = 1.0;
  double length_m = 1.0;
};  ///< Axis z of its frame.
struct EllipsoidShape {
  Vec3 radii_m = Vec3(0.05, 0.05, 0.05);
};

/// Which side of a wrap object counts: 0 all, else +-1 x, +-2 y, +-3 z.
using Quadrant = int;

struct WrapObject {
  std::string name;
  BodyIndex body = 0;
  Pose X_BW;  ///< Wrap frame in the body.
  Quadrant quadrant = 0;
  bool active = true;
  std::variant<CylinderShape, EllipsoidShape> shape;
};

enum class WrapMethod { hybrid, midpoint, axial };

struct PathWrap {
  int wrap_object = -1;  ///< Index in BodyModel::wrap_objects.
  WrapMethod method = WrapMethod::hybrid;
  int range_start =
      -1;  ///< 1-based over all path points, inactive ones included; < 1: from the first.
  int range_end = -1;  ///< < 1: to the last.
};

struct MusclePath {
  std::vector<PathPoint> points;
  std::vector<PathWrap> wraps;
};

/// The numbers of a muscle as the model file has them, SI. Fields that a class does not have keep
/// Thelen's defaults.
struct MuscleProperties {
  double max_isometric_force_n = 1000.0;
  double optimal_fiber_length_m = 0.1;
  double tendon_slack_length_m = 0.2;
  double pennation_at_optimal_rad = 0.0;
  double max_contraction_velocity = 10.0;  ///< [optimal fiber lengths / s]
  double active_shape = 0.45;              ///< Thelen KshapeActive.
  double passive_shape = 5.0;              ///< Thelen KshapePassive.
  double max_tendon_strain = 0.04;
  double max_muscle_strain = 0.6;
  double concentric_shape = 0.25;  ///< Thelen Af.
  double eccentric_plateau = 1.4;  ///< Thelen Flen.
  double force_velocity_extrapolation = 0.95;
  double max_pennation_rad = 1.4706289056333368;  ///< acos(0.1)
  double activation_time_s = 0.015;
  double deactivation_time_s = 0.05;
  double min_control = 0.01;
  double max_control = 1.0;
};

struct Muscle {
  std::string name;
  std::string class_name;  ///< "Thelen2003Muscle", ...
  bool applies_force = true;
  MuscleProperties properties;
  MusclePath path;
};

/// A generalized force on one coordinate (reserve actuator).
struct CoordinateActuator {
  std::string name;
  int coordinate = -1;
  double optimal_force = 1.0;  ///< [N m] or [N]
  double min_control = -std::numeric_limits<double>::infinity();
  double max_control = std::numeric_limits<double>::infinity();
};

/// A person as a multibody system: an immutable value once read. Joints are in tree order (a
/// parent's joint stands before its child's); `joint_of_body[b]` is the joint whose child is body b
/// (-1 for ground). Coordinates are in the file's JointSet order. One model may serve many threads;
/// what changes with the posture lives in a BodyState (kinematic_tree.h).
struct BodyModel {
  std::string name;
  Vec3 gravity_G = Vec3(0.0, -kStandardGravity, 0.0);  ///< [m/s^2]
  std::vector<Body> bodies;                            ///< [0] is ground.
  std::vector<Joint> joints;
  std::vector<int> joint_of_body;
  std::vector<Coordinate> coordinates;
  std::vector<Marker> markers;
  std::vector<WrapObject> wrap_objects;
  std::vector<Muscle> muscles;
  std::vector<CoordinateActuator> actuators;
  std::vector<std::string> notes;  ///< What was repaired or ignored while reading, a sentence each.
  std::vector<std::string>
      unsupported;  ///< What would make results wrong; commands that need it refuse.

  [[nodiscard]] std::optional<int> find_body(std::string_view name) const;
  [[nodiscard]] std::optional<int> find_coordinate(std::string_view name) const;
  [[nodiscard]] std::optional<int> find_marker(std::string_view name) const;
  [[nodiscard]] std::optional<int> find_muscle(std::string_view name) const;
  /// Like find_..., but throws ModelError listing the names there are.
  [[nodiscard]] int coordinate_index(std::string_view name) const;
  [[nodiscard]] int muscle_index(std::string_view name) const;
  /// Coordinate values of the default pose.
  [[nodiscard]] Eigen::VectorXd default_q() const;
};

/// Checks the invariants above, orders the joints, fills joint_of_body; throws ModelError naming
/// what is inconsistent (a cycle, an unknown index, a body without a joint).
[[nodiscard]] BodyModel finalize(BodyModel model);

}  // namespace myoid::model
