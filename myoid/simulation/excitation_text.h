#pragma once

#include <string>
#include <vector>

#include "myoid/simulation/excitation.h"

namespace myoid::simulation {

/// Reads the excitation of each muscle from the texts of `simulate --excite`: MUSCLE=LEVEL (all the
/// time), MUSCLE=LEVEL@START (a step) or MUSCLE=LEVEL@START+DURATION (a burst), with a level of 0
/// to 1 and times in seconds. "all" means every muscle; muscles without a text have `rest`. Throws
/// InvalidInput for a text of another form and an unknown muscle.
[[nodiscard]] std::vector<simulation::Signal> described_excitations(const std::vector<std::string>& texts,
                                                                    double rest,
                                                                    const std::vector<std::string>& muscles);

}  // namespace myoid::simulation
