#include "myoid/muscle/literature.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::muscle {

HillParameters<double> literature_parameters(const LiteratureMuscle& muscle) {
  const double l0_m = muscle.optimal_fiber_length_m;
  HillParameters<double> p;
  p.max_isometric_force_n = muscle.max_isometric_force_n;
  p.optimal_fiber_length_m = l0_m;
  p.force_length_width_m = kLiteratureWidth * l0_m;
  p.concentric_curvature = kLiteratureCurvature;
  p.eccentric_curvature_product = curvature_product_from_slope_ratio(
      kLiteratureSlopeRatio, kLiteratureCurvature, kLiteraturePlateau);
  p.eccentric_plateau = kLiteraturePlateau;
  p.max_shortening_speed_mps = kLiteratureSpeed * l0_m;
  p.tendon_slack_length_m = muscle.tendon_slack_length_m;
  return p;
}

const LiteratureMuscle& literature_muscle(std::string_view name) {
  std::string names;
  for (const LiteratureMuscle& muscle : kElbowMuscles) {
    if (muscle.name == name) return muscle;
    names += (names.empty() ? "" : ", ") + std::string(muscle.name);
  }
  throw InvalidInput(fmt::format("no literature for a muscle '{}'; there is for {}", name, names));
}

HillParameters<double> hill_from_thelen(const ThelenParameters& thelen, double slope_ratio) {
  const double l0_m = thelen.optimal_fiber_length_m;
  HillParameters<double> p;
  p.max_isometric_force_n = thelen.max_isometric_force_n;
  p.optimal_fiber_length_m = l0_m;
  p.force_length_width_m = l0_m * std::sqrt(thelen.active_shape);
  p.concentric_curvature = thelen.concentric_shape;
  p.eccentric_curvature_product = curvature_product_from_slope_ratio(
      slope_ratio, thelen.concentric_shape, thelen.eccentric_plateau);
  p.eccentric_plateau = thelen.eccentric_plateau;
  p.max_shortening_speed_mps = thelen.max_contraction_velocity * l0_m;
  p.tendon_slack_length_m = thelen.tendon_slack_length_m;
  return p;
}

}  // namespace myoid::muscle
