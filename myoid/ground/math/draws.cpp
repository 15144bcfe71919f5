#include "myoid/ground/math/draws.h"

#include <algorithm>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/ground/math/random.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::inline ground::math {

Eigen::MatrixXd draw_normal(const Eigen::VectorXd& mean,
                            const Eigen::MatrixXd& covariance,
                            Eigen::Index count,
                            std::uint64_t seed) {
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  Eigen::MatrixXd draws(mean.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    draws.col(i) = mean + root * random.normals(mean.size());
  }
  return draws;
}

double weighted_quantile(const Eigen::VectorXd& values, const Eigen::VectorXd& weight, double share) {
  const std::vector<Eigen::Index> order = rising_order(values);
  double before = 0.0, last = values[order.front()], place = 0.0;
  for (const Eigen::Index i : order) {
    const double middle = before + 0.5 * weight[i];
    if (middle >= share) {
      const double step = middle - place;
      return step > 0.0 ? last + (values[i] - last) * std::clamp((share - place) / step, 0.0, 1.0) : values[i];
    }
    before += weight[i];
    place = middle;
    last = values[i];
  }
  return last;
}

}  // namespace myoid::inline ground::math
