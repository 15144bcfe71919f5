#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "myoid/ground/math/spline.h"

namespace myoid::body {

struct Constant {
  double value = 0.0;
};
struct Linear {
  double slope = 1.0;
  double intercept = 0.0;
};
struct Polynomial {
  std::vector<double> coefficients;
};  ///< Highest power first.
/// Linear between knots, linear beyond the ends. x strictly increases.
struct PiecewiseLinear {
  std::vector<double> x, y;
};
/// OpenSim's SimmSpline (also NaturalCubicSpline): cubic, third derivative at the ends from the four outer points,
/// linear beyond. b, c, d are the cubic coefficients per knot, filled by `make_simm_spline`.
struct SimmSpline {
  std::vector<double> x, y, b, c, d;
};
/// The value at the last knot that x has reached; beyond the ends the first and last value.
struct PiecewiseConstant {
  std::vector<double> x, y;
};
/// offset + amplitude sin(omega x + phase).
struct Sine {
  double amplitude = 1.0, omega = 1.0, phase = 0.0, offset = 0.0;
};
/// Polynomials between knots. Each column holds the coefficients of one interval by rising power of x - left knot; the
/// first column is for x below the first knot (powers of x - first knot), the last for x above the last knot.
struct PiecewisePolynomial {
  std::vector<double> x;
  Eigen::MatrixXd coefficients;
};
/// A step from `start_value` to `end_value` between two places, as 10 s^3 - 15 s^4 + 6 s^5.
struct SmoothStep {
  double start = 0.0, end = 1.0, start_value = 0.0, end_value = 1.0;
};
/// A function of one of these forms times a factor (OpenSim's MultiplierFunction).
struct Function {
  std::variant<Constant,
               Linear,
               Polynomial,
               PiecewiseLinear,
               SimmSpline,
               PiecewiseConstant,
               Sine,
               SmoothStep,
               math::Spline,
               PiecewisePolynomial>
      form = Constant{};
  double scale = 1.0;
  Function() = default;
  template <typename Form>
  Function(Form f, double s = 1.0) : form(std::move(f)), scale(s) {}  // NOLINT(google-explicit-constructor)
};

/// Throws InvalidInput if sizes differ, fewer than two knots, or x does not increase.
[[nodiscard]] SimmSpline make_simm_spline(std::vector<double> x, std::vector<double> y);
[[nodiscard]] PiecewiseLinear make_piecewise_linear(std::vector<double> x, std::vector<double> y);
[[nodiscard]] PiecewiseConstant make_piecewise_constant(std::vector<double> x, std::vector<double> y);
/// Returns the natural spline of degree 5 (OpenSim's GCVSpline of half order 3), a parabola beyond its ends.
[[nodiscard]] math::Spline make_quintic_spline(const std::vector<double>& x, const std::vector<double>& y);
/// Returns the natural cubic spline (second derivative 0 at the ends), linear beyond them:
/// OpenSim's GCVSpline of half order 2. Throws as make_simm_spline.
[[nodiscard]] SimmSpline make_natural_spline(std::vector<double> x, std::vector<double> y);

/// Returns the natural spline of degree 7 (fourth to sixth derivative 0 at the ends, a cubic beyond
/// them): OpenSim's GCVSpline of half order 4. Four knots or more; throws as make_simm_spline.
[[nodiscard]] PiecewisePolynomial make_septic_spline(const std::vector<double>& x, const std::vector<double>& y);

/// Value and first two derivatives.
using FunctionValue = math::SplineValue;

/// Returns the polynomial with these coefficients, highest power first, by Horner's rule.
template <typename Coefficients>
[[nodiscard]] FunctionValue polynomial_value(const Coefficients& coefficients, double x) {
  FunctionValue v;
  for (const double c : coefficients) {
    v.second = v.second * x + 2.0 * v.first;
    v.first = v.first * x + v.value;
    v.value = v.value * x + c;
  }
  return v;
}

/// Returns value and first two derivatives at x. Each form defines its values beyond the data.
[[nodiscard]] FunctionValue evaluate(const Function& function, double x);

}  // namespace myoid::body
