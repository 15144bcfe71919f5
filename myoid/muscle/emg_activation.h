#pragma once

#include <Eigen/Core>

namespace myoid::muscle {

/// Shapes of the relation between normalized EMG and activation. All give 0 at 0 and 1 at 1, except
/// `fregly_activation` (see there).

/// Lloyd & Besier (2003): (exp(A u) - 1) / (exp(A) - 1), with shape A in (-3, 0]; linear at A = 0,
/// where a series is used.
[[nodiscard]] double shaped_activation(double normalized_emg, double shape);

/// Manal & Buchanan (2003): alpha ln(beta u + 1) up to the node, a line from there to (1, 1),
/// joined with one slope. The node of shape A in (0, 0.12] is (0.3085 - 0.7071 A, 0.3085 + 0.7071
/// A); A = 0 is linear. The constants follow from A, once.
class LogLinearActivation {
 public:
  /// Throws InvalidInput unless the shape lies in 0..0.12.
  explicit LogLinearActivation(double shape);
  [[nodiscard]] double operator()(double normalized_emg) const;

 private:
  double node_ = 0.0;
  double alpha_ = 0.0;
  double beta_ = 0.0;
  double slope_ = 1.0;
};

/// The non-linearity of the Rice University group's pipeline (Fregly and others): (1 - c) n + c (g4
/// / (g1 (n + g6)^g5 + g2) + g3), c in 0..0.35, with their six constants. At c = 0.35 it is 2e-6 at
/// n = 0 and 1 - 2e-6 at n = 1.
[[nodiscard]] double fregly_activation(double neural_activation, double nonlinearity);

/// The second-order critically or over-damped response to the EMG envelope (Buchanan et al. 2004):
/// two lags with these time constants, gain 1 at rest, exact for an envelope that is held between
/// samples in each lag. It is the recursion a_k = alpha e_k - b1 a_(k-1) - b2 a_(k-2) with poles
/// exp(-dt/tau); written with time constants, because those coefficients change their meaning with
/// the rate. Starts at rest on the first value. Throws InvalidInput unless the rate and the times
/// are positive.
[[nodiscard]] Eigen::VectorXd two_lag_activation(const Eigen::Ref<const Eigen::VectorXd>& envelope,
                                                 double rate_hz,
                                                 double first_time_s,
                                                 double second_time_s);

}  // namespace myoid::muscle
