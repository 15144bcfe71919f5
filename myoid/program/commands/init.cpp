#include "myoid/program/commands/init.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/opensim/projects/read_project.h"
#include "myoid/program/commands/project_files.h"
#include "myoid/study/open_question.h"

namespace myoid::program {

namespace {

/// Returns true for the name of a study file that stands in the place of a folder.
bool names_study(const std::string& name) {
  std::error_code ignored;
  return std::filesystem::path(name).extension() == ".toml" && !std::filesystem::is_directory(name, ignored);
}

/// Returns the folder of a file: "." of a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Returns the study of a project as a draft; empty if there is no project.
std::optional<InitResult> draft_of_project(const InitOptions& o,
                                           const std::filesystem::path& folder,
                                           Remarks& remarks) {
  if (o.from.size() != 1 || !opensim::read_project(o.from.front())) return std::nullopt;
  refuse_inside(o.from.front(), folder);
  std::vector<std::string> joints;
  if (!o.coordinate.empty()) joints.push_back(o.coordinate);
  ProjectOfStudy of = project_of_study(o.from.front(), joints, folder, remarks);
  if (!o.model.empty()) of.study.study.model.file = o.model;
  remarks.note(fmt::format("{} holds a project of {}: the study is made of it; to begin with recordings, name them",
                           o.from.front(), choice_name(of.project.dialect)));
  InitResult result;
  result.draft.todo = {"a maximal contraction of each muscle, as a trial with use = \"mvc\", would tell F_max"};
  result.draft.toml =
      fmt::format("# The project {} as a study. Next: myoid run study.toml --out results\n{}\n\n{}", o.from.front(),
                  study::question_line(result.draft.todo.front()), project_toml(of.study, folder));
  result.mixed = std::move(of.study.mixed);
  return result;
}

}  // namespace

void visit(InitOptions& o, study::SettingVisitor& v) {
  v.folder("dir", o.folder,
           {.says = "Folder for study.toml, or the file itself (.toml).",
            .required = "a folder",
            .option = {.by_place = true}});
  v.path("study", o.study, {.says = "The file.", .otherwise = "study.toml in DIR", .option = {.by_place = true}});
  v.paths("from", o.from,
          {.says = "A recording or a folder of them, repeated, or a project of CEINMS, CEINMS-RT or NMSM.",
           .otherwise = "the folder itself",
           .option = {.keyword = "from_"}});
  v.path("model", o.model,
         {.says = "OpenSim model (.osim).", .otherwise = "the only one in the folders, else the built-in arm4"});
  v.text("coordinate", o.coordinate, {.says = "The joint, by the model's coordinate.", .otherwise = "guessed"});
}

std::filesystem::path study_file(const InitOptions& o) {
  if (!o.study.empty()) return o.study;
  return names_study(o.folder) ? std::filesystem::path(o.folder) : std::filesystem::path(o.folder) / "study.toml";
}

InitResult init(const InitOptions& o) {
  study::DraftOptions options;
  const std::filesystem::path file = study_file(o), folder = folder_of(file);
  if (file.extension() != ".toml")
    throw InvalidInput(fmt::format("'{}' is no name of a study, expected one that ends in .toml", file.string()));
  for (const std::string& from : o.from) options.from.emplace_back(from);
  if (options.from.empty()) options.from.emplace_back(names_study(o.folder) ? folder : std::filesystem::path(o.folder));
  if (!o.model.empty()) options.model = o.model;
  options.coordinate = o.coordinate;
  Remarks remarks(o.call);
  if (std::optional<InitResult> project = draft_of_project(o, folder, remarks)) {
    project->remarks = remarks.list();
    return *std::move(project);
  }
  InitResult result;
  result.draft = study::draft_study(folder, options);
  for (const Remark& remark : result.draft.remarks) remarks.add(remark);
  result.remarks = remarks.list();
  return result;
}

void write_init(const InitResult& result, const std::filesystem::path& path, const Call& call) {
  RecordedFolder held(folder_of(path), "init");
  write_mixed(result.mixed);
  write_file(path, result.draft.toml);
  held.finish();
  Remarks remarks(call);
  for (std::string& note : held.take_notes()) remarks.note(std::move(note));
}

}  // namespace myoid::program
