#include "myoid/body/model/functions.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

FunctionValue form_value(const Constant& f, double) { return {f.value, 0.0, 0.0}; }

FunctionValue form_value(const Linear& f, double x) { return {f.slope * x + f.intercept, f.slope, 0.0}; }

FunctionValue form_value(const Polynomial& f, double x) { return polynomial_value(f.coefficients, x); }

/// Returns the interval that holds x, 0 .. n-2; the outer intervals extend to infinity.
std::size_t interval(const std::vector<double>& knots, double x) {
  const auto upper = std::upper_bound(knots.begin(), knots.end(), x);
  const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, upper - knots.begin() - 1));
  return std::min(index, knots.size() - 2);
}

FunctionValue form_value(const PiecewiseLinear& f, double x) {
  const std::size_t i = interval(f.x, x);
  const double slope = (f.y[i + 1] - f.y[i]) / (f.x[i + 1] - f.x[i]);
  return {f.y[i] + slope * (x - f.x[i]), slope, 0.0};
}

FunctionValue form_value(const SimmSpline& f, double x) {
  const std::size_t last = f.x.size() - 1;
  if (x < f.x.front()) return {f.y.front() + f.b.front() * (x - f.x.front()), f.b.front(), 0.0};
  if (x > f.x.back()) return {f.y[last] + f.b[last] * (x - f.x[last]), f.b[last], 0.0};
  const std::size_t i = interval(f.x, x);
  const double u = x - f.x[i];
  return {f.y[i] + u * (f.b[i] + u * (f.c[i] + u * f.d[i])), f.b[i] + u * (2.0 * f.c[i] + 3.0 * u * f.d[i]),
          2.0 * f.c[i] + 6.0 * u * f.d[i]};
}

FunctionValue form_value(const PiecewiseConstant& f, double x) {
  const auto upper = std::upper_bound(f.x.begin(), f.x.end(), x);
  const auto index = std::max<std::ptrdiff_t>(0, upper - f.x.begin() - 1);
  return {f.y[static_cast<std::size_t>(index)], 0.0, 0.0};
}

FunctionValue form_value(const Sine& f, double x) {
  const double sine = f.amplitude * std::sin(f.omega * x + f.phase);
  const double cosine = f.amplitude * std::cos(f.omega * x + f.phase);
  return {f.offset + sine, f.omega * cosine, -f.omega * f.omega * sine};
}

FunctionValue form_value(const SmoothStep& f, double x) {
  const double width = f.end - f.start;
  const double s = std::clamp((x - f.start) / width, 0.0, 1.0);
  const double height = f.end_value - f.start_value;
  return {f.start_value + height * s * s * s * (10.0 + s * (-15.0 + 6.0 * s)),
          height / width * 30.0 * s * s * (1.0 - s) * (1.0 - s),
          height / (width * width) * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)};
}

FunctionValue form_value(const math::Spline& f, double x) { return f.at(x); }

FunctionValue form_value(const PiecewisePolynomial& f, double x) {
  const auto column = std::upper_bound(f.x.begin(), f.x.end(), x) - f.x.begin();
  const double u = x - f.x[static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, column - 1))];
  return polynomial_value(f.coefficients.col(column).reverse(), u);
}

void check_knots(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  if (n != y.size() || n < 2) {
    throw InvalidInput(fmt::format("spline function: {} x for {} y; at least two pairs are needed", n, y.size()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && !(x[i] > x[i - 1])) {
      throw InvalidInput(fmt::format("spline function: x does not increase ({} after {})", x[i], x[i - 1]));
    }
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw InvalidInput(fmt::format("spline function: ({}, {}) is not finite", x[i], y[i]));
  }
}

}  // namespace

PiecewiseLinear make_piecewise_linear(std::vector<double> x, std::vector<double> y) {
  check_knots(x, y);
  return {std::move(x), std::move(y)};
}

PiecewiseConstant make_piecewise_constant(std::vector<double> x, std::vector<double> y) {
  check_knots(x, y);
  return {std::move(x), std::move(y)};
}

math::Spline make_quintic_spline(const std::vector<double>& x, const std::vector<double>& y) {
  check_knots(x, y);
  const auto n = static_cast<Eigen::Index>(x.size());
  return math::Spline::interpolate(Eigen::Map<const Eigen::VectorXd>(x.data(), n),
                                   Eigen::Map<const Eigen::VectorXd>(y.data(), n), 5);
}

SimmSpline make_natural_spline(std::vector<double> x, std::vector<double> y) {
  check_knots(x, y);
  const std::size_t n = x.size();
  // Second derivatives m: tridiagonal, with m = 0 at both ends.
  std::vector<double> m(n, 0.0);
  std::vector<double> right(n, 0.0);
  std::vector<double> diagonal(n, 1.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left_h = x[i] - x[i - 1];
    const double right_h = x[i + 1] - x[i];
    diagonal[i] = 2.0 * (left_h + right_h);
    right[i] = 6.0 * ((y[i + 1] - y[i]) / right_h - (y[i] - y[i - 1]) / left_h);
    if (i > 1) {
      const double factor = left_h / diagonal[i - 1];
      diagonal[i] -= factor * left_h;
      right[i] -= factor * right[i - 1];
    }
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] = (right[i] - (x[i + 1] - x[i]) * m[i + 1]) / diagonal[i];
  SimmSpline s{std::move(x), std::move(y), std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = s.x[i + 1] - s.x[i];
    s.b[i] = (s.y[i + 1] - s.y[i]) / h - h * (2.0 * m[i] + m[i + 1]) / 6.0;
    s.c[i] = 0.5 * m[i];
    s.d[i] = (m[i + 1] - m[i]) / (6.0 * h);
  }
  const double h = s.x[n - 1] - s.x[n - 2];
  s.b[n - 1] = s.b[n - 2] + h * (2.0 * s.c[n - 2] + 3.0 * h * s.d[n - 2]);
  return s;
}

