#include "myoid/ground/math/spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/natural_basis.h"

namespace myoid::inline ground::math {
namespace {

struct Fit {
  Eigen::VectorXd g;  ///< Spline values at the knots.
  Eigen::VectorXd c;  ///< s^(m) = sum c_j M_j.
};

/// Factors G/m! + lambda m! Q'Q.
BandFactor penalized(const NaturalBasis& basis, double lambda) {
  Eigen::MatrixXd a = basis.gram;
  if (lambda == 0.0) return BandFactor(std::move(a));
  const int m = basis.m;
  const Eigen::MatrixXd& q = basis.difference;
  const double factor = lambda * kFactorial[static_cast<std::size_t>(m)];
  for (Eigen::Index j = 0; j < a.rows(); ++j) {
    for (Eigen::Index d = 0; d <= m && j + d < a.rows(); ++d) {
      double product = 0.0;
      for (Eigen::Index k = d; k <= m; ++k) product += q(j, k) * q(j + d, k - d);
      a(j, d) += factor * product;
    }
  }
  return BandFactor(std::move(a));
}

/// Solves (G/m! + lambda m! Q'Q) c = Q'y,  g = y - lambda m! Q c.
Fit fit(const NaturalBasis& basis, const BandFactor& system, double lambda, const Eigen::VectorXd& y) {
  const int m = basis.m;
  const Eigen::MatrixXd& q = basis.difference;
  const Eigen::Index count = q.rows();
  Eigen::VectorXd right(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    double sum = 0.0;
    for (int k = 0; k <= m; ++k) sum += q(j, k) * y[j + k];
    right[j] = sum;
  }
  Fit result{y, system.solve(std::move(right))};
  if (lambda == 0.0) return result;
  const double factor = lambda * kFactorial[static_cast<std::size_t>(m)];
  for (Eigen::Index j = 0; j < count; ++j) result.g.segment(j, m + 1) -= factor * result.c[j] * q.row(j).transpose();
  return result;
}

void check_times(const Eigen::VectorXd& t, Eigen::Index least) {
  if (t.size() < least) {
    throw InvalidInput(fmt::format("spline: {} samples are too few; at least {} are needed", t.size(), least));
  }
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i])) throw InvalidInput(fmt::format("spline: time {} is not a number", i + 1));
    if (i > 0 && !(t[i] > t[i - 1])) {
      throw InvalidInput(
          fmt::format("spline: time does not increase at sample {} ({} s after {} s)", i + 1, t[i], t[i - 1]));
    }
  }
}

void check_values(const Eigen::VectorXd& t, const Eigen::VectorXd& y) {
  if (t.size() != y.size()) throw InvalidInput(fmt::format("spline: {} times for {} values", t.size(), y.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    if (!std::isfinite(y[i])) {
      throw InvalidInput(fmt::format("spline: sample {} is not a number; fill the gaps first", i + 1));
    }
  }
}

/// Integrates a polynomial of degree m - 1 m times from 0: coefficients of u^m .. u^(2m-1).
std::array<double, 3> integrate(const std::array<double, 3>& p, int m) {
  std::array<double, 3> result{};
  for (int k = 0; k < m; ++k) {
    double divisor = 1.0;
    for (int i = 1; i <= m; ++i) divisor *= k + i;
    result[static_cast<std::size_t>(k)] = p[static_cast<std::size_t>(k)] / divisor;
  }
  return result;
}

/// Evaluates the polynomial of column `i` at u.
SplineValue horner(const Eigen::MatrixXd& coefficients, Eigen::Index i, double u) {
  SplineValue v;
  const double* a = &coefficients(0, i);
  for (Eigen::Index k = coefficients.rows() - 1; k >= 0; --k) {
    v.second = v.second * u + 2.0 * v.first;
    v.first = v.first * u + v.value;
    v.value = v.value * u + a[k];
  }
  return v;
}

}  // namespace

Spline::Spline(const NaturalBasis& basis, const Eigen::VectorXd& g, const Eigen::VectorXd& c)
    : knots_(basis.knots), coefficients_(2 * basis.m, basis.knots.size() + 1) {
  const int m = basis.m;
  const Eigen::VectorXd& t = knots_;
  const Eigen::Index n = t.size();
  const auto tail = [&](Eigen::Index i) { return integrate(highest_derivative(basis, c, i), m); };
  coefficients_.setZero();
  std::array<double, 3> here = tail(0);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    double* a = &coefficients_(0, i + 1);
    a[0] = g[i];
    for (int k = 0; k < m; ++k) a[m + k] = here[static_cast<std::size_t>(k)];
    const double h = t[i + 1] - t[i];
    // The part of the highest derivative at the next knot.
    const double particular = horner(coefficients_, i + 1, h).value - g[i];
    const std::array<double, 3> next = i + 2 < n ? tail(i + 1) : std::array<double, 3>{};
    if (m == 2) {
      a[1] = (g[i + 1] - g[i] - particular) / h;
    } else if (m == 3 && i + 2 < n) {
      // Slope and curvature follow from the values at the next two knots, since s''' is known on both intervals.
      const double h2 = t[i + 2] - t[i + 1];
      const SplineValue end = horner(coefficients_, i + 1, h);
      const double onward = ((next[2] * h2 + next[1]) * h2 + next[0]) * h2 * h2 * h2;
      const double particular2 = end.value - g[i] + end.first * h2 + 0.5 * end.second * h2 * h2 + onward;
      const double total = h + h2;
      const double d1 = (g[i + 1] - g[i] - particular) / h;
      const double d2 = (g[i + 2] - g[i] - particular2) / total;
      a[2] = (d2 - d1) / h2;
      a[1] = d1 - a[2] * h;
    } else if (m == 3) {
      const SplineValue end = horner(coefficients_, i, t[i] - t[i - 1]);
      a[2] = 0.5 * end.second;
      a[1] = (g[i + 1] - g[i] - particular) / h - a[2] * h;
    }
    here = next;
  }
  // Beyond the ends s^(m) vanishes.
  const SplineValue first = horner(coefficients_, 1, 0.0);
  const SplineValue last = horner(coefficients_, n - 1, t[n - 1] - t[n - 2]);
  const auto end = [&](Eigen::Index column, const SplineValue& v) {
    coefficients_(0, column) = v.value;
    if (m > 1) coefficients_(1, column) = v.first;
    if (m > 2) coefficients_(2, column) = 0.5 * v.second;
  };
  end(0, first);
  end(n, last);
}

