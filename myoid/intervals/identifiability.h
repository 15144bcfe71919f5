#pragma once

#include "myoid/intervals/judgment.h"

namespace myoid::identification {

/// Fills `verdict` and `reason` of an estimate whose numbers stand.
void judge(ParameterEstimate& estimate,
           const VerdictContext& context,
           const VerdictRules& rules = {});

/// Returns the rank of a verdict among all: a greater one is worse.
[[nodiscard]] int severity(Verdict verdict);

/// |N(0, 1)| that is as improbable as a sum of squares of `count` of them that is this or more
/// (chi-square): one number in standard deviations for several together.
[[nodiscard]] double equivalent_deviations(double sum_of_squares, int count);

}  // namespace myoid::identification
