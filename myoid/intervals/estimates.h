#pragma once

#include <string>

#include "myoid/identification/estimator.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// What the reporting of a solution needs to know beyond it.
struct EstimateContext {
  std::string method;
  bool shared_forces = false;
};

/// Fills estimates with intervals by every route asked for, covariance, rank, collinear sets,
/// diagnoses and warnings of a result from a solution of the estimator.
void report_estimates(const Estimator& estimator,
                      const Estimator::Solution& solution,
                      const StudyData& data,
                      const EstimateContext& context,
                      IdentificationResult& result);

}  // namespace myoid::identification
