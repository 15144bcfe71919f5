#pragma once

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

struct PaperOptions {
  /// If above 1, searches from as many starts (basins.h) and keeps their ends in
  /// IdentificationResult::basins. The estimates stay the given start's.
  int multistart = 0;
  std::vector<std::string> muscles;  ///< Empty: all.
  bool shared_forces = false;        ///< Computed by an optimizer: no interval, and at best `prior_dominated`.
};

/// Identifies by the source paper's estimator, as published. For every muscle, shortening (v <= 0)
/// and lengthening (v > 0) are fitted separately to the force from force sharing,
///
///   case 1: x = [l0, l_sh, V_sh]        case 2: x = [l0, l_sh, P, V_ml],
///   min 1/2 sum (F_t - F_m(x))^2
///
/// without bounds, weights or priors. The estimate is the minimum of this criterion that Gauss-Newton steps reach from
/// the starting values, each halved until the criterion falls, or else damped steps (`PublishedSearch`). F_max and
/// v_max are held, and the EMG envelope is the activation without a delay. Samples with a = 0 or v <= -v_max are left
/// out and counted. All calibration trials are fitted together. A muscle's setup or a rule can hold further numbers
/// (paper_case.h); bounds, priors and ties have no effect.
///
/// Of measured forces this adds, beyond the paper, standard errors from the SVD of the Jacobian, widened for the
/// correlation of the residuals in time (n over the effective number of samples), a Wald test of the l0 and l_sh of
/// both cases (for p < 0.01 no number of the muscle is `identified`), and a verdict. Throws InvalidInput if the data
/// have no forces.
[[nodiscard]] IdentificationResult identify_paper(const StudyData& data, const PaperOptions& options = {});

}  // namespace myoid::fit
