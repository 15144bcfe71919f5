#pragma once

#include <string>
#include <vector>

#include "myoid/intervals/result.h"

namespace myoid::identification {

/// The single errors whose signature estimates carry, by muscle: an EMG delay that was not
/// accounted for, co-contraction that force sharing set to zero, EMG and force that disagree in
/// gain. Found by simulation of each error alone; a signature is no proof. What is to be read is a
/// minimum: no estimates of a fit that did not converge.
[[nodiscard]] std::vector<std::string> signatures(const std::vector<ParameterEstimate>& estimates);

}  // namespace myoid::identification
