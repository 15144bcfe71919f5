#include "myoid/opensim/tool_stages.h"

#include <fmt/format.h>

#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/error.h"

namespace myoid::opensim {

void ToolRun::add_notes(const std::vector<std::string>& texts) const {
  for (const std::string& text : texts) result.remarks.push_back({.code = RemarkCode::reading, .says = text});
}

void ToolRun::add_notes(std::vector<Remark> notes) const {
  for (Remark& note : notes) {
    note.severity = Severity::warning;
    result.remarks.push_back(std::move(note));
  }
}

void ToolRun::add_remarks(std::vector<Remark> found, const std::string& where) const {
  for (Remark& remark : found) {
    remark.where = where;
    remark.says = where + ": " + remark.says;
    result.remarks.push_back(std::move(remark));
  }
}

void note_missing_loads(const ToolRun& run,
                        const body::ExternalLoads& loads,
                        const std::filesystem::path& file,
                        const Eigen::VectorXd& times_s) {
  const double first_s = times_s[0], last_s = times_s[times_s.size() - 1];
  if (first_s >= loads.start_s - 1e-3 && last_s <= loads.end_s + 1e-3) return;
  run.note(
      "{}: the loads are known from {} to {} s, the motion goes from {} to {} s; straight lines continue "
      "the loads beyond",
      file.string(), loads.start_s, loads.end_s, first_s, last_s);
}

std::vector<std::pair<std::string, const body::MusclePath*>> paths_of(const body::BodyModel& model) {
  std::vector<std::pair<std::string, const body::MusclePath*>> paths;
  for (const body::Muscle& m : model.muscles) paths.emplace_back(m.name, &m.path);
  for (const body::PathActuator& a : model.path_actuators) paths.emplace_back(a.name, &a.path);
  for (const body::PassiveForce& f : model.passive_forces) {
    if (const auto* spring = std::get_if<body::PathSpring>(&f.law)) paths.emplace_back(f.name, &spring->path);
    if (const auto* ligament = std::get_if<body::Ligament>(&f.law)) paths.emplace_back(f.name, &ligament->path);
  }
  return paths;
}

body::BodyState default_state(const body::BodyModel& model) {
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, body::assemble(model, model.default_q()).q, state);
  return state;
}

void ToolRun::claim(const std::filesystem::path& path) const {
  std::error_code ignored;
  const bool exists = std::filesystem::exists(path, ignored);
  for (const std::filesystem::path& input : result.inputs) {
    if (path != input && (!exists || !std::filesystem::equivalent(path, input, ignored))) continue;
    throw InvalidInput(
        fmt::format("{} is read by this set-up and would be replaced by its result; name another file for one of them",
                    path.string()));
  }
  if (!options.anywhere && !setup.is_near(path))
    throw InvalidInput(
        "{}: the set-up names a place outside its own folder for this result; give --anywhere to write there, or --out "
        "FOLDER",
        path.string());
  folders.claim(path, setup.xml().path());
  require_replaceable(path);
  if (options.claim) options.claim(path);
  if (exists) ++result.replaced;
  result.files.push_back(path);
}

}  // namespace myoid::opensim
