#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/simulation/sensitivity.h"

namespace myoid {

/// Writes sensitivities/angle.sto, speed.sto, acceleration.sto, torque.sto, device.sto, and per
/// muscle MUSCLE_activation.sto, MUSCLE_fiber_length.sto, MUSCLE_tendon_force.sto: a column per
/// parameter, the derivative in SI units of the quantity over those of the parameter (radians).
void write_sensitivities(const simulation::Sensitivities& sensitivities,
                         const std::vector<std::string>& muscles,
                         const Provenance& provenance,
                         const std::filesystem::path& folder);

}  // namespace myoid
