#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "myoid/body/model/force_laws.h"
#include "myoid/body/model/functions.h"
#include "myoid/body/model/multi_polynomial.h"
#include "myoid/body/model/muscle_properties.h"
#include "myoid/body/model/opensim_defects/compat.h"
#include "myoid/body/model/path_geometry.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {

struct Body {
  std::string name;
  double mass_kg = 0.0;
  Vec3 p_BBcm_B = Vec3::Zero();  ///< Mass center [m].
  /// Inertia about the mass center in body axes [kg m^2]; no check or repair changes it.
  Mat3 I_BBcm_B = Mat3::Zero();
};

enum class MotionType { rotational, translational, coupled };

struct Coordinate {
  std::string name;
  int joint = -1;  ///< Index in BodyModel::joints.
  MotionType motion = MotionType::rotational;
  double default_value = 0.0;  ///< [rad] or [m]
  double lower = -10.0;        ///< Limits of `range`, [rad] or [m].
  double upper = 10.0;
  bool clamped = false;
  bool locked = false;
  double default_speed = 0.0;          ///< [rad/s] or [m/s]
  std::optional<Function> prescribed;  ///< Value over time [s], if the file prescribes it.
  bool is_free_to_satisfy_constraints = false;
};

/// One of the six axes of a joint. The joint turns about `axis`, or moves along it, by
/// function(q of coordinate).
struct TransformAxis {
  /// Unit; expressed in the frame after the preceding rotations (rotations) or in F (translations).
  Vec3 axis = Vec3::Zero();
  /// Index in BodyModel::coordinates; -1: the axis stays at the function's value at 0.
  int coordinate = -1;
  Function function = Constant{0.0};
};

/// A joint places its child by X_PB = X_PF X_FM(q) X_BM^-1. X_FM has the rotation
/// R = R(a1,f1) R(a2,f2) R(a3,f3) and the translation sum f_i a_i in F. An ellipsoid joint adds
/// radii * (third column of R), element by element; a bent rod adds the place of its end
/// (bent_rod.h). Every OpenSim joint has this form; speeds are the rates of the coordinates.
struct Joint {
  std::string name;
  std::string class_name;  ///< As in the file: "CustomJoint", "PinJoint", ...
  BodyIndex parent = 0;
  Pose X_PF;
  BodyIndex child = 0;
  Pose X_BM;
  std::vector<int> coordinates;  ///< Indices in BodyModel::coordinates.
  int place_in_file = -1;        ///< Number in the order of the file's joints.
  std::array<TransformAxis, 3> rotation;
  std::array<TransformAxis, 3> translation;
  /// EllipsoidJoint: the origin of M moves on this surface.
  std::optional<Vec3> ellipsoid_radii_m;
  /// ConstantCurvatureJoint: M is at the end of a rod along its y.
  std::optional<double> rod_length_m;
};

struct Marker {
  std::string name;
  BodyIndex body = 0;
  Vec3 p_BM = Vec3::Zero();  ///< [m]
};

/// q_dependent = function(q_independent) (CoordinateCouplerConstraint; its scale is in the function).
struct CoordinateCoupler {
  std::string name;
  int dependent = -1;
  int independent = -1;
  Function function;
};

/// Two frames that share their origins (PointConstraint) or the whole pose (WeldConstraint).
struct FrameConstraint {
  BodyIndex body1 = 0, body2 = 0;
  Pose X_BF1, X_BF2;
  bool rotation_too = false;
};

/// Two points at a fixed distance (ConstantDistanceConstraint).
struct DistanceConstraint {
  BodyIndex body1 = 0, body2 = 0;
  Vec3 p_B1 = Vec3::Zero(), p_B2 = Vec3::Zero();
  double distance_m = 0.0;
};

/// A point of body 2 on a line of body 1 (PointOnLineConstraint).
struct LineConstraint {
  BodyIndex body1 = 0, body2 = 0;
  Vec3 direction = Vec3::UnitX(), p_B1 = Vec3::Zero(), p_B2 = Vec3::Zero();
};

/// q_dependent = function(independent coordinates): a CoordinateCouplerConstraint with several independent coordinates.
struct FunctionConstraint {
  int dependent = -1;
  std::vector<int> independent{};
  MultiPolynomial function{};
};

/// A further coupler of a coordinate that another coupler sets: both hold.
struct SecondCoupler {
  CoordinateCoupler coupler;
};

struct LoopConstraint {
  std::string name;
  std::string class_name;
  std::variant<FrameConstraint, DistanceConstraint, LineConstraint, FunctionConstraint, SecondCoupler> law;
};

/// A person as a multibody system: an immutable value once read. Joints are in tree order, breadth
/// first: the joint of a parent precedes the joint of its child. `joint_of_body[b]` is the joint
/// whose child is body b (-1 for ground). Coordinates are in the order of the file's JointSet. One
/// model may serve many threads; a BodyState (kinematic_tree.h) holds the posture.
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
  std::vector<PointActuator> point_actuators;
  std::vector<TorqueActuator> torque_actuators;
  std::vector<PathActuator> path_actuators;
  /// Names of muscles, actuators and passive forces in the order of the file's force set, which
  /// OpenSim's result columns have too.
  std::vector<std::string> force_order;
  std::vector<PassiveForce> passive_forces;
  std::vector<CoordinateCoupler> couplers;  ///< Only enforced couplers.
  std::vector<LoopConstraint> constraints;  ///< Enforced constraints other than couplers.
  Compat compat;                            ///< Exact paths or OpenSim's (compat.h).
  int document_version = 0;
  std::vector<Remark> notes;  ///< Repairs and omissions of the reader, a sentence each.
  /// Parts of the file that are left out and change results, a sentence each; commands that need
  /// such a part refuse the model.
  std::vector<std::string> unsupported;

  [[nodiscard]] std::optional<int> find_body(std::string_view name) const;
  [[nodiscard]] std::optional<int> find_coordinate(std::string_view name) const;
  [[nodiscard]] std::optional<int> find_marker(std::string_view name) const;
  [[nodiscard]] std::optional<int> find_muscle(std::string_view name) const;
  /// Returns the index, as find_...; throws ModelError with the list of names if there is none.
  [[nodiscard]] int coordinate_index(std::string_view name) const;
  [[nodiscard]] int muscle_index(std::string_view name) const;
  /// Returns true for a dependent coordinate: locked, prescribed or driven by a coupler.
  [[nodiscard]] bool is_constrained(int coordinate) const;
  /// Returns the coordinate values of the default pose; couplers give the dependent coordinates.
  [[nodiscard]] Eigen::VectorXd default_q() const;
};

/// Calls `visit` with each list of the actuators other than muscles.
template <typename Model, typename Visit>
void visit_actuators(Model& model, const Visit& visit) {
  visit(model.actuators);
  visit(model.point_actuators);
  visit(model.torque_actuators);
  visit(model.path_actuators);
}

/// Checks the invariants above, orders the joints and fills joint_of_body. Throws ModelError that
/// names the inconsistency (a cycle, an unknown index, a body without a joint).
[[nodiscard]] BodyModel finalize(BodyModel model);

}  // namespace myoid::body
