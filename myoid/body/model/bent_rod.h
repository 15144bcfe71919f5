#pragma once

#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Returns the end of a rod that begins at the origin along y, is bent into an arc of a circle, and ends along the unit
/// vector u (OpenSim's ConstantCurvatureJoint). With theta the angle between y and u and L the length, the end lies at
/// L tan(theta/2)/theta across and L sin(theta)/theta along y. |theta| below pi.
[[nodiscard]] Vec3 bent_rod_end(double length_m, const Vec3& u);

/// Returns the velocity of the end when u has the rate `du` [1/s], perpendicular to u.
[[nodiscard]] Vec3 bent_rod_velocity(double length_m, const Vec3& u, const Vec3& du);

/// Returns the acceleration of the end; `ddu` is the second derivative of u.
[[nodiscard]] Vec3 bent_rod_acceleration(double length_m, const Vec3& u, const Vec3& du, const Vec3& ddu);

}  // namespace myoid::body
