#include "myoid/math/spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"

namespace myoid::math {
namespace {

constexpr std::array<double, 4> kFactorial{1.0, 1.0, 2.0, 6.0};

/// B-splines M_j of degree m - 1 over t_j .. t_{j+m} with unit integral: the divided difference of
/// order m is [t_j .. t_{j+m}] s = 1/m! * integral M_j s^(m) (Peano). Value of the `count` ones
/// that live on interval i.
double basis(const Eigen::VectorXd& t, Eigen::Index j, int m, double at, Eigen::Index interval) {
  if (interval < j || interval >= j + m) return 0.0;
  if (m == 1) return 1.0 / (t[j + 1] - t[j]);
  const double left = (at - t[j]) * basis(t, j, m - 1, at, interval);
  const double right = (t[j + m] - at) * basis(t, j + 1, m - 1, at, interval);
  return static_cast<double>(m) / (m - 1.0) * (left + right) / (t[j + m] - t[j]);
}

/// Symmetric band matrix by diagonals: a(j, d) = A(j, j + d), 0 <= d <= m.
using Band = Eigen::MatrixXd;

/// Gram matrix of the B-splines, divided by m!.
Band gram(const Eigen::VectorXd& t, int m) {
  const Eigen::Index count = t.size() - m;
  Band band = Band::Zero(count, m + 1);
  // Three Gauss points are exact to degree 5; the products have degree 2m - 2 <= 4.
  const double offset = std::sqrt(0.6);
  const std::array<double, 3> node{-offset, 0.0, offset};
  const std::array<double, 3> weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  for (Eigen::Index i = 0; i + 1 < t.size(); ++i) {
    const double half = 0.5 * (t[i + 1] - t[i]);
    const Eigen::Index first = std::max<Eigen::Index>(0, i - m + 1);
    const Eigen::Index last = std::min(count - 1, i);
    for (std::size_t g = 0; g < 3; ++g) {
      const double at = t[i] + half * (1.0 + node[g]);
      std::array<double, 3> value{};
      for (Eigen::Index j = first; j <= last; ++j)
        value[static_cast<std::size_t>(j - first)] = basis(t, j, m, at, i);
      for (Eigen::Index j = first; j <= last; ++j) {
        for (Eigen::Index k = j; k <= last; ++k) {
          band(j, k - j) += weight[g] * half * value[static_cast<std::size_t>(j - first)] *
                            value[static_cast<std::size_t>(k - first)] /
                            kFactorial[static_cast<std::size_t>(m)];
        }
      }
    }
  }
  return band;
}

/// Coefficients of the divided difference of order m that begins at each knot: (n - m) x (m + 1).
Eigen::MatrixXd divided_differences(const Eigen::VectorXd& t, int m) {
  const Eigen::Index count = t.size() - m;
  Eigen::MatrixXd q(count, m + 1);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (int k = 0; k <= m; ++k) {
      double product = 1.0;
      for (int l = 0; l <= m; ++l) {
        if (l != k) product *= t[j + k] - t[j + l];
      }
      q(j, k) = 1.0 / product;
    }
  }
  return q;
}

/// Solves A x = b for a symmetric positive definite band matrix by L D L'.
Eigen::VectorXd solve_band(Band a, Eigen::VectorXd b) {
  const Eigen::Index n = a.rows();
  const Eigen::Index m = a.cols() - 1;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index d = 1; d <= m && j + d < n; ++d) {
      const double l = a(j, d) / a(j, 0);
      for (Eigen::Index e = d; e <= m && j + e < n; ++e) a(j + d, e - d) -= l * a(j, e);
      b[j + d] -= l * b[j];
    }
  }
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    for (Eigen::Index d = 1; d <= m && j + d < n; ++d) b[j] -= a(j, d) * b[j + d];
    b[j] /= a(j, 0);
  }
  return b;
}

struct Fit {
  Eigen::VectorXd g;  ///< Spline values at the knots.
  Eigen::VectorXd c;  ///< s^(m) = sum c_j M_j.
};

