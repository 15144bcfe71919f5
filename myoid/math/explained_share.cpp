#include "myoid/math/explained_share.h"

namespace myoid::math {

double explained_share(const Eigen::Ref<const Eigen::VectorXd>& predicted,
                       const Eigen::Ref<const Eigen::VectorXd>& measured) {
  const double square = measured.squaredNorm();
  const double varied = (measured.array() - measured.mean()).square().sum();
  const double total = varied > 1e-6 * square ? varied : square;
  return total > 0.0 ? 1.0 - (predicted - measured).squaredNorm() / total : 1.0;
}

}  // namespace myoid::math
