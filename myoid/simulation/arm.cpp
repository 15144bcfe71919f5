#include "myoid/simulation/arm.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"

namespace myoid::simulation {

Arm<double> make_arm(const ArmSetup& setup) {
  const model::PlanarElbow elbow = model::planar_elbow(setup.person);
  const auto parameters = model::arm4_muscles(setup.person);
  Arm<double> arm;
  for (std::size_t i = 0; i < elbow.muscles.size(); ++i) {
    const model::PlanarMuscle& path = elbow.muscles[i];
    arm.muscles.push_back({std::string(path.name),
                           {path.constant_m, path.above_m, path.below_m, path.straight_rad, path.pulley_m},
                           muscle::published_defaults(parameters[i], setup.laws),
                           setup.laws,
                           setup.activation});
  }
  arm.inertia_kgm2 = elbow.inertia_kgm2;
  arm.static_moment_kgm = elbow.static_moment_kgm;
  arm.held_mass_kg = setup.held_mass_kg;
  arm.held_at_m = elbow.held_at_m;
  arm.gravity_mps2 = setup.horizontal ? 0.0 : kStandardGravity;
  arm.joint = setup.joint;
  validate(arm);
  return arm;
}

Arm<double> with_tendon_mode(Arm<double> arm, muscle::TendonMode mode) {
  for (ArmMuscle<double>& m : arm.muscles) m.laws.mode = mode;
  return arm;
}

void validate(const Arm<double>& arm) {
  const auto require = [](double value, bool good, const char* what, const char* expected) {
    if (!good || !std::isfinite(value)) {
      throw InvalidInput(fmt::format("{} of the arm is {}, expected {}", what, value, expected));
    }
  };
  require(arm.inertia_kgm2, arm.inertia_kgm2 > 0.0, "inertia_kgm2", "more than 0");
  require(arm.static_moment_kgm, true, "static_moment_kgm", "a finite number");
  require(arm.held_mass_kg, arm.held_mass_kg >= 0.0, "held_mass_kg", "0 or more");
  require(arm.held_at_m, true, "held_at_m", "a finite number");
  require(arm.gravity_mps2, true, "gravity_mps2", "a finite number");
  muscle::validate(arm.joint);
  for (const ArmMuscle<double>& m : arm.muscles) {
    try {
      muscle::validate(m.parameters, m.laws);
      muscle::validate(m.activation);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{}: {}", m.name, error.what()));
    }
  }
}

}  // namespace myoid::simulation
