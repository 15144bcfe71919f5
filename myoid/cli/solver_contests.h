#pragma once

#include <string>
#include <vector>

#include "myoid/methods/solver_contest.h"

namespace myoid::cli {

/// A contest by the name of its fit: all muscles together, a muscle, a muscle's branch.
struct NamedContest {
  std::string fit;
  identification::SolverContest contest;
};

/// Every solver on the fits of the method: torque, force or paper. Throws Interrupted.
[[nodiscard]] std::vector<NamedContest> solver_contests(
    const identification::StudyData& data,
    const std::string& method,
    const identification::EstimatorOptions& estimator,
    const identification::ContestOptions& options);

void print_contest(const NamedContest& contest);
/// Where the searches of several starts ended.
void print_basins(const identification::BasinTable& table);

/// solvers.csv
[[nodiscard]] std::string solvers_csv(const std::vector<NamedContest>& contests);

}  // namespace myoid::cli
