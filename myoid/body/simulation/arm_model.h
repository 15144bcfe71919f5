#pragma once

#include "myoid/body/arm/planar_elbow.h"
#include "myoid/body/simulation/simulation_model.h"

namespace myoid::body {

struct ArmSetup {
  body::ArmOptions person;
  bool horizontal = false;  ///< The axis of the elbow is vertical: gravity does not act.
  double held_mass_kg = 0.0;
  ModelSetup model{
      .mode = muscle::TendonMode::rigid, .curves = MuscleCurves::paper, .activation = muscle::ActivationLaw::two_lags};
};

/// Returns the built-in arm, from its file, with an upper arm at rest: the one coordinate is elbow_flexion. Its passive
/// joint is `muscle::elbow_passive`, and what the literature does not say of its muscles `muscle::published_defaults`.
/// This is the arm of equation (8) of the source paper.
[[nodiscard]] SimulationModel make_arm_model(const ArmSetup& setup = {});

}  // namespace myoid::body
