#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/simulation/sensitivity.h"
#include "myoid/body/simulation/simulation.h"
#include "myoid/body/simulation/simulation_model.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/muscle/activation.h"
#include "myoid/muscle/musculotendon_parameters.h"
#include "myoid/page/report.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"
#include "myoid/results/simulation_files.h"

namespace myoid::program {

/// Options of forward dynamics of a model.
struct SimulateOptions {
  Call call;                        ///< Its times are begin and end of the simulation.
  std::string model = "arm4";       ///< A file (.osim), or the built-in arm.
  std::string excitations;          ///< Excitation of each muscle over time (.sto); or `excite`.
  std::vector<std::string> excite;  ///< "MUSCLE=LEVEL", "...@START", "...@START+DURATION".
  double rest = 0.01;               ///< Excitation of muscles that `excite` does not name.
  muscle::TendonMode tendon = muscle::TendonMode::equilibrium;
  std::optional<body::MuscleCurves> curves;         ///< Empty: `paper` for arm4, `file` for a file.
  std::optional<muscle::ActivationLaw> activation;  ///< Empty: `two_lags` for arm4, `thelen` for a file.
  std::vector<std::string> initial, initial_speed;  ///< "COORDINATE=VALUE" [deg, m, deg/s, m/s].
  std::vector<std::string> lock;                    ///< Coordinates that do not move.
  bool horizontal = false;                          ///< arm4 without gravity.
  HeldMass held;
  double rate_hz = 200.0;                ///< Rate of the results.
  double tolerance = 1e-8;               ///< Relative local error of the integration.
  bool energy = false;                   ///< Computes the work of every element, too.
  std::vector<std::string> sensitivity;  ///< Parameters of the model, or beginnings of names with '*'.
  bool figures = false;                  ///< Draws a figure of the movement, too.
  std::string out;                       ///< Folder of `write_simulate`.
};
void visit(SimulateOptions& options, study::SettingVisitor& v);

struct SimulateResult {
  body::Simulation simulation;
  std::optional<body::Sensitivities> sensitivities;  ///< Only of a complete simulation.
  body::BodyModel body;
  results::HeldCoordinates held;  ///< Coordinates of `body` outside the simulation.
  std::vector<page::Figure> figures;
  Provenance provenance;
  std::vector<Remark> remarks;

  /// Returns true if simulation and sensitivities are complete.
  [[nodiscard]] bool finished() const;
};

/// Integrates the motion that the excitations cause. Throws InvalidInput for unknown words, muscles
/// and coordinates, and for settings of the other kind of model.
[[nodiscard]] SimulateResult simulate(const SimulateOptions& options);

/// Initial parts of the names of the files that `write_simulate` writes.
inline const std::vector<std::string_view> kSimulateFiles{
    "motion.mot",       "speeds.sto",      "accelerations.sto", "excitation.sto", "activation.sto", "forces.sto",
    "fiber_forces.sto", "MuscleAnalysis_", "torques.sto",       "states.sto",     "energy.sto",     "simulation.json"};

/// Writes the files of `write_simulation` and `write_sensitivities`, and the figures.
void write_simulate(const SimulateResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
