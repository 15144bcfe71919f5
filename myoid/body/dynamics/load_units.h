#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::body {

/// Corrects the unit of the points [m] and of the free torque [N m] of one external force, by the rows in which the
/// force is 50 N or more. Returns a sentence for each correction.
///
/// - Points are in mm if 95 % of them are 20 m or more from the origin of their frame and they spread over 20 m or
/// more.
/// - A torque about the point is in N mm if half of its values exceed the force times 5 m.
///
/// Fewer than ten such rows, or no such columns, tell nothing.
[[nodiscard]] std::vector<std::string> mend_load_units(const Eigen::MatrixX3d& force_n,
                                                       Eigen::MatrixX3d& point_m,
                                                       Eigen::MatrixX3d& torque_nm);

}  // namespace myoid::body
