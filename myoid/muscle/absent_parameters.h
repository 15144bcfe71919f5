#pragma once

#include "myoid/muscle/hill_parameters.h"
#include "myoid/muscle/literature.h"

namespace myoid::muscle {

/// Replaces every number of the law that is 0 by the literature's, which follows from the other numbers: from the
/// optimal fiber length and, for V_sh V_shl, from `slope_ratio`. The tendon's length may be 0.
void complete_by_literature(HillParameters<double>& parameters, double slope_ratio = kLiteratureSlopeRatio);

}  // namespace myoid::muscle
