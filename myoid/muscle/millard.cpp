#include "myoid/muscle/millard.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

/// Maps the published curviness 0..1 to 0.1..0.9: at 0 a corner would have no length.
double scaled(double curviness) {
  if (!(curviness >= 0.0 && curviness <= 1.0)) {
    throw InvalidInput(fmt::format("a curviness of {:g}: expected 0 to 1", curviness));
  }
  return 0.1 + 0.8 * curviness;
}

BezierCurve force_length_curve(const MillardActive& s) {
  const double shoulder = 0.05;  // half the width of the plateau
  const double x0 = s.shortest_length;
  const double x1 = s.transition_length;
  const double x3 = s.longest_length;
  const double at_shoulder = 1.0 - shoulder;
  const double y1 = 1.0 - s.shallow_slope * (at_shoulder - x1);
  const std::array<CurveKnot, 6> knots{{{x0, s.minimum, 0.0},
                                        {0.5 * (x0 + x1), 0.5 * y1, 1.25 * y1 / (x1 - x0)},
                                        {0.5 * (x1 + at_shoulder), 0.5 * (1.0 + y1), s.shallow_slope},
                                        {1.0, 1.0, 0.0},
                                        {0.5 * (1.0 + shoulder + x3), 0.5, -1.0 / (x3 - shoulder - (1.0 + shoulder))},
                                        {x3, s.minimum, 0.0}}};
  const std::array<double, 5> curviness{0.9, 0.9, 0.9, 0.9, 0.9};
  return BezierCurve(knots, curviness);
}

BezierCurve force_velocity_curve(const MillardVelocity& s) {
  const double near_shortening = 0.05 * (s.slope_near_shortening_limit + s.slope_at_shortening_limit);
  const double near_lengthening =
      s.max_eccentric_multiplier - 0.05 * (s.slope_near_lengthening_limit + s.slope_at_lengthening_limit);
  const std::array<CurveKnot, 5> knots{{{-1.0, 0.0, s.slope_at_shortening_limit},
                                        {-0.9, near_shortening, s.slope_near_shortening_limit},
                                        {0.0, 1.0, s.slope_at_rest},
                                        {0.9, near_lengthening, s.slope_near_lengthening_limit},
                                        {1.0, s.max_eccentric_multiplier, s.slope_at_lengthening_limit}}};
  const double concentric = scaled(s.concentric_curviness);
  const double eccentric = scaled(s.eccentric_curviness);
  const std::array<double, 4> curviness{concentric, concentric, eccentric, eccentric};
  return BezierCurve(knots, curviness);
}

BezierCurve passive_curve(const MillardPassive& s) {
  const double x0 = 1.0 + s.strain_at_zero;
  const double x1 = 1.0 + s.strain_at_one;
  const double foot = 0.1 * std::min(1.0 / s.stiffness_at_one, x1 - x0);
  const std::array<CurveKnot, 3> knots{
      {{x0, 0.0, 0.0}, {x0 + foot, 0.5 * s.stiffness_low * foot, s.stiffness_low}, {x1, 1.0, s.stiffness_at_one}}};
  const double c = scaled(s.curviness);
  const std::array<double, 2> curviness{c, c};
  return BezierCurve(knots, curviness);
}

BezierCurve tendon_curve(const MillardTendon& s) {
  const double k = s.stiffness_at_one;
  const double toe_x = 1.0 + (s.toe_force - 1.0) / k;
  const double middle_x = 1.0 + (0.5 * s.toe_force - 1.0) / k;
  const double foot = 0.1 * toe_x;
  const double slope = 0.5 * s.toe_force / (middle_x - foot);
  const double control_x = 0.5 * (foot + middle_x);
  const std::array<CurveKnot, 3> knots{
      {{0.0, 0.0, 0.0}, {control_x, slope * (control_x - foot), slope}, {toe_x, s.toe_force, k}}};
  const double c = scaled(s.curviness);
  const std::array<double, 2> curviness{c, c};
  return BezierCurve(knots, curviness);
}

}  // namespace

MillardCurves::MillardCurves(const MillardShape& shape)
    : force_length(force_length_curve(shape.active)),
      force_velocity(force_velocity_curve(shape.velocity)),
      passive(passive_curve(shape.passive)),
      tendon(tendon_curve(shape.tendon)) {}

}  // namespace myoid::muscle
