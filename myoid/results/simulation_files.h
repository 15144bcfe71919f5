#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/simulation/sensitivity.h"
#include "myoid/body/simulation/simulation.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/page/report.h"

namespace myoid::results {

/// Coordinates outside the simulation, with their values [rad | m].
using HeldCoordinates = std::vector<std::pair<std::string, double>>;

/// Writes motion.mot, speeds.sto, accelerations.sto, excitation.sto, activation.sto, forces.sto, fiber_forces.sto,
/// MuscleAnalysis_*.sto, torques.sto, states.sto, energy.sto if there are energies, and simulation.json, each whole or
/// not at all. docs/guide/simulate.md describes their contents.
void write_simulation(const body::Simulation& simulation,
                      const body::BodyModel& body,
                      const HeldCoordinates& held,
                      const Provenance& provenance,
                      const std::filesystem::path& folder);

/// Returns the end of the simulation, statistics and the balance of energies as JSON with provenance.
[[nodiscard]] std::string simulation_json(const body::Simulation& simulation, const Provenance& provenance);

/// Returns figures of excitation, activation, angles, torques, forces and fiber lengths over time.
[[nodiscard]] page::Figure movement_figure(const body::Simulation& simulation);

/// Returns the source paper's figures 2 and 4: the curves of force over length and velocity with
/// its initial values, and a flexion and extension of the elbow in the horizontal plane under steps
/// of neural input, of the built-in arm with muscle mass.
[[nodiscard]] std::vector<page::Figure> paper_figures();

/// Writes sensitivities/QUANTITY.sto of every quantity: a column per parameter, the derivative in SI units of the
/// quantity over those of the parameter (radians).
void write_sensitivities(const body::Sensitivities& sensitivities,
                         const Provenance& provenance,
                         const std::filesystem::path& folder);

}  // namespace myoid::results
