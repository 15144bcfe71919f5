#pragma once

#include "myoid/body/forces/force_sharing.h"

namespace myoid::body {

/// Returns the largest violation of the Karush-Kuhn-Tucker conditions of a sharing solution, from the problem alone:
/// balance of every torque relative to its greatest term; the gradient d/dx (cost) - lambda' A relative to its greatest
/// part, zero for free activations, of the right sign at a bound; bounds kept. Zero for an exact optimum.
[[nodiscard]] double kkt_residual(const SharingProblem& problem, const SharingSolution& solution);

}  // namespace myoid::body
