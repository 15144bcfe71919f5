#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "myoid/body/model/functions.h"
#include "myoid/body/model/multi_polynomial.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Index of a body in BodyModel::bodies; 0 is ground.
using BodyIndex = int;

/// A point that a muscle passes. A point with a condition exists only while
/// lower - 1e-5 <= q <= upper + 1e-5.
struct PathPoint {
  struct Condition {
    int coordinate = -1;
    double lower = 0.0;
    double upper = 0.0;
  };
  /// Location in a frame F of the body [m]: x, y and z each a function of a coordinate; -1: of none.
  struct Moving {
    std::array<int, 3> coordinates{-1, -1, -1};
    std::array<Function, 3> location;
    Pose X_BF{};
  };
  std::string name;
  BodyIndex body = 0;
  Vec3 p_BP = Vec3::Zero();  ///< [m]
  std::optional<Condition> condition;
  std::optional<Moving> moving;
};

/// Cylinder about the axis z of its frame.
struct CylinderShape {
  double radius_m = 1.0;
  double length_m = 1.0;
};

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

/// The side of a wrap object on which paths may lie: 0 every side, else +-1 x, +-2 y, +-3 z.
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
  /// First and last point of the range, counted from 1 over all points with the inactive ones.
  int range_start = -1;  ///< Below 1: the first point.
  int range_end = -1;    ///< Below 1: the last point.
};

/// A length given as a polynomial of coordinates instead of points (FunctionBasedPath). The moment
/// arms are minus the derivatives of the length, or separate polynomials.
struct FunctionPath {
  std::vector<int> coordinates;
  MultiPolynomial length;
  std::vector<MultiPolynomial> moment_arms;  ///< None, or one for each coordinate.
};

struct MusclePath {
  std::vector<PathPoint> points;
  std::vector<PathWrap> wraps;
  std::optional<FunctionPath> function{};  ///< A path with a function has no points and wraps.
};

}  // namespace myoid::body
