#pragma once

#include <filesystem>

#include "myoid/ground/core/provenance.h"
#include "myoid/page/write_report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Writes all files of a run but the report: per trial ik.mot, ik_marker_errors.sto, id.sto, MuscleAnalysis_*.sto,
/// StaticOptimization_*, activation.sto, identified_forces.sto, drive.sto, EmgInformed_*; parameters.csv,
/// parameters.json, predictions of trials held back, solvers.csv, the identified model, methods.txt and .bib, run.json.
/// Folders of trials and predictions are of Kept::all alone.
void write_results(const run::StudyResult& result,
                   const Provenance& provenance,
                   const std::filesystem::path& folder,
                   page::Kept kept = page::Kept::all);

}  // namespace myoid::results
