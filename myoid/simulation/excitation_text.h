#pragma once

#include <string>
#include <vector>

#include "myoid/simulation/excitation.h"

namespace myoid::simulation {

/// The excitation of each of the muscles from texts such as those of `simulate --excite`:
/// MUSCLE=LEVEL (all the time), MUSCLE=LEVEL@START (a step) or MUSCLE=LEVEL@START+DURATION (a
/// burst), level 0 to 1, seconds; "all" is every muscle, `rest` what is said of none. Throws
/// InvalidInput for a text of another form and a muscle that is not there.
[[nodiscard]] std::vector<simulation::Signal> described_excitations(
    const std::vector<std::string>& texts, double rest, const std::vector<std::string>& muscles);

}  // namespace myoid::simulation
