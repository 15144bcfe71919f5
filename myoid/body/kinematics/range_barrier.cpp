#include "myoid/body/kinematics/range_barrier.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myoid::body {

RangeBarrier::RangeBarrier(const body::BodyModel& model, const std::vector<Eigen::Index>& free) {
  for (std::size_t k = 0; k < free.size(); ++k) {
    const body::Coordinate& c = model.coordinates[static_cast<std::size_t>(free[k])];
    if (c.clamped && c.lower < c.upper) ranges_.push_back({free[k], static_cast<Eigen::Index>(k), c.lower, c.upper});
  }
}

double RangeBarrier::value(const Eigen::VectorXd& q) const {
  double sum = 0.0;
  for (const Range& r : ranges_) {
    const double below = q[r.coordinate] - r.lower, above = r.upper - q[r.coordinate];
    if (!(below > 0.0 && above > 0.0)) return std::numeric_limits<double>::infinity();
    const double width = r.upper - r.lower;
    sum -= std::log(4.0 * (below / width) * (above / width));
  }
  return weight_ * sum;
}

void RangeBarrier::add_derivatives(const Eigen::VectorXd& q,
                                   Eigen::VectorXd& gradient,
                                   Eigen::MatrixXd& hessian) const {
  for (const Range& r : ranges_) {
    const double below = q[r.coordinate] - r.lower, above = r.upper - q[r.coordinate];
    gradient[r.free] += weight_ * (1.0 / above - 1.0 / below);
    hessian(r.free, r.free) += weight_ * (1.0 / (above * above) + 1.0 / (below * below));
  }
}

void RangeBarrier::move_inside(Eigen::VectorXd& q, double share) const {
  for (const Range& r : ranges_) {
    const double margin = share * (r.upper - r.lower);
    q[r.coordinate] = std::clamp(q[r.coordinate], r.lower + margin, r.upper - margin);
  }
}

double RangeBarrier::longest_share(const Eigen::VectorXd& q, const Eigen::VectorXd& step) const {
  double share = 1.0;
  for (const Range& r : ranges_) {
    const double move = step[r.free];
    if (move == 0.0) continue;
    const double room = move > 0.0 ? r.upper - q[r.coordinate] : r.lower - q[r.coordinate];
    share = std::min(share, 0.99 * room / move);
  }
  return share;
}

}  // namespace myoid::body
