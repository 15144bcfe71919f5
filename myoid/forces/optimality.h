#pragma once

#include "myoid/forces/force_sharing.h"

namespace myoid::forces {

/// Largest violation of the Karush-Kuhn-Tucker conditions of a sharing solution, from the problem
/// alone: balance of every torque relative to the greatest term in it; the gradient d/dx (cost) -
/// lambda' A relative to the greatest part of it, zero for free activations, of the right sign at a
/// bound; bounds kept. Zero for an exact optimum.
[[nodiscard]] double kkt_residual(const SharingProblem& problem, const SharingSolution& solution);

}  // namespace myoid::forces
