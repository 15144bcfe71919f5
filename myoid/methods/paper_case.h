#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/muscle_sample.h"
#include "myoid/identification/study_data.h"
#include "myoid/math/least_squares.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::identification {

/// One fit of the source paper's method: one muscle in shortening (v <= 0) or lengthening.
struct PaperCase {
  std::string muscle;
  bool shortening = true;
  muscle::HillParameters<double> start;
  /// l0, l_sh, V_sh, or l0, l_sh, P, V_ml, without the numbers that are held at their start.
  std::vector<const muscle::HillField*> unknowns;
  std::vector<MuscleSample> samples;
  std::vector<Eigen::Index> pieces;  ///< Lengths of the stretches of consecutive samples.
  int dropped = 0;                   ///< Samples with a = 0 or v <= -v_max.

  [[nodiscard]] Eigen::VectorXd start_vector() const;
  [[nodiscard]] double largest_force_n() const;
  /// The reason why the case is not fitted: fewer than ten samples per unknown, or no force at all.
  /// Empty: it is fitted.
  [[nodiscard]] std::string obstacle() const;
  /// r_i = F_m(x) - F_i, without bounds; it refers to this case, which has to outlive it.
  [[nodiscard]] math::LeastSquaresProblem problem() const;
};

/// From all calibration trials, the EMG envelope taken for the activation without a delay. Held is
/// what MuscleSetup::fixed names or the last of `StudyData::rules` about it frees not; a rule's
/// value is where it starts. Throws InvalidInput if a trial has no forces.
[[nodiscard]] PaperCase paper_case(const StudyData& data, std::size_t muscle, bool shortening);

/// Plain Gauss-Newton steps, as published. Steps that run away, to where an unknown is a thousand
/// times what it was at the start, are `no_descent`, whatever is flat out there; the width, which
/// enters squared, comes back without its sign. A start where the force is not finite is
/// `not_finite`. Throws Interrupted.
[[nodiscard]] math::LeastSquaresResult search_as_published(const PaperCase& samples,
                                                           const Eigen::VectorXd& start,
                                                           const Progress& progress = {});

}  // namespace myoid::identification