SimmSpline make_simm_spline(std::vector<double> x, std::vector<double> y) {
  check_knots(x, y);
  const std::size_t n = x.size();
  SimmSpline s{std::move(x), std::move(y), std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  auto& [xs, ys, b, c, d] = s;
  if (n == 2) {
    b[0] = b[1] = (ys[1] - ys[0]) / (xs[1] - xs[0]);
    return s;
  }
  // Tridiagonal system for c: b diagonal, d off-diagonal, c right side. The third derivative at the
  // ends comes from the four outer points; with three points it is taken as zero.
  const std::size_t last = n - 1;
  d[0] = xs[1] - xs[0];
  c[1] = (ys[1] - ys[0]) / d[0];
  for (std::size_t i = 1; i < last; ++i) {
    d[i] = xs[i + 1] - xs[i];
    b[i] = 2.0 * (d[i - 1] + d[i]);
    c[i + 1] = (ys[i + 1] - ys[i]) / d[i];
    c[i] = c[i + 1] - c[i];
  }
  b[0] = -d[0];
  b[last] = -d[last - 1];
  c[0] = 0.0;
  c[last] = 0.0;
  if (n > 3) {
    const double at_start = c[2] / (xs[3] - xs[1]) - c[1] / (xs[2] - xs[0]);
    const double at_end = c[last - 1] / (xs[last] - xs[last - 2]) - c[last - 2] / (xs[last - 1] - xs[last - 3]);
    c[0] = at_start * d[0] * d[0] / (xs[3] - xs[0]);
    c[last] = -at_end * d[last - 1] * d[last - 1] / (xs[last] - xs[last - 3]);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double t = d[i - 1] / b[i - 1];
    b[i] -= t * d[i - 1];
    c[i] -= t * c[i - 1];
  }
  c[last] /= b[last];
  for (std::size_t i = last; i-- > 0;) c[i] = (c[i] - d[i] * c[i + 1]) / b[i];
  b[last] = (ys[last] - ys[last - 1]) / d[last - 1] + d[last - 1] * (c[last - 1] + 2.0 * c[last]);
  for (std::size_t i = 0; i < last; ++i) {
    b[i] = (ys[i + 1] - ys[i]) / d[i] - d[i] * (c[i + 1] + 2.0 * c[i]);
    d[i] = (c[i + 1] - c[i]) / d[i];
    c[i] *= 3.0;
  }
  c[last] *= 3.0;
  d[last] = d[last - 1];
  return s;
}

PiecewisePolynomial make_septic_spline(const std::vector<double>& x, const std::vector<double>& y) {
  check_knots(x, y);
  const auto n = static_cast<Eigen::Index>(x.size());
  if (n < 4) throw InvalidInput(fmt::format("spline of degree 7: {} knots; four are needed", n));
  // Unknown: the eight coefficients of each interval, in powers of (x - left)/mean interval.
  const double unit = (x.back() - x.front()) / static_cast<double>(n - 1);
  const Eigen::Index unknowns = 8 * (n - 1);
  std::vector<Eigen::Triplet<double>> terms;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  Eigen::Index row = 0;
  // Adds `sign` times the derivative of order d, divided by d!, of interval i at u.
  const auto add = [&](Eigen::Index i, int d, double u, double sign) {
    double power = sign;
    for (int k = d; k < 8; ++k) {
      double binomial = 1.0;
      for (int j = 1; j <= d; ++j) binomial = binomial * (k - d + j) / j;
      terms.emplace_back(row, 8 * i + k, binomial * power);
      power *= u;
    }
  };
  for (int d = 4; d < 7; ++d, ++row) add(0, d, 0.0, 1.0);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double h = (x[at + 1] - x[at]) / unit;
    add(i, 0, 0.0, 1.0);
    right[row++] = y[at];
    add(i, 0, h, 1.0);
    right[row++] = y[at + 1];
    const bool is_last = i + 2 == n;
    for (int d = is_last ? 4 : 1; d < 7; ++d, ++row) {
      add(i, d, h, 1.0);
      if (!is_last) add(i + 1, d, 0.0, -1.0);
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(terms.begin(), terms.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(matrix);
  Eigen::VectorXd c = factor.solve(right);
  c += factor.solve(Eigen::VectorXd(right - matrix * c));  // corrects rounding errors
  if (!c.allFinite()) throw InvalidInput("spline of degree 7: its knots are too uneven");
  PiecewisePolynomial s{x, Eigen::MatrixXd::Zero(8, n + 1)};
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    for (Eigen::Index k = 0; k < 8; ++k)
      s.coefficients(k, i + 1) = c[8 * i + k] / std::pow(unit, static_cast<double>(k));
  // Beyond the ends the first and the last piece continue; their higher powers are zero there.
  s.coefficients.col(0).head(4) = s.coefficients.col(1).head(4);
  const double h = x.back() - x[x.size() - 2];
  for (int d = 0; d < 4; ++d) {
    double sum = 0.0, power = 1.0;
    for (int k = d; k < 8; ++k, power *= h) {
      double binomial = 1.0;
      for (int j = 1; j <= d; ++j) binomial = binomial * (k - d + j) / j;
      sum += binomial * power * s.coefficients(k, n - 1);
    }
    s.coefficients(d, n) = sum;
  }
  return s;
}

FunctionValue evaluate(const Function& function, double x) {
  FunctionValue v = std::visit([x](const auto& form) { return form_value(form, x); }, function.form);
  v.value *= function.scale;
  v.first *= function.scale;
  v.second *= function.scale;
  return v;
}

}  // namespace myoid::body
