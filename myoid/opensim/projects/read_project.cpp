#include "myoid/opensim/projects/read_project.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/opensim/projects/ceinms_project.h"
#include "myoid/opensim/projects/ceinms_rt_project.h"
#include "myoid/opensim/projects/mrs_project.h"
#include "myoid/opensim/projects/nmsm_project.h"
#include "myoid/opensim/projects/project_files.h"
#include "myoid/opensim/projects/project_xml.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;

using ReadDialect = Project (*)(const ProjectFolder&, const RootedFile&);

/// A document from which a project can be read.
struct Entrance {
  ReadDialect read = nullptr;
  std::string_view root = {};
  std::vector<std::string_view> inner = {};  ///< The first element inside; none: any.
  bool stands_alone = false;                 ///< The files beside it may be of others.
};

/// The entrances, the ones that tell most first.
const std::vector<Entrance>& entrances() {
  static const std::vector<Entrance> kEntrances{
      {read_ceinms_project, "ceinmsCalibration", {}},
      {read_ceinms_rt_project, "simulatedAnnealing", {}},
      {read_nmsm_project, "NMSMPipelineDocument", {"MuscleTendonPersonalizationTool"}},
      {read_nmsm_project, "OpenSimDocument", {"MuscleTendonPersonalizationTool"}},
      {read_ceinms_project, "ceinms", {}},
      {read_nmsm_project, "NMSMPipelineDocument", {"OsimxModel"}, true},
      {read_ceinms_rt_project, "subject", {"muscleDefault", "muscles"}, true},
      {read_ceinms_project, "subject", {"mtuDefault", "mtuSet"}, true}};
  return kEntrances;
}

bool leads(const RootedFile& document, const Entrance& entrance) {
  if (document.roots.front() != entrance.root) return false;
  return entrance.inner.empty() ||
         std::find(entrance.inner.begin(), entrance.inner.end(), document.roots.back()) != entrance.inner.end();
}

/// Reads the first script of the muscle redundancy solver.
std::optional<Project> read_script(const fs::path& path, const ProjectFolder& given) {
  std::vector<fs::path> found;
  for (const fs::path& file : given.files())
    if (extension_of(file) == ".m" && is_mrs_script(file)) found.push_back(file);
  if (found.empty()) return std::nullopt;
  const bool is_file = given.files().size() == 1 && given.files().front() == path;
  Project project = read_mrs_project(is_file ? ProjectFolder(fs::absolute(path).parent_path()) : given, found.front());
  if (found.size() > 1)
    note_reading(project.remarks, found.front(),
                 fmt::format("the folder has {} of this kind; this one is read", counted(found.size(), "script")));
  if (given.is_cut()) note_reading(project.remarks, path, "the folder has more files than are looked at");
  return project;
}

}  // namespace

std::optional<Project> read_project(const fs::path& path) {
  std::error_code ignored;
  const bool is_folder = fs::is_directory(path, ignored);
  if (!is_folder && !fs::is_regular_file(path, ignored)) return std::nullopt;
  const ProjectFolder given(path);
  for (const Entrance& entrance : entrances()) {
    std::vector<RootedFile> found;
    for (const RootedFile& document : given.documents())
      if (leads(document, entrance)) found.push_back(document);
    if (found.empty()) continue;
    const bool looks_around = !is_folder && !entrance.stands_alone;
    Project project =
        entrance.read(looks_around ? ProjectFolder(fs::absolute(path).parent_path()) : given, found.front());
    if (found.size() > 1 && !entrance.stands_alone)
      note_reading(
          project.remarks, found.front().path,
          fmt::format("the folder has {} with <{}>; this one is read", counted(found.size(), "file"), entrance.root));
    if (given.is_cut()) note_reading(project.remarks, path, "the folder has more files than are looked at");
    return project;
  }
  return read_script(path, given);
}

}  // namespace myoid::opensim
