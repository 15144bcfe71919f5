#include "myoid/program/commands/project_files.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/read_project.h"
#include "myoid/program/commands/identify_study.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/study/study_text.h"

namespace myoid::program {

ProjectOfStudy project_of_study(const std::string& path,
                                const std::vector<std::string>& joints,
                                const std::filesystem::path& folder,
                                Remarks& remarks) {
  std::optional<opensim::Project> project = opensim::read_project(path);
  if (!project)
    throw InvalidInput(
        fmt::format("{}: expected a project of CEINMS, CEINMS-RT, NMSM or the muscle redundancy solver, found "
                    "none",
                    path));
  for (const Remark& remark : project->remarks) remarks.add(remark);
  ProjectOfStudy of{.project = std::move(*project), .joints = joints, .study = {}};
  if (of.joints.empty()) of.joints = results::reviewed_joints(of.project);
  of.study = results::study_of_project(of.project, of.joints, folder);
  for (const Remark& remark : of.study.remarks) remarks.add(remark);
  return of;
}

void refuse_inside(const std::filesystem::path& project, const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path held = std::filesystem::weakly_canonical(project, ignored);
  const std::filesystem::path results = std::filesystem::weakly_canonical(folder, ignored);
  if (std::ranges::mismatch(held, results).in1 == held.end())
    throw InvalidInput(
        fmt::format("{} lies in the project, which stays as it is; name another folder by --out", folder.string()));
}

std::string project_toml(const results::ProjectStudy& study, const std::filesystem::path& folder) {
  return study::study_toml(seen_from(folder, study.study));
}

void write_mixed(const std::vector<results::ProjectStudy::MixedEmg>& mixed) {
  for (const results::ProjectStudy::MixedEmg& each : mixed) {
    std::filesystem::create_directories(each.file.parent_path());
    recording::write_storage(each.file, each.emg, {.title = "EMG envelopes of a project, mixed"});
  }
}

void write_project_study(const results::ProjectStudy& study, const std::filesystem::path& folder) {
  write_mixed(study.mixed);
  write_file(folder / "study.toml", project_toml(study, folder));
}

}  // namespace myoid::program
