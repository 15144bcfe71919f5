#pragma once

#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/identification/cross_validation.h"
#include "myoid/identification/resting_torque.h"
#include "myoid/identification/result.h"
#include "myoid/pipeline/phases.h"

namespace myoid::pipeline {

/// Table of all estimates, one row per muscle x parameter x method x case, with the columns
/// promised in docs/guide/run.md. Numbers are the shortest text that reads back the same; an absent
/// number is an empty cell.
[[nodiscard]] std::string parameters_csv(
    const std::vector<identification::IdentificationResult>& methods);

/// The same with covariance, diagnostics, folds, phases and resting torques.
[[nodiscard]] std::string parameters_json(
    const std::vector<identification::IdentificationResult>& methods,
    const std::vector<identification::Fold>& folds,
    const Provenance& provenance,
    const std::vector<TrialPhases>& phases = {},
    const std::vector<identification::RestingJoint>& resting = {});

}  // namespace myoid::pipeline
