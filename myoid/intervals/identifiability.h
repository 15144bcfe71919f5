#pragma once

#include "myoid/intervals/judgment.h"

namespace myoid::identification {

/// Fills `verdict` and `reason` of an estimate whose other fields are complete.
void judge(ParameterEstimate& estimate, const VerdictContext& context, const VerdictRules& rules = {});

/// Returns the rank of a verdict; a greater rank is worse.
[[nodiscard]] int severity(Verdict verdict);

/// Returns the |N(0, 1)| that is as improbable as a sum of `count` squares of at least this size
/// (chi-square): several deviations as one number of standard deviations.
[[nodiscard]] double equivalent_deviations(double sum_of_squares, int count);

}  // namespace myoid::identification
