#include "myoid/body/model/multi_polynomial.h"

namespace myoid::body {

double term_count(int dimension, int degree) {
  double count = 1.0;
  for (int k = 1; k <= degree; ++k) count = count * (dimension + k) / k;
  return count;
}

MultiPolynomialValue evaluate(const MultiPolynomial& polynomial, const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Eigen::Index n = polynomial.dimension;
  MultiPolynomialValue result{0.0, Eigen::VectorXd::Zero(n)};
  Eigen::MatrixXd power(n, polynomial.degree + 1);
  power.col(0).setOnes();
  for (Eigen::Index e = 1; e < power.cols(); ++e) power.col(e) = power.col(e - 1).cwiseProduct(x);
  Eigen::VectorXi exponent = Eigen::VectorXi::Zero(n);
  for (const double coefficient : polynomial.coefficients) {
    double term = coefficient * polynomial.scale;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (exponent[k] == 0) continue;
      double slope = coefficient * polynomial.scale * exponent[k] * power(k, exponent[k] - 1);
      for (Eigen::Index j = 0; j < n; ++j)
        if (j != k) slope *= power(j, exponent[j]);
      result.gradient[k] += slope;
      term *= power(k, exponent[k]);
    }
    result.value += term;
    // The next exponents: the last one that may grow does, and the ones behind it restart at zero.
    Eigen::Index k = n - 1;
    for (int sum = exponent.sum(); k >= 0 && sum >= polynomial.degree; --k) {
      sum -= exponent[k];
      exponent[k] = 0;
    }
    if (k >= 0) ++exponent[k];
  }
  return result;
}

}  // namespace myoid::body
