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
#include "myoid/model/expression.h"
#include "myoid/model/functions.h"
#include "myoid/model/multi_polynomial.h"
#include "myoid/model/opensim_defects/compat.h"

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
  double default_speed = 0.0;          ///< [rad/s] or [m/s]
  std::optional<Function> prescribed;  ///< Value over time [s], if the file prescribes it.
  bool is_free_to_satisfy_constraints = false;
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

/// X_PB = X_PF X_FM(q) X_BM^-1; X_FM: rotation R = R(a1,f1) R(a2,f2) R(a3,f3), translation
/// sum f_i a_i in F, on an ellipsoid also radii * (third column of R), element by element, at the
/// end of a bent rod also where that ends (bent_rod.h). Every OpenSim joint is written in this
/// form, the speeds being the coordinates' rates.
struct Joint {
  std::string name;
  std::string class_name;  ///< As in the file: "CustomJoint", "PinJoint", ...
  BodyIndex parent = 0;
  Pose X_PF;
  BodyIndex child = 0;
  Pose X_BM;
  std::vector<int> coordinates;  ///< Indices in BodyModel::coordinates.
  int place_in_file = -1;        ///< In the order of the file's joints.
  std::array<TransformAxis, 3> rotation;
  std::array<TransformAxis, 3> translation;
  std::optional<Vec3>
      ellipsoid_radii_m;  ///< EllipsoidJoint: the origin of M moves on this surface.
  std::optional<double>
      rod_length_m;  ///< ConstantCurvatureJoint: M is at the end of a rod along its y.
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
  /// Location in a frame F of the body as functions of one coordinate [m].
  struct Moving {
    int coordinate = -1;
    std::array<Function, 3> location;
    Pose X_BF{};
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

struct SphereShape {
  double radius_m = 1.0;
};
/// Ring about z: a circle of radius `outer_radius_m` as the axis of a tube of `inner_radius_m`.
struct TorusShape {
  double inner_radius_m = 0.01;
  double outer_radius_m = 0.05;
};

/// Which side of a wrap object counts: 0 all, else +-1 x, +-2 y, +-3 z.
using Quadrant = int;

struct WrapObject {
  std::string name;
  BodyIndex body = 0;
  Pose X_BW;  ///< Wrap frame in the body.
  Quadrant quadrant = 0;
  bool active = true;
  std::variant<CylinderShape, EllipsoidShape, SphereShape, TorusShape> shape;
};

enum class WrapMethod { hybrid, midpoint, axial };

struct PathWrap {
  int wrap_object = -1;  ///< Index in BodyModel::wrap_objects.
  WrapMethod method = WrapMethod::hybrid;
  int range_start =
      -1;  ///< 1-based over all path points, inactive ones included; < 1: from the first.
  int range_end = -1;  ///< < 1: to the last.
};

/// A length given as a polynomial of coordinates instead of points (FunctionBasedPath); the moment
/// arms are minus its derivatives, or polynomials of their own.
struct FunctionPath {
  std::vector<int> coordinates;
  MultiPolynomial length;
  std::vector<MultiPolynomial> moment_arms;  ///< None, or one for each coordinate.
};

struct MusclePath {
  std::vector<PathPoint> points;
  std::vector<PathWrap> wraps;
  std::optional<FunctionPath> function{};  ///< Then there are neither points nor wraps.
};

/// Corner points and slopes of Millard's curves (force by normalized length, velocity or strain).
struct MillardCurves {
  double active_min_length = 0.4441, active_transition_length = 0.73, active_max_length = 1.8123;
  double active_shallow_slope = 0.8616, active_minimum = 0.1;
  double concentric_slope_at_vmax = 0.0, concentric_slope_near_vmax = 0.25;
  double isometric_slope = 5.0;
  double eccentric_slope_at_vmax = 0.0, eccentric_slope_near_vmax = 0.15, eccentric_force = 1.4;
  double concentric_curviness = 0.6, eccentric_curviness = 0.9;
  double fiber_strain_at_zero_force = 0.0, fiber_strain_at_one_force = 0.7;
  /// Negative: as the class computes them where the file gives none.
  double fiber_stiffness_at_low_force = -1.0, fiber_stiffness_at_one_force = -1.0;
  double fiber_curviness = -1.0;
  double tendon_strain_at_one_force = 0.049, tendon_stiffness_at_one_force = -1.0;
  double tendon_force_at_toe_end = -1.0, tendon_curviness = -1.0;
  double fiber_damping = 0.1;
  bool ignore_tendon_compliance = false, ignore_activation_dynamics = false;
};

/// Curves of Schutte1993Muscle and Delp1990Muscle; empty where the class's own hold.
struct SchutteCurves {
  double time_scale_s = 0.1, activation1 = 7.667, activation2 = 1.459854, damping = 0.05;
  std::optional<Function> active_force_length, passive_force_length, tendon_force_length;
  std::optional<Function> force_velocity;
};

/// DeGrooteFregly2016Muscle beside the shared numbers.
struct DeGrooteCurves {
  double active_width_scale = 1.0, fiber_damping = 0.0;
  double passive_fiber_strain_at_one_force = 0.6, tendon_strain_at_one_force = 0.049;
  bool ignore_passive_fiber_force = false, ignore_tendon_compliance = false;
  bool ignore_activation_dynamics = false, tendon_dynamics_implicit = false;
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
  double minimum_activation = 0.01;
  double default_activation = 0.05;
  double default_fiber_length_m = 0.1;
  double min_control = 0.01;
  double max_control = 1.0;
  std::variant<std::monostate, MillardCurves, SchutteCurves, DeGrooteCurves> curves;
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
  bool applies_force = true;
};

/// A force of optimal_force times control along `direction` at a point of a body (PointActuator).
struct PointActuator {
  std::string name;
  BodyIndex body = 0;
  Vec3 point = Vec3::Zero();
  bool point_is_global = false;
  Vec3 direction = Vec3::UnitX();  ///< Unit.
  bool force_is_global = false;
  double optimal_force = 1.0;
  double min_control = -std::numeric_limits<double>::infinity();
  double max_control = std::numeric_limits<double>::infinity();
  bool applies_force = true;
};

/// A torque of optimal_force times control about `axis`: on body A, and reversed on body B.
struct TorqueActuator {
  std::string name;
  BodyIndex body_a = 0, body_b = 0;
  Vec3 axis = Vec3::UnitZ();     ///< Unit.
  bool torque_is_global = true;  ///< Else the axis is given in body A.
  double optimal_force = 1.0;
  double min_control = -std::numeric_limits<double>::infinity();
  double max_control = std::numeric_limits<double>::infinity();
  bool applies_force = true;
};

/// A tension of optimal_force times control along a path.
struct PathActuator {
  std::string name;
  MusclePath path;
  double optimal_force = 1.0;
  double min_control = -std::numeric_limits<double>::infinity();
  double max_control = std::numeric_limits<double>::infinity();
  bool applies_force = true;
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
/// may have a function (FunctionBasedBushingForce), or each force a formula in all of them
/// (ExpressionBasedBushingForce); they are what the bushing pulls back with.
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
/// Force and torque on a frame F of a body over time (PrescribedForce). Without point the force
/// acts at the frame's origin.
struct PrescribedForce {
  BodyIndex body = 0;
  Pose X_BF;
  bool point_is_global = false, force_is_global = true;  ///< In ground, else in F.
  std::vector<Function> force{}, point{}, torque{};      ///< Three or none.
};
/// A sphere against a half-space (what lies on the side of +x of its frame) or another sphere:
/// Hertz and Hunt-Crossley, with friction (HuntCrossleyForce; smooth: SmoothSphereHalfSpaceForce).
struct Contact {
  BodyIndex sphere_body = 0, other_body = 0;
  Vec3 p_BS = Vec3::Zero();  ///< Center of the sphere.
  double radius_m = 0.0;
  Pose X_BO;                               ///< The half-space's frame, or the other's center.
  std::optional<double> other_radius_m{};  ///< The other is a sphere.
  /// Of the sphere and of the other: modulus [N/m^2], dissipation [s/m], coefficients of friction
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
/// Tension along a path: stiffness (length - rest)(1 + dissipation dl/dt), none when slack; in
/// shortening faster than 1 / dissipation it pushes, as OpenSim's does.
struct PathSpring {
  MusclePath path;
  double stiffness_npm = 0.0, rest_length_m = 0.0, dissipation = 0.0;
};
/// Tension along a path: scale times a curve of length / resting length, none when slack.
struct Ligament {
  MusclePath path;
  double rest_length_m = 0.0, scale_n = 1.0;
  Function force_length;
};
/// A force of the model that is neither muscle nor actuator, and acts in inverse dynamics.
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

/// q_dependent = function(q_independent) (CoordinateCouplerConstraint; its scale is in the
/// function).
struct CoordinateCoupler {
  std::string name;
  int dependent = -1;
  int independent = -1;
  Function function;
};

/// Two frames that stay together: their origins (PointConstraint) or altogether (WeldConstraint).
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
/// q_dependent = function(several others): a CoordinateCouplerConstraint of several independent
/// coordinates.
struct FunctionConstraint {
  int dependent = -1;
  std::vector<int> independent{};
  MultiPolynomial function{};
};
struct LoopConstraint {
  std::string name;
  std::string class_name;
  std::variant<FrameConstraint, DistanceConstraint, LineConstraint, FunctionConstraint> law;
};

/// A person as a multibody system: an immutable value once read. Joints are in tree order, breadth
/// first (a parent's joint stands before its child's); `joint_of_body[b]` is the joint whose child
/// is body b
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
  std::vector<PointActuator> point_actuators;
  std::vector<TorqueActuator> torque_actuators;
  std::vector<PathActuator> path_actuators;
  /// Names of muscles, actuators and passive forces in the order of the file's force set, which is
  /// that of OpenSim's result columns.
  std::vector<std::string> force_order;
  std::vector<PassiveForce> passive_forces;
  std::vector<CoordinateCoupler> couplers;  ///< Enforced ones.
  std::vector<LoopConstraint> constraints;  ///< Enforced ones other than couplers.
  Compat compat;  ///< Exact, or OpenSim's way of computing paths (compat.h).
  int document_version = 0;
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
  /// The coordinate takes no value of its own: locked, prescribed or the dependent one of a
  /// coupler.
  [[nodiscard]] bool is_constrained(int coordinate) const;
  /// Coordinate values of the default pose; dependent coordinates as their couplers say.
  [[nodiscard]] Eigen::VectorXd default_q() const;
};

/// Checks the invariants above, orders the joints, fills joint_of_body; throws ModelError naming
/// what is inconsistent (a cycle, an unknown index, a body without a joint).
[[nodiscard]] BodyModel finalize(BodyModel model);

}  // namespace myoid::model
