#pragma once

#include <string_view>

#include <Eigen/Core>

namespace myoid::inline ground::math {

/// A curve through samples of uneven spacing that neither overshoots nor adds wiggles. It is cubic between samples,
/// with the slopes of Fritsch & Butland (1984), SIAM J Sci Stat Comput 5:300-304: zero at extrema, else a weighted
/// harmonic mean of the neighboring slopes. The first derivative is continuous. Beyond its ends the curve is constant.
class ShapePreservingCurve {
 public:
  struct Point {
    double value = 0.0;
    double slope = 0.0;  ///< d/dt
  };

  /// Throws InvalidInput, naming `what`, unless there are at least two samples, times strictly
  /// increase and all is finite.
  ShapePreservingCurve(const Eigen::Ref<const Eigen::VectorXd>& time_s,
                       const Eigen::Ref<const Eigen::VectorXd>& values,
                       std::string_view what);

  [[nodiscard]] Point at(double time_s) const;
  [[nodiscard]] const Eigen::VectorXd& time_s() const { return time_; }

 private:
  Eigen::VectorXd time_, value_, slope_;
};

}  // namespace myoid::inline ground::math
