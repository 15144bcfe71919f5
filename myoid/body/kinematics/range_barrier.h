#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Keeps the clamped coordinates inside their ranges by a term of the objective,
///
///   B(q) = -weight sum ln(4 (q - lower) (upper - q) / (upper - lower)^2),
///
/// which is 0 in the middle of all ranges and infinite at an end (the logarithmic barrier of
/// interior-point methods: Nocedal and Wright, Numerical Optimization, 2006, ch. 19).
class RangeBarrier {
 public:
  RangeBarrier() = default;
  /// Builds a barrier for the coordinates of `free` that are clamped to a range.
  RangeBarrier(const body::BodyModel& model, const std::vector<Eigen::Index>& free);

  /// Sets the weight; 0 switches the barrier off.
  void set_weight(double weight) { weight_ = weight; }
  [[nodiscard]] bool acts() const { return weight_ > 0.0 && !ranges_.empty(); }

  /// Returns B at the coordinates of the whole model; infinite on and beyond an end.
  [[nodiscard]] double value(const Eigen::VectorXd& q) const;
  /// Adds the derivatives of B by the free coordinates; q inside the ranges.
  void add_derivatives(const Eigen::VectorXd& q, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const;
  /// Moves coordinates nearer to an end than `share` of the range, or beyond, to that distance.
  void move_inside(Eigen::VectorXd& q, double share) const;
  /// Returns the share of a step of the free coordinates that covers at most 0.99 of the way to any end; <= 1.
  [[nodiscard]] double longest_share(const Eigen::VectorXd& q, const Eigen::VectorXd& step) const;

 private:
  struct Range {
    Eigen::Index coordinate = 0, free = 0;
    double lower = 0.0, upper = 0.0;
  };
  std::vector<Range> ranges_;
  double weight_ = 0.0;
};

}  // namespace myoid::body
