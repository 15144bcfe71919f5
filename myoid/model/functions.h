#pragma once

#include <utility>
#include <variant>
#include <vector>

namespace myoid::model {

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
/// OpenSim's SimmSpline (also NaturalCubicSpline): cubic, third derivative at the ends from the
/// four outer points, linear beyond. b, c, d are the cubic coefficients per knot, filled by
/// `make_simm_spline`.
struct SimmSpline {
  std::vector<double> x, y, b, c, d;
};
/// Any of them times a factor (OpenSim's MultiplierFunction is folded into `scale`).
struct Function {
  std::variant<Constant, Linear, Polynomial, PiecewiseLinear, SimmSpline> form = Constant{};
  double scale = 1.0;
  Function() = default;
  template <typename Form>
  Function(Form f, double s = 1.0)
      : form(std::move(f)), scale(s) {}  // NOLINT(google-explicit-constructor)
};

/// Throws InvalidInput if sizes differ, fewer than two knots, or x does not increase.
[[nodiscard]] SimmSpline make_simm_spline(std::vector<double> x, std::vector<double> y);
[[nodiscard]] PiecewiseLinear make_piecewise_linear(std::vector<double> x, std::vector<double> y);
/// The natural cubic spline (second derivative 0 at the ends), linear beyond them: OpenSim's
/// GCVSpline of half order 2. Throws as make_simm_spline.
[[nodiscard]] SimmSpline make_natural_spline(std::vector<double> x, std::vector<double> y);

struct FunctionValue {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

/// Value and first two derivatives at x. No clamping; beyond the data as each form says.
[[nodiscard]] FunctionValue evaluate(const Function& function, double x);

}  // namespace myoid::model
