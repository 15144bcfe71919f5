#pragma once

#include <string>
#include <vector>

#include "myoid/fit/methods/cross_validation.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/remark.h"
#include "myoid/run/fit_input.h"

namespace myoid::run {

/// The predictions of trials outside the fit.
struct StudyValidation {
  std::vector<fit::Fold> folds;
  std::vector<Remark> remarks;  ///< About the method that predicts.
};

/// Leaves trials, conditions or blocks out (`[identify] folds`) and predicts them by the reported
/// kind of fit to the others. From the EMG on no step uses a left-out trial; by the posterior the search for a fold's
/// mode begins at the answer of `whole`, the fit to all trials, with its law of lag. Method `force` predicts measured
/// forces muscle by muscle (cross_validate_force); exact fits of it are not validated.
[[nodiscard]] StudyValidation study_validation(const FitSource& source,
                                               const FitInput& input,
                                               const fit::IdentificationResult& whole,
                                               const Progress& progress);

}  // namespace myoid::run
