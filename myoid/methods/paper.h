#pragma once

#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

struct PaperOptions {
  /// If above 1, searches from as many starts (start_box.h) and keeps their ends in
  /// IdentificationResult::basins. The estimates stay the given start's.
  int multistart = 0;
  std::vector<std::string> muscles;  ///< Empty: all.
  bool shared_forces = false;        ///< Computed by an optimizer: at best `weak`.
  /// Looks for signatures of errors (IdentificationResult::diagnoses) by damped steps, where plain
  /// ones do not converge.
  bool diagnoses = true;
};

/// The source paper's estimator, as published: for every muscle, shortening (v <= 0) and
/// lengthening (v > 0) are fitted apart to the force that force sharing assigned to it,
///
///   case 1: x = [l0, l_sh, V_sh]        case 2: x = [l0, l_sh, P, V_ml],      min 1/2 sum (F_t -
///   F_m(x))^2
///
/// by plain Gauss-Newton from the starting values, without bounds, weights or priors, with F_max
/// and v_max held, the EMG envelope taken for the activation without a delay; samples with a = 0 or
/// v <= -v_max are left out and counted. All calibration trials together. What a muscle's setup or
/// a rule holds is held here too (paper_case.h); bounds, priors and ties do not exist in it.
///
/// Beyond the paper this adds standard errors from the SVD of the Jacobian, widened for
/// the correlation of the residuals in time (n over the effective number of samples), a Wald test
/// of the l0 and l_sh that both cases found (where p < 0.01 nothing of that muscle is
/// `identified`), and a verdict. Throws InvalidInput if the data have no forces.
[[nodiscard]] IdentificationResult identify_paper(const StudyData& data,
                                                  const PaperOptions& options = {});

}  // namespace myoid::identification
