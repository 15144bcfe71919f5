#include "myoid/muscle/literature.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"

namespace myoid::muscle {

HillParameters<double> literature_parameters(const LiteratureMuscle& muscle) {
  const double l0_m = muscle.optimal_fiber_length_m;
  HillParameters<double> p;
  p.max_isometric_force_n = muscle.max_isometric_force_n;
  p.optimal_fiber_length_m = l0_m;
  p.force_length_width_m = kLiteratureWidth * l0_m;
  p.concentric_curvature = kLiteratureCurvature;
  p.eccentric_curvature_product =
      curvature_product_from_slope_ratio(kLiteratureSlopeRatio, kLiteratureCurvature, kLiteraturePlateau);
  p.eccentric_plateau = kLiteraturePlateau;
  p.max_shortening_speed_mps = kLiteratureSpeed * l0_m;
  p.tendon_slack_length_m = muscle.tendon_slack_length_m;
  return p;
}

const LiteratureMuscle& literature_muscle(std::string_view name) {
  for (const LiteratureMuscle& muscle : kElbowMuscles) {
    if (muscle.name == name) return muscle;
  }
  throw InvalidInput(fmt::format("no literature for a muscle '{}'; there is for {}", name,
                                 name_list(kElbowMuscles, &LiteratureMuscle::name)));
}

}  // namespace myoid::muscle
