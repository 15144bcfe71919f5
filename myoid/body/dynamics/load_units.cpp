#include "myoid/body/dynamics/load_units.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::body {
namespace {

constexpr double kLoaded_n = 50.0;
constexpr std::size_t kFewest = 10;
constexpr double kFar_m = 20.0;
constexpr double kLongArm_m = 5.0;

}  // namespace

std::vector<std::string> mend_load_units(const Eigen::MatrixX3d& force_n,
                                         Eigen::MatrixX3d& point_m,
                                         Eigen::MatrixX3d& torque_nm) {
  std::vector<std::string> said;
  if (force_n.rows() == 0 || point_m.rows() == 0) return said;
  std::vector<double> away_m, arm_m;
  std::size_t far = 0;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (Eigen::Index i = 0; i < force_n.rows(); ++i) {
    const double size_n = force_n.row(i).norm();
    if (!(size_n >= kLoaded_n) || !point_m.row(i).allFinite()) continue;
    const Vec3 p = point_m.row(i).transpose();
    away_m.push_back(p.norm());
    if (p.norm() >= kFar_m) ++far;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    if (torque_nm.rows() > 0) arm_m.push_back(torque_nm.row(i).norm() / size_n);
  }
  if (away_m.size() < kFewest) return said;
  if (20 * far >= 19 * away_m.size() && (high - low).norm() >= kFar_m) {
    said.push_back(fmt::format("points {:.4g} m from the origin and {:.4g} m apart under load are taken in mm",
                               math::median(away_m), (high - low).norm()));
    point_m *= 1e-3;
  }
  if (const double arm = arm_m.empty() ? 0.0 : math::median(arm_m); arm > kLongArm_m) {
    said.push_back(
        fmt::format("a torque about the point of {:.4g} m times the force, at the median, is taken in N mm", arm));
    torque_nm *= 1e-3;
  }
  return said;
}

}  // namespace myoid::body
