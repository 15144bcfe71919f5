#include "myoid/results/exports/export_files.h"

#include <string>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/osimx_file.h"
#include "myoid/opensim/projects/subject_writer.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;

/// Returns the project before the calibration.
opensim::Project before(opensim::Project project) {
  project.is_calibrated = false;
  for (opensim::ProjectMuscle& muscle : project.muscles)
    for (auto& [quantity, number] : muscle.numbers) number.value = number.start.value_or(number.value);
  return project;
}

}  // namespace

void write_exports(const std::vector<ExportedProject>& exported, const fs::path& folder) {
  for (const ExportedProject& each : exported) {
    if (!each.project) continue;
    opensim::Project project = *each.project;
    if (!project.model.empty())
      project.model = project.model.lexically_relative(fs::absolute(folder).lexically_normal());
    if (each.format == ExportFormat::osimx) {
      write_file(folder / "nmsm.osimx", opensim::osimx_text(project));
      continue;
    }
    const std::string stem = each.format == ExportFormat::ceinms_rt ? "ceinms_rt" : "ceinms";
    project.start = stem + "_uncalibrated.xml";
    write_file(folder / (stem + "_calibrated.xml"), opensim::ceinms_subject_text(project));
    write_file(folder / project.start, opensim::ceinms_subject_text(before(project)));
  }
}

}  // namespace myoid::results
