#include "myoid/ground/math/natural_basis.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace myoid::inline ground::math {
namespace {

using Polynomial = std::array<double, 3>;  ///< Coefficients of increasing powers.

/// Returns (a + b u) p.
Polynomial times_line(const Polynomial& p, double a, double b) {
  return {a * p[0], a * p[1] + b * p[0], a * p[2] + b * p[1]};
}

/// Returns the B-splines of orders 1 .. m on interval i, by the recursion
///   M_(j,k) = k / (k - 1) ((t - t_j) M_(j,k-1) + (t_(j+k) - t) M_(j+1,k-1)) / (t_(j+k) - t_j).
/// Element j - i + m - 1; zero where M_j does not exist.
std::array<Polynomial, 3> pieces_on(const Eigen::VectorXd& t, int m, Eigen::Index i) {
  std::array<Polynomial, 4> M{};  // of the present order; the last stays zero
  const auto place = [&](Eigen::Index j) { return static_cast<std::size_t>(j - i + m - 1); };
  M[place(i)] = {1.0 / (t[i + 1] - t[i]), 0.0, 0.0};
  for (int k = 2; k <= m; ++k) {
    for (Eigen::Index j = i - k + 1; j <= i; ++j) {
      if (j < 0 || j + k >= t.size()) continue;
      const double factor = static_cast<double>(k) / (k - 1.0) / (t[j + k] - t[j]);
      const Polynomial left = times_line(M[place(j)], t[i] - t[j], 1.0);
      const Polynomial right = times_line(M[place(j) + 1], t[j + k] - t[i], -1.0);
      for (std::size_t p = 0; p < 3; ++p) M[place(j)][p] = factor * (left[p] + right[p]);
    }
  }
  return {M[0], M[1], M[2]};
}

double value_at(const double* piece, int m, double u) {
  double value = 0.0;
  for (int p = m - 1; p >= 0; --p) value = value * u + piece[p];
  return value;
}

}  // namespace

NaturalBasis natural_basis(const Eigen::VectorXd& t, int m) {
  const Eigen::Index n = t.size();
  const Eigen::Index count = n - m;
  NaturalBasis b{m, t, Eigen::MatrixXd::Zero(m * m, n - 1), Eigen::MatrixXd::Zero(count, m + 1),
                 Eigen::MatrixXd(count, m + 1)};
  // Three Gauss points are exact to degree 5; the products have degree 2m - 2 <= 4.
  const double offset = std::sqrt(0.6);
  const std::array<double, 3> node{-offset, 0.0, offset};
  const std::array<double, 3> weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const std::array<Polynomial, 3> pieces = pieces_on(t, m, i);
    const Eigen::Index first = std::max<Eigen::Index>(0, i - m + 1);
    const Eigen::Index last = std::min(count - 1, i);
    for (Eigen::Index j = first; j <= last; ++j) {
      for (int p = 0; p < m; ++p) {
        b.pieces((j - i + m - 1) * m + p, i) =
            pieces[static_cast<std::size_t>(j - i + m - 1)][static_cast<std::size_t>(p)];
      }
    }
    const double half = 0.5 * (t[i + 1] - t[i]);
    for (std::size_t g = 0; g < 3; ++g) {
      const double u = half * (1.0 + node[g]);
      std::array<double, 3> value{};
      for (Eigen::Index j = first; j <= last; ++j)
        value[static_cast<std::size_t>(j - first)] = value_at(&b.pieces((j - i + m - 1) * m, i), m, u);
      for (Eigen::Index j = first; j <= last; ++j) {
        for (Eigen::Index k = j; k <= last; ++k) {
          b.gram(j, k - j) += weight[g] * half * value[static_cast<std::size_t>(j - first)] *
                              value[static_cast<std::size_t>(k - first)] / kFactorial[static_cast<std::size_t>(m)];
        }
      }
    }
  }
  for (Eigen::Index j = 0; j < count; ++j) {
    for (int k = 0; k <= m; ++k) {
      double product = 1.0;
      for (int l = 0; l <= m; ++l) {
        if (l != k) product *= t[j + k] - t[j + l];
      }
      b.difference(j, k) = 1.0 / product;
    }
  }
  return b;
}

std::array<double, 3> highest_derivative(const NaturalBasis& basis, const Eigen::VectorXd& c, Eigen::Index i) {
  std::array<double, 3> sum{};
  const int m = basis.m;
  const Eigen::Index first = std::max<Eigen::Index>(0, i - m + 1);
  const Eigen::Index last = std::min<Eigen::Index>(c.size() - 1, i);
  for (Eigen::Index j = first; j <= last; ++j) {
    const double* piece = &basis.pieces((j - i + m - 1) * m, i);
    for (int p = 0; p < m; ++p) sum[static_cast<std::size_t>(p)] += c[j] * piece[p];
  }
  return sum;
}

BandFactor::BandFactor(Eigen::MatrixXd band) : factor_(std::move(band)) {
  Eigen::MatrixXd& a = factor_;
  const Eigen::Index n = a.rows();
  const Eigen::Index m = a.cols() - 1;
  scale_ = a.col(0).cwiseSqrt().cwiseInverse();
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index d = 0; d <= m && j + d < n; ++d) a(j, d) *= scale_[j] * scale_[j + d];
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    const double inverse = 1.0 / a(j, 0);
    for (Eigen::Index d = 1; d <= m && j + d < n; ++d) {
      const double l = a(j, d) * inverse;
      for (Eigen::Index e = d; e <= m && j + e < n; ++e) a(j + d, e - d) -= l * a(j, e);
    }
    for (Eigen::Index d = 1; d <= m; ++d) a(j, d) *= inverse;
    a(j, 0) = inverse;
  }
}

Eigen::VectorXd BandFactor::solve(Eigen::VectorXd b) const {
  const Eigen::Index n = factor_.rows();
  const Eigen::Index m = factor_.cols() - 1;
  b.array() *= scale_.array();
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index d = 1; d <= m && j + d < n; ++d) b[j + d] -= factor_(j, d) * b[j];
  }
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    b[j] *= factor_(j, 0);
    for (Eigen::Index d = 1; d <= m && j + d < n; ++d) b[j] -= factor_(j, d) * b[j + d];
  }
  b.array() *= scale_.array();
  return b;
}

}  // namespace myoid::inline ground::math