SplineKnots::SplineKnots(const Eigen::Ref<const Eigen::VectorXd>& t, int degree) {
  if (degree != 1 && degree != 3 && degree != 5) {
    throw InvalidInput(fmt::format("spline: found degree {}, expected 1, 3 or 5", degree));
  }
  const int m = (degree + 1) / 2;
  const Eigen::VectorXd times = t;
  check_times(times, m + 1);
  basis_ = natural_basis(times, m);
  system_ = penalized(basis_, 0.0);
}

Spline SplineKnots::interpolate(const Eigen::Ref<const Eigen::VectorXd>& y) const {
  const Eigen::VectorXd values = y;
  check_values(basis_.knots, values);
  const Fit result = fit(basis_, system_, 0.0, values);
  return {basis_, result.g, result.c};
}

Spline Spline::interpolate(const Eigen::Ref<const Eigen::VectorXd>& t,
                           const Eigen::Ref<const Eigen::VectorXd>& y,
                           int degree) {
  return SplineKnots(t, degree).interpolate(y);
}

Spline Spline::smooth(const Eigen::Ref<const Eigen::VectorXd>& t,
                      const Eigen::Ref<const Eigen::VectorXd>& y,
                      const SmoothingOptions& options) {
  constexpr int m = 3;
  const Eigen::VectorXd times = t;
  const Eigen::VectorXd values = y;
  check_times(times, m + 1);
  check_values(times, values);
  if (options.cutoff_hz.has_value() == options.noise_sd.has_value()) {
    throw InvalidInput("smoothing spline: give exactly one of cutoff_hz and noise_sd");
  }
  const double h = (times[times.size() - 1] - times[0]) / static_cast<double>(times.size() - 1);
  const NaturalBasis basis = natural_basis(times, m);
  const auto fitted = [&](double lambda) { return fit(basis, penalized(basis, lambda), lambda, values); };
  const auto lambda_of = [&](double cutoff_hz) {
    return (std::sqrt(2.0) - 1.0) / (h * std::pow(2.0 * kPi * cutoff_hz, 6));
  };
  double lambda = 0.0;
  if (options.cutoff_hz) {
    if (!(*options.cutoff_hz > 0.0)) {
      throw InvalidInput(
          fmt::format("smoothing spline: found a cut-off of {} Hz, expected a positive one", *options.cutoff_hz));
    }
    lambda = lambda_of(*options.cutoff_hz);
  } else {
    if (!(*options.noise_sd >= 0.0)) {
      throw InvalidInput(fmt::format("smoothing spline: found a noise of {}, expected 0 or more", *options.noise_sd));
    }
    // The residual rises with lambda: bisect log(lambda) between cut-offs of the whole record and half the rate.
    double low = std::log(lambda_of(0.5 / h));
    double high = std::log(lambda_of(0.1 / (h * static_cast<double>(times.size()))));
    const double wanted = *options.noise_sd * *options.noise_sd * static_cast<double>(times.size());
    for (int step = 0; step < 60 && high - low > 1e-3; ++step) {
      const double middle = 0.5 * (low + high);
      const Fit trial = fitted(std::exp(middle));
      ((trial.g - values).squaredNorm() > wanted ? high : low) = middle;
    }
    lambda = std::exp(low);
  }
  const Fit result = fitted(lambda);
  return {basis, result.g, result.c};
}

SplineValue Spline::at(double t) const {
  const double* begin = knots_.data();
  const Eigen::Index interval = std::upper_bound(begin, begin + knots_.size(), t) - begin;
  const double left = knots_[std::max<Eigen::Index>(0, interval - 1)];
  // At the last knot the polynomials on both sides have the same value.
  return horner(coefficients_, interval, t - left);
}

SplineValues Spline::evaluate(const Eigen::Ref<const Eigen::VectorXd>& t) const {
  SplineValues values{Eigen::VectorXd(t.size()), Eigen::VectorXd(t.size()), Eigen::VectorXd(t.size())};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const SplineValue v = at(t[i]);
    values.value[i] = v.value;
    values.first[i] = v.first;
    values.second[i] = v.second;
  }
  return values;
}

}  // namespace myoid::inline ground::math