/// (G/m! + lambda m! Q'Q) c = Q'y,  g = y - lambda m! Q c.
Fit fit(const Eigen::VectorXd& t,
        const Eigen::VectorXd& y,
        int m,
        double lambda,
        const Band& gram_band,
        const Eigen::MatrixXd& q) {
  const Eigen::Index count = q.rows();
  Band a = gram_band;
  Eigen::VectorXd right(count);
  const double factor = lambda * kFactorial[static_cast<std::size_t>(m)];
  for (Eigen::Index j = 0; j < count; ++j) {
    right[j] = q.row(j).dot(y.segment(j, m + 1));
    for (Eigen::Index d = 0; d <= m && j + d < count; ++d) {
      double product = 0.0;
      for (Eigen::Index k = d; k <= m; ++k) product += q(j, k) * q(j + d, k - d);
      a(j, d) += factor * product;
    }
  }
  // Equilibrate: uneven knots give rows of very different size.
  const Eigen::VectorXd scale = a.col(0).cwiseSqrt().cwiseInverse();
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index d = 0; d <= m && j + d < count; ++d) a(j, d) *= scale[j] * scale[j + d];
  }
  Fit result;
  result.c = scale.cwiseProduct(solve_band(std::move(a), scale.cwiseProduct(right)));
  result.g = y;
  for (Eigen::Index j = 0; j < count; ++j)
    result.g.segment(j, m + 1) -= factor * result.c[j] * q.row(j).transpose();
  (void)t;
  return result;
}

void check(const Eigen::VectorXd& t, const Eigen::VectorXd& y, Eigen::Index least) {
  if (t.size() != y.size())
    throw InvalidInput(fmt::format("spline: {} times for {} values", t.size(), y.size()));
  if (t.size() < least) {
    throw InvalidInput(
        fmt::format("spline: {} samples are too few; at least {} are needed", t.size(), least));
  }
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i]) || !std::isfinite(y[i])) {
      throw InvalidInput(
          fmt::format("spline: sample {} is not a number; fill the gaps first", i + 1));
    }
    if (i > 0 && !(t[i] > t[i - 1])) {
      throw InvalidInput(fmt::format(
          "spline: time does not increase at sample {} ({} s after {} s)", i + 1, t[i], t[i - 1]));
    }
  }
}

/// Polynomial of s^(m) on interval i by rising power of (t - t_i): degree m - 1, found from m
/// points.
std::array<double, 3> highest_derivative(const Eigen::VectorXd& t,
                                         const Eigen::VectorXd& c,
                                         int m,
                                         Eigen::Index i) {
  const double h = t[i + 1] - t[i];
  const auto value = [&](double share) {
    double sum = 0.0;
    const Eigen::Index first = std::max<Eigen::Index>(0, i - m + 1);
    const Eigen::Index last = std::min<Eigen::Index>(c.size() - 1, i);
    for (Eigen::Index j = first; j <= last; ++j) sum += c[j] * basis(t, j, m, t[i] + share * h, i);
    return sum;
  };
  if (m == 1) return {value(0.5), 0.0, 0.0};
  if (m == 2) {
    const double v0 = value(0.0);
    return {v0, (value(1.0) - v0) / h, 0.0};
  }
  const double v0 = value(0.0);
  const double v1 = value(0.5);
  const double v2 = value(1.0);
  return {v0, (-3.0 * v0 + 4.0 * v1 - v2) / h, 2.0 * (v0 - 2.0 * v1 + v2) / (h * h)};
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

SplineValue horner(const Eigen::Ref<const Eigen::VectorXd>& a, double u) {
  SplineValue v;
  for (Eigen::Index k = 5; k >= 0; --k) {
    v.second = v.second * u + 2.0 * v.first;
    v.first = v.first * u + v.value;
    v.value = v.value * u + a[k];
  }
  return v;
}

}  // namespace

Spline::Spline(const Eigen::VectorXd& t, const Eigen::VectorXd& g, const Eigen::VectorXd& c, int m)
    : knots_(t), coefficients_(Eigen::MatrixXd::Zero(6, t.size() + 1)) {
  const Eigen::Index n = t.size();
  const auto tail = [&](Eigen::Index i) { return integrate(highest_derivative(t, c, m, i), m); };
  std::array<double, 3> here = tail(0);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    auto a = coefficients_.col(i + 1);
    a[0] = g[i];
    for (int k = 0; k < m; ++k) a[m + k] = here[static_cast<std::size_t>(k)];
    const double h = t[i + 1] - t[i];
    const double particular = horner(a, h).value - g[i];
    const std::array<double, 3> next = i + 2 < n ? tail(i + 1) : std::array<double, 3>{};
    if (m == 2) {
      a[1] = (g[i + 1] - g[i] - particular) / h;
    } else if (m == 3 && i + 2 < n) {
      // Slope and curvature from the values at the next two knots; s''' is known on both intervals.
      const double h2 = t[i + 2] - t[i + 1];
      const SplineValue end = horner(a, h);
      const double onward = ((next[2] * h2 + next[1]) * h2 + next[0]) * h2 * h2 * h2;
      const double particular2 =
          end.value - g[i] + end.first * h2 + 0.5 * end.second * h2 * h2 + onward;
      const double total = h + h2;
      const double d1 = (g[i + 1] - g[i] - particular) / h;
      const double d2 = (g[i + 2] - g[i] - particular2) / total;
      a[2] = (d2 - d1) / h2;
      a[1] = d1 - a[2] * h;
    } else if (m == 3) {
      const SplineValue end = horner(coefficients_.col(i), t[i] - t[i - 1]);
      a[2] = 0.5 * end.second;
      a[1] = (g[i + 1] - g[i] - particular) / h - a[2] * h;
    }
    here = next;
  }
  // Beyond the ends s^(m) vanishes.
  const SplineValue first = horner(coefficients_.col(1), 0.0);
  const SplineValue last = horner(coefficients_.col(n - 1), t[n - 1] - t[n - 2]);
  coefficients_.col(0).head(3) << first.value, (m > 1 ? first.first : 0.0),
      (m > 2 ? 0.5 * first.second : 0.0);
  coefficients_.col(n).head(3) << last.value, (m > 1 ? last.first : 0.0),
      (m > 2 ? 0.5 * last.second : 0.0);
}

