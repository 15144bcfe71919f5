#pragma once

#include <optional>
#include <vector>

#include "myoid/identification/parameters.h"
#include "myoid/intervals/discrepancy.h"
#include "myoid/intervals/profile_likelihood.h"
#include "myoid/intervals/result.h"
#include "myoid/intervals/uncertainty.h"

namespace myoid::identification {

inline constexpr double kReportedProbability = 0.95;  ///< Probability of every interval.

/// All routes to the intervals of one fit.
struct Intervals {
  Sandwich sandwich;
  std::optional<Discrepancy> model_error;
  Eigen::MatrixXd tendon_shift;  ///< `held_tendon_shift`, or empty.
  std::optional<BootstrapResult> bootstrap;
  std::optional<std::vector<Interval>> profiles;
};

/// Scale of a row: converts a number of the solver into the row's unit.
struct RowScale {
  const Unknown* parameter = nullptr;
  double ratio = 1.0;
  [[nodiscard]] double value(double z) const { return ratio * parameter->to_value(z); }
};

/// Returns the solver's number for a value of this row.
[[nodiscard]] double z_of(const RowScale& row, double value);

/// Fills `e.routes` with all intervals, and `e.ci_low`, `e.ci_high` with the reported 95 % one.
/// Either side reaches as far as the wider of sandwich and profile, plus the model's error, and at
/// least as far as trials differ (with few trials by the jackknife, which is never too small).
void add_routes(ParameterEstimate& e, const RowScale& row, const Intervals& intervals, Eigen::Index at, double z);

}  // namespace myoid::identification
