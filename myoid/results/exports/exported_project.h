#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/opensim/projects/project.h"
#include "myoid/results/exports/law_differences.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Identified muscles as a calibration of another program, with what its law changes.
struct ExportedProject {
  ExportFormat format = ExportFormat::ceinms;
  /// Each number has its start, from which the fit began. Paths are absolute. Empty: nothing can be exported, and a
  /// remark says why.
  std::optional<opensim::Project> project = {};
  std::vector<LawDifference> differences = {};  ///< For each [[muscle]].
  std::vector<Remark> remarks = {};
};

/// Returns the muscles of the best method for a program with subject files; not for `osim`.
///
/// Each head of a [[muscle]] is a muscle; lengths and force change in the group's proportion, as in the identified
/// model. All numbers of the fit are taken, whatever their verdict, because they predict the torque together. CEINMS:
/// gains, shares and F_max make the strength coefficient beside the start's force; width of the force-length curve,
/// force-velocity and passive curve, shift of the optimal length and tendon strain are those of all muscles together,
/// their means weighted by F_max, and the curves are tables of our law. CEINMS-RT normalises speeds by 10 optimal fiber
/// lengths per second, so that v_max is one of these numbers. NMSM: the curves are the Pipeline's own.
[[nodiscard]] ExportedProject exported_project(const run::StudyResult& result, ExportFormat format);

/// Returns each form once; none for `osim`, which every run writes.
[[nodiscard]] std::vector<ExportedProject> exported_projects(const run::StudyResult& result,
                                                             const std::vector<ExportFormat>& formats);

/// Returns the remarks of all.
[[nodiscard]] std::vector<Remark> remarks_of(const std::vector<ExportedProject>& exported);

}  // namespace myoid::results
