#include "myoid/body/osim/muscle_laws.h"

#include <cmath>

#include "myoid/muscle/force_velocity.h"

namespace myoid::body {
namespace {

/// Returns the exponent k of the passive force whose slope at its unit force is `slope` times that
/// of a straight line: k / (1 - exp(-k)) = slope.
double passive_shape(double slope) {
  double k = slope;
  for (int i = 0; i < 60; ++i) k = slope * -std::expm1(-k);
  return k;
}

}  // namespace

muscle::HillParameters<double> hill_parameters(const MuscleProperties& p, double slope_ratio) {
  const double l0_m = p.optimal_fiber_length_m;
  return {.max_isometric_force_n = p.max_isometric_force_n,
          .optimal_fiber_length_m = l0_m,
          .force_length_width_m = l0_m * std::sqrt(p.active_shape),
          .concentric_curvature = p.concentric_shape,
          .eccentric_curvature_product =
              muscle::curvature_product_from_slope_ratio(slope_ratio, p.concentric_shape, p.eccentric_plateau),
          .eccentric_plateau = p.eccentric_plateau,
          .max_shortening_speed_mps = p.max_contraction_velocity * l0_m,
          .tendon_slack_length_m = p.tendon_slack_length_m};
}

MuscleStates muscle_states(const MuscleProperties& p) {
  if (const auto* c = std::get_if<MillardCurves>(&p.curves))
    return {c->ignore_tendon_compliance, c->ignore_activation_dynamics};
  if (const auto* c = std::get_if<DeGrooteCurves>(&p.curves))
    return {c->ignore_tendon_compliance, c->ignore_activation_dynamics};
  return {};
}

muscle::MusculotendonLaws class_laws(const MuscleProperties& p, muscle::TendonMode mode) {
  if (std::holds_alternative<MillardCurves>(p.curves)) return muscle::millard_laws(mode);
  const auto* de_groote = std::get_if<DeGrooteCurves>(&p.curves);
  if (de_groote == nullptr) return muscle::thelen_laws(mode);
  muscle::MusculotendonLaws laws = muscle::de_groote_laws(mode);
  if (de_groote->ignore_passive_fiber_force) laws.passive = muscle::PassiveLaw::none;
  return laws;
}

muscle::MusculotendonParameters<double> musculotendon_parameters(const MuscleProperties& p,
                                                                 const muscle::MusculotendonLaws& laws) {
  muscle::MusculotendonParameters<double> result = muscle::published_defaults(hill_parameters(p), laws);
  result.pennation_at_optimal_rad = p.pennation_at_optimal_rad;
  if (laws.tendon == muscle::TendonLaw::thelen) {
    result.tendon_strain = p.max_tendon_strain;
    result.passive_strain = p.max_muscle_strain;
    result.passive_shape = p.passive_shape;
    result.damping = 0.0;
  }
  const auto* de_groote = std::get_if<DeGrooteCurves>(&p.curves);
  if (de_groote != nullptr && laws.tendon == muscle::TendonLaw::de_groote) {
    result.tendon_strain = de_groote->tendon_strain_at_one_force;
    result.passive_strain = de_groote->passive_fiber_strain_at_one_force;
    result.damping = de_groote->fiber_damping;
  }
  const auto* millard = std::get_if<MillardCurves>(&p.curves);
  if (millard != nullptr && laws.tendon == muscle::TendonLaw::millard) {
    result.tendon_strain = millard->tendon_strain_at_one_force;
    result.passive_strain = millard->shape.passive.strain_at_one;
    // The class's default stiffness at F_max is twice that of the line from zero strain.
    const std::optional<double>& stiffness = millard->passive_stiffness_at_one;
    result.passive_shape = passive_shape(stiffness ? *stiffness * result.passive_strain : 2.0);
    result.damping = millard->fiber_damping;
  }
  return result;
}

muscle::MillardShape millard_shape(const MuscleProperties& p) {
  const auto* millard = std::get_if<MillardCurves>(&p.curves);
  if (millard == nullptr) return {};
  muscle::MillardShape shape = millard->shape;
  muscle::MillardPassive& passive = shape.passive;
  passive.stiffness_at_one =
      millard->passive_stiffness_at_one.value_or(2.0 / (passive.strain_at_one - passive.strain_at_zero));
  return shape;
}

}  // namespace myoid::body
