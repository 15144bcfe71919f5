#include "myoid/program/contents/project_contents.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/names.h"
#include "myoid/ground/core/remark.h"
#include "myoid/opensim/projects/read_project.h"

namespace myoid::program {
namespace {

using nlohmann::ordered_json;
using opensim::Project;
using opensim::ProjectMuscle;
using opensim::ProjectTrial;

constexpr std::size_t kListed = 10;

void tell_files(const Project& project, ordered_json& j) {
  const auto tell = [&](const char* key, const std::filesystem::path& path) {
    if (!path.empty()) j[key] = path.string();
  };
  tell("set_up", project.set_up);
  tell("subject", project.subject);
  tell("start", project.start);
  tell("model", project.model);
}

void tell_law(const Project& project, ordered_json& j) {
  if (!project.tendon.empty()) j["tendon"] = project.tendon;
  if (!project.activation.empty()) j["activation"] = project.activation;
  if (project.common.delay_s) j["delay_s"] = *project.common.delay_s;
  if (project.common.damping) j["damping"] = *project.common.damping;
  if (project.common.percentage_change) j["percentage_change"] = *project.common.percentage_change;
  if (project.hybrid)
    j["hybrid"] = {
        {"alpha", project.hybrid->torque}, {"beta", project.hybrid->excitation_sum}, {"gamma", project.hybrid->emg}};
  for (const opensim::ProjectCurve& curve : project.curves)
    j["curves"].push_back({{"name", curve.name}, {"points", curve.x.size()}});
}

void tell_dofs(const Project& project, ordered_json& j) {
  for (const opensim::ProjectDof& dof : project.dofs) {
    ordered_json told{{"name", dof.name}, {"calibrated", dof.is_calibrated}};
    if (!dof.muscles.empty()) {
      told["muscles"] = dof.muscles.size();
      if (project.has_mapping)
        told["without_emg"] = std::count_if(dof.muscles.begin(), dof.muscles.end(), [&](const std::string& name) {
          const ProjectMuscle* muscle = project.find(name);
          return muscle == nullptr || muscle->inputs.empty();
        });
    }
    j["degrees_of_freedom"].push_back(std::move(told));
  }
}

void tell_trials(const Project& project, ordered_json& j) {
  for (const ProjectTrial& trial : project.trials) {
    ordered_json told{{"name", trial.name}, {"calibration", trial.is_calibrating}};
    if (trial.used) {
      told["from_s"] = trial.used->begin_s;
      told["to_s"] = trial.used->end_s;
    }
    std::vector<std::string> not_read;
    for (const opensim::TrialFile& file : trial.files) {
      if (file.role != opensim::TrialRole::emg && file.role != opensim::TrialRole::torques) continue;
      const std::string role(choice_name(file.role));
      if (!file.time) {
        not_read.push_back(role);
        continue;
      }
      told[role + "_duration_s"] = file.time->end_s - file.time->begin_s;
      told[role + "_rate_hz"] = file.rate_hz;
    }
    if (!not_read.empty()) told["not_read"] = name_list(not_read);
    j["trials"].push_back(std::move(told));
  }
}

void tell_numbers(const Project& project, ordered_json& j) {
  std::size_t all = 0, on_bound = 0;
  ordered_json by_parameter = ordered_json::array();
  for (std::size_t k = 0; k < std::size(opensim::kMuscleQuantityNames); ++k) {
    const auto quantity = static_cast<opensim::MuscleQuantity>(k);
    const opensim::UnknownCount count = unknowns(project, quantity);
    if (count.all == 0) continue;
    all += count.all;
    on_bound += count.on_bound;
    by_parameter.push_back(
        {{"name", std::string(choice_name(quantity))}, {"numbers", count.all}, {"on_bound", count.on_bound}});
  }
  j["calibrated_numbers"] = all;
  j["numbers_on_bound"] = on_bound;
  if (!by_parameter.empty()) j["calibrated_parameters"] = std::move(by_parameter);
  std::vector<bool> seen;
  for (const ProjectMuscle& muscle : project.muscles) {
    for (const auto& [quantity, number] : muscle.numbers) {
      if (!number.unknown || !number.is_on_bound()) continue;
      seen.resize(std::max(seen.size(), *number.unknown + 1));
      if (seen[*number.unknown] || j["first_on_bound"].size() >= kListed) continue;
      seen[*number.unknown] = true;
      j["first_on_bound"].push_back({{"name", muscle.name},
                                     {"parameter", std::string(choice_name(quantity))},
                                     {"value", number.value},
                                     {"lower", number.bounds->lower},
                                     {"upper", number.bounds->upper}});
    }
  }
}

}  // namespace

std::optional<ordered_json> project_contents(const std::filesystem::path& path) {
  const std::optional<Project> read = opensim::read_project(path);
  if (!read) return std::nullopt;
  const Project& project = *read;
  ordered_json j{{"kind", "calibration of another program"}, {"dialect", std::string(choice_name(project.dialect))}};
  if (!project.version.empty()) j["version"] = project.version;
  tell_files(project, j);
  tell_law(project, j);
  j["calibrated"] = project.is_calibrated;
  j["muscle_count"] = project.muscles.size();
  tell_dofs(project, j);
  tell_trials(project, j);
  tell_numbers(project, j);
  const auto tell = [&](const char* key, const std::vector<std::string>& names) {
    if (!names.empty()) j[key] = names;
  };
  tell("muscles_without_emg", muscles_without_emg(project));
  tell("synthesized_muscles", project.synthesized);
  tell("knees_without_extensor", knees_without_extensor(project));
  std::vector<Remark> remarks = project.remarks;
  sort_by_severity(remarks);
  tell("notes", sentences(remarks));
  return j;
}

}  // namespace myoid::program
