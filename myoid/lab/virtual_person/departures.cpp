#include "myoid/lab/virtual_person/departures.h"

#include <algorithm>
#include <cmath>

#include "myoid/body/arm/arm4.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::lab {
namespace {

constexpr double kMostDeviations = 2.5;
constexpr double kLeastScale = 0.5;
/// Force scale of De Groote's tendon: F / F_max = 0.2 (exp(ln(6) strain / e0) - 1).
constexpr double kTendonForce = 0.2;

}  // namespace

double bounded_normal(math::Random& random) {
  double z = 0.0;
  do {
    z = random.normal();
  } while (std::abs(z) > kMostDeviations);
  return z;
}

bool Departures::has(const muscle::HillField& parameter) const {
  using Hill = muscle::HillParameters<double>;
  return paper_curves() || parameter.member == &Hill::max_isometric_force_n ||
         parameter.member == &Hill::optimal_fiber_length_m || parameter.member == &Hill::max_shortening_speed_mps ||
         parameter.member == &Hill::tendon_slack_length_m;
}

Departures draw_departures(const TruthSpec& spec, math::Random random) {
  Departures drawn;
  const bool coin = random.uniform() < 0.5;
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    drawn.moment_arm_scale[m] = std::max(kLeastScale, 1.0 + spec.moment_arm_sd * bounded_normal(random));
    drawn.moment_arm_slope_per_rad[m] = spec.moment_arm_slope_sd * bounded_normal(random);
    drawn.tendon_strain[m] = random.uniform(spec.tendon_strain.lower, spec.tendon_strain.upper);
  }
  if (spec.curves == "millard" || (spec.curves == "any" && coin)) {
    drawn.laws = muscle::millard_laws();
  } else if (spec.curves != "paper") {
    drawn.laws = muscle::de_groote_laws();
  }
  return drawn;
}

void scale_moment_arm(body::PlanarMuscle& path, double factor) {
  path.above_m *= factor;
  path.below_m *= factor;
  path.pulley_m *= factor;
}

void taper_moment_arm(body::PlanarMuscle& path, double slope_per_rad, double q0_rad) {
  path.taper_mprad = slope_per_rad * body::travel(path, q0_rad).moment_arm_m;
  path.taper_about_rad = q0_rad;
}

DepartedMuscles::DepartedMuscles(const Departures& departures, const VirtualArm& modelled, const HillSet& muscles)
    : departures_(departures), muscles_(&muscles), paths_(modelled.elbow.muscles) {
  for (std::size_t m = 0; m < paths_.size(); ++m) {
    body::PlanarMuscle& path = paths_[m];
    const double q0_rad = body::kArmOptimalAt_rad[m];
    if (departures_.moment_arm_scale[m] != 1.0) {
      const double length_m = body::travel(path, q0_rad).length_m;
      scale_moment_arm(path, departures_.moment_arm_scale[m]);
      path.constant_m += length_m - body::travel(path, q0_rad).length_m;
    }
    if (departures_.moment_arm_slope_per_rad[m] != 0.0)
      taper_moment_arm(path, departures_.moment_arm_slope_per_rad[m], q0_rad);
  }
  if (!departures_.paper_curves()) {
    const auto parameters = muscle::published_defaults(muscles.front(), departures_.laws);
    curves_.emplace(departures_.laws, muscle::curve_shape(parameters, departures_.laws, {}));
  }
}

MuscleGeometry DepartedMuscles::geometry(const Moment& elbow_flexion_rad) const {
  return geometry_of(paths_, elbow_flexion_rad);
}

double DepartedMuscles::fiber_length_m(std::size_t muscle, double path_m, double tension_n) const {
  const muscle::HillParameters<double>& hill = (*muscles_)[muscle];
  const double strain_at_one = departures_.tendon_strain[muscle];
  if (strain_at_one == 0.0) return path_m - hill.tendon_slack_length_m;
  const double pull = std::max(tension_n, 0.0) / hill.max_isometric_force_n;
  const double strain = strain_at_one * std::log1p(pull / kTendonForce) / std::log1p(1.0 / kTendonForce);
  return path_m - hill.tendon_slack_length_m * (1.0 + strain);
}

PerMuscle DepartedMuscles::full_force_n(const MuscleGeometry& geometry,
                                        const PerMuscle& longer,
                                        const PerMuscle& tension_n) const {
  PerMuscle force_n = {};
  for (std::size_t m = 0; m < force_n.size(); ++m) {
    muscle::HillParameters<double> hill = (*muscles_)[m];
    hill.optimal_fiber_length_m *= longer[m];
    const double length_m = fiber_length_m(m, geometry.length_m[m], tension_n[m]);
    const double speed_mps = geometry.velocity_mps[m];
    force_n[m] = curves_ ? hill.max_isometric_force_n * curves_->length(length_m / hill.optimal_fiber_length_m).value *
                               curves_->velocity({1.0}, speed_mps / hill.max_shortening_speed_mps).value
                         : muscle::hill_force(1.0, length_m, speed_mps, hill);
  }
  return force_n;
}

}  // namespace myoid::lab
