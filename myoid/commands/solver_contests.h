#pragma once

#include <string>
#include <vector>

#include "myoid/methods/solver_contest.h"

namespace myoid::commands {

/// A contest by the name of its fit: all muscles together, a muscle, a muscle's branch.
struct NamedContest {
  std::string fit;
  identification::SolverContest contest;
};

/// Runs every solver on the fits of the method: torque, force or paper. Throws Interrupted.
[[nodiscard]] std::vector<NamedContest> solver_contests(
    const identification::StudyData& data,
    const std::string& method,
    const identification::EstimatorOptions& estimator,
    const identification::ContestOptions& options);

/// Returns the text of solvers.csv, a row per search.
[[nodiscard]] std::string solvers_csv(const std::vector<NamedContest>& contests);

}  // namespace myoid::commands
