#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/math/least_squares.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::fit {

/// One muscle at one instant of a recording.
struct MuscleSample {
  double time_s = 0.0;
  double activation = 0.0;  ///< 0..1
  double fiber_length_m = 0.0;
  double fiber_velocity_mps = 0.0;  ///< Lengthening positive.
  double force_n = 0.0;             ///< From force sharing.
};

/// One fit of the source paper's method: one muscle in shortening or at rest (v <= 1e-9 m/s), or in lengthening.
struct PaperCase {
  std::string muscle;
  bool shortening = true;
  muscle::HillParameters<double> start;
  /// l0, l_sh, V_sh, or l0, l_sh, P, V_ml, without the numbers that are held at their start.
  std::vector<const muscle::HillField*> unknowns;
  std::vector<MuscleSample> samples;
  std::vector<Eigen::Index> pieces;  ///< Lengths of the stretches of consecutive samples.
  int dropped = 0;                   ///< Samples with a = 0 or v <= -v_max.

  /// Returns muscle and branch: "BIC shortening".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] Eigen::VectorXd start_vector() const;
  /// Returns the reason why the case is not fitted: fewer than ten samples per unknown, or no
  /// force. Empty if it is fitted.
  [[nodiscard]] std::string obstacle() const;
  /// Returns r_i = F_m(x) - F_i without bounds. The problem refers to this case, which must outlive it.
  [[nodiscard]] math::LeastSquaresProblem problem() const;
};

/// Builds the case from all calibration trials, with the EMG envelope as activation, without a
/// delay. A number is held if MuscleSetup::fixed names it, unless the last of `StudyData::rules`
/// about it frees it; a rule's value is the start. Throws InvalidInput if a trial has no forces.
[[nodiscard]] PaperCase paper_case(const StudyData& data, std::size_t muscle, bool shortening);

/// Searches by plain Gauss-Newton steps, as published. Steps that take an unknown beyond a thousand times its start end
/// as `no_descent`, even if the cost is flat there. The width, which enters squared, loses its sign. A start with a
/// force that is not finite is `not_finite`. Throws Interrupted.
[[nodiscard]] math::LeastSquaresResult search_as_published(const PaperCase& samples,
                                                           const Eigen::VectorXd& start,
                                                           const Progress& progress = {});

/// End of a search for the minimum of the published criterion.
struct MinimumSearch {
  math::LeastSquaresResult found;
  bool damped = false;  ///< By Levenberg-Marquardt's steps.
};

/// Searches for the minimum of the published criterion by the same steps, each halved until the criterion falls; where
/// they find none, by damped steps. Ends as `search_as_published` does. An end where the muscle makes no force is none.
[[nodiscard]] MinimumSearch search_for_minimum(const PaperCase& samples, const Eigen::VectorXd& start);

}  // namespace myoid::fit
