#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/identification/result.h"
#include "myoid/pipeline/run_study.h"

namespace myoid::pipeline {

/// Table of all estimates, one row per muscle x parameter x method x case, with the columns
/// promised in docs/guide/run.md. Numbers are the shortest text that reads back the same; an absent
/// number is an empty cell.
[[nodiscard]] std::string parameters_csv(
    const std::vector<identification::IdentificationResult>& methods);

/// The same with covariance, diagnostics, folds and phases.
[[nodiscard]] std::string parameters_json(
    const std::vector<identification::IdentificationResult>& methods,
    const std::vector<identification::Fold>& folds,
    const Provenance& provenance,
    const std::vector<TrialPhases>& phases = {});

/// Writes all files of a run but the report: per trial ik.mot, ik_marker_errors.sto, id.sto,
/// MuscleAnalysis_*.sto, StaticOptimization_*, activation.sto, identified_forces.sto,
/// EmgInformed_*; parameters.csv, parameters.json, the identified model, run.json. Each whole or
/// not at all.
void write_results(const StudyResult& result,
                   const Provenance& provenance,
                   const std::filesystem::path& folder);

/// Removes what an earlier run, told by its run.json, left in the folder, so that files of two
/// studies never stand side by side. Files of other names stay.
void remove_results(const std::filesystem::path& folder);

/// Writers of single stages, for the commands that end there.
void write_motion(const model::BodyModel& model,
                  const TimeSeries& q,
                  const std::filesystem::path& path,
                  const std::vector<std::string>& comments);
void write_marker_errors(const kinematics::IkResult& ik, const std::filesystem::path& path);
void write_muscle_kinematics(const kinematics::MuscleKinematics& muscles,
                             const std::filesystem::path& folder);
void write_shared_forces(const forces::MuscleForces& shared, const std::filesystem::path& folder);

}  // namespace myoid::pipeline