Spline Spline::interpolate(const Eigen::Ref<const Eigen::VectorXd>& t,
                           const Eigen::Ref<const Eigen::VectorXd>& y,
                           int degree) {
  if (degree != 1 && degree != 3 && degree != 5) {
    throw InvalidInput(fmt::format("spline: found degree {}, expected 1, 3 or 5", degree));
  }
  const int m = (degree + 1) / 2;
  check(t, y, m + 1);
  const Eigen::VectorXd times = t;
  const Fit result = fit(times, y, m, 0.0, gram(times, m), divided_differences(times, m));
  return {times, y, result.c, m};
}

Spline Spline::smooth(const Eigen::Ref<const Eigen::VectorXd>& t,
                      const Eigen::Ref<const Eigen::VectorXd>& y,
                      const SmoothingOptions& options) {
  constexpr int m = 3;
  check(t, y, m + 1);
  if (options.cutoff_hz.has_value() == options.noise_sd.has_value()) {
    throw InvalidInput("smoothing spline: give exactly one of cutoff_hz and noise_sd");
  }
  const Eigen::VectorXd times = t;
  const Eigen::VectorXd values = y;
  const double h = (times[times.size() - 1] - times[0]) / static_cast<double>(times.size() - 1);
  const Band gram_band = gram(times, m);
  const Eigen::MatrixXd q = divided_differences(times, m);
  const auto lambda_of = [&](double cutoff_hz) {
    return (std::sqrt(2.0) - 1.0) / (h * std::pow(2.0 * kPi * cutoff_hz, 6));
  };
  double lambda = 0.0;
  if (options.cutoff_hz) {
    if (!(*options.cutoff_hz > 0.0)) {
      throw InvalidInput(
          fmt::format("smoothing spline: found a cut-off of {} Hz, expected a positive one",
                      *options.cutoff_hz));
    }
    lambda = lambda_of(*options.cutoff_hz);
  } else {
    if (!(*options.noise_sd >= 0.0)) {
      throw InvalidInput(fmt::format("smoothing spline: found a noise of {}, expected 0 or more",
                                     *options.noise_sd));
    }
    // The residual rises with lambda: bisect its logarithm between cut-offs of the whole record and
    // half the rate.
    double low = std::log(lambda_of(0.5 / h));
    double high = std::log(lambda_of(0.1 / (h * static_cast<double>(times.size()))));
    const double wanted = *options.noise_sd * *options.noise_sd * static_cast<double>(times.size());
    for (int step = 0; step < 60 && high - low > 1e-3; ++step) {
      const double middle = 0.5 * (low + high);
      const Fit trial = fit(times, values, m, std::exp(middle), gram_band, q);
      ((trial.g - values).squaredNorm() > wanted ? high : low) = middle;
    }
    lambda = std::exp(low);
  }
  const Fit result = fit(times, values, m, lambda, gram_band, q);
  return {times, result.g, result.c, m};
}

SplineValue Spline::at(double t) const {
  const double* begin = knots_.data();
  const Eigen::Index interval = std::upper_bound(begin, begin + knots_.size(), t) - begin;
  const double left = knots_[std::max<Eigen::Index>(0, interval - 1)];
  // The last knot itself belongs to the last interval's polynomial as well as to the one beyond:
  // same value.
  return horner(coefficients_.col(interval), t - left);
}

SplineValues Spline::evaluate(const Eigen::Ref<const Eigen::VectorXd>& t) const {
  SplineValues values{Eigen::VectorXd(t.size()), Eigen::VectorXd(t.size()),
                      Eigen::VectorXd(t.size())};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const SplineValue v = at(t[i]);
    values.value[i] = v.value;
    values.first[i] = v.first;
    values.second[i] = v.second;
  }
  return values;
}

}  // namespace myoid::math
