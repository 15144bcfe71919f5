#pragma once

#include <vector>

#include "myoid/fit/intervals/result.h"

namespace myoid::fit {

/// Names the single errors whose signature the estimates carry, by muscle: an EMG delay that the fit ignores,
/// co-contraction that force sharing set to zero, EMG and force that disagree in gain. The signatures come from
/// simulations of each error alone; a signature is no proof. The estimates must be a minimum of a converged fit.
[[nodiscard]] std::vector<Remark> signatures(const std::vector<ParameterEstimate>& estimates);

}  // namespace myoid::fit
