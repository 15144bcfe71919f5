#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::body {

/// A polynomial of several variables up to a total degree (OpenSim's
/// MultivariatePolynomialFunction; a LinearFunction of several variables has degree 1). Terms in
/// the order of their exponents, the exponent of the last variable changing fastest: for two
/// variables up to degree 2, the coefficients of 1, y, y^2, x, x y, x^2.
struct MultiPolynomial {
  int dimension = 1;
  int degree = 0;
  std::vector<double> coefficients;
  double scale = 1.0;  ///< Factor of an enclosing MultiplierFunction.
};

/// Returns the number of terms: (dimension + degree)! / (dimension! degree!).
[[nodiscard]] double term_count(int dimension, int degree);

struct MultiPolynomialValue {
  double value = 0.0;
  Eigen::VectorXd gradient;
};

/// Returns value and gradient at x, one number for each variable. `coefficients` must have one for each term.
[[nodiscard]] MultiPolynomialValue evaluate(const MultiPolynomial& polynomial,
                                            const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace myoid::body
