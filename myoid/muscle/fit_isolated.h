#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/core/units.h"
#include "myoid/math/least_squares.h"
#include "myoid/muscle/isolated_muscle.h"

namespace myoid::muscle {

/// One experiment on a muscle alone.
struct IsolatedRecording {
  std::string name;
  IsolatedMuscleInput input;
  Eigen::VectorXd time_s, force_n;  ///< Measured force of the tendon; within the input's times.
};

/// All that a unit is made of.
struct IsolatedModel {
  MusculotendonParameters<double> parameters;
  MusculotendonLaws laws;
  MillardShape millard;
};

struct IsolatedFitOptions {
  std::vector<std::string> parameters;  ///< Names of visit_parameters; positive at the start.
  double reach = 3.0;                   ///< A value stays within its start over and times this.
  double relative_tolerance = 1e-7;     ///< Of the integration.
  Progress progress;
};

struct IsolatedEstimate {
  std::string parameter;
  Unit unit = Unit::dimensionless;
  double start = 0.0, value = 0.0;
  double std_error = 0.0;  ///< From the residuals, by their effective number.
  bool at_bound = false;
};

struct IsolatedFit {
  IsolatedModel model;
  std::vector<IsolatedEstimate> estimates;
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  int evaluations = 0;  ///< Of all recordings.
};

/// Force [N] that the model makes at the times of the recording's; NaN where the integration did
/// not get to.
[[nodiscard]] Eigen::VectorXd isolated_force(const IsolatedModel& model,
                                             const IsolatedRecording& recording,
                                             double relative_tolerance = 1e-9,
                                             const Progress& progress = {});

/// Parameters with which the simulated experiments (elastic tendon, mass and all) come nearest to
/// the measured forces: least squares over all samples; logarithms as unknowns, derivatives by
/// central differences. Under the law `millard`
/// eccentric_plateau is the curve's greatest multiplier. Throws InvalidInput for names that are no
/// parameters of the unit, values that are not positive, and sizes that differ.
[[nodiscard]] IsolatedFit fit_isolated_muscle(const IsolatedModel& start,
                                              const std::vector<IsolatedRecording>& recordings,
                                              const IsolatedFitOptions& options);

}  // namespace myoid::muscle
