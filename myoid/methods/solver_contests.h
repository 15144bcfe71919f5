#pragma once

#include <string>
#include <vector>

#include "myoid/methods/solver_contest.h"

namespace myoid::identification {

/// A contest by the name of its fit: all muscles together, a muscle, a muscle's branch.
struct NamedContest {
  std::string fit;
  SolverContest contest;
};

/// Runs every solver on the fits of the method: torque, force or paper. Throws Interrupted.
[[nodiscard]] std::vector<NamedContest> solver_contests(const StudyData& data,
                                                        const std::string& method,
                                                        const EstimatorOptions& estimator,
                                                        const ContestOptions& options);

}  // namespace myoid::identification
