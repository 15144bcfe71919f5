#pragma once

#include <filesystem>

#include "myoid/core/provenance.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Writes all files of a run but the report: per trial ik.mot, ik_marker_errors.sto, id.sto, MuscleAnalysis_*.sto,
/// StaticOptimization_*, activation.sto, identified_forces.sto, drive.sto, EmgInformed_*; parameters.csv,
/// parameters.json, predictions of trials held back, solvers.csv, the identified model, methods.txt and .bib, run.json.
void write_results(const StudyResult& result, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace myoid
