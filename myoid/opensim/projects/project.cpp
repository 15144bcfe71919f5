#include "myoid/opensim/projects/project.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "myoid/body/osim/osim_xml.h"

namespace myoid::opensim {
namespace {

/// Returns true for the names of vasti and rectus femoris in the usual models: vas_lat_r, vaslat_l, VL, recfem_r.
bool is_quadriceps(std::string_view muscle) {
  std::string name = body::lower_case(muscle);
  std::erase(name, '_');
  const auto begins = [&](std::string_view start) { return name.starts_with(start); };
  if (begins("vas") || begins("recfem") || begins("rectfem") || begins("rectusfem") || begins("quad")) return true;
  for (const std::string_view side : {"", "r", "l"})
    for (const std::string_view short_name : {"vl", "vm", "vi", "rf"})
      if (name == std::string(short_name) + std::string(side)) return true;
  return false;
}

}  // namespace

bool ProjectNumber::is_on_bound() const {
  if (!bounds) return false;
  constexpr double kNear = 0.01;
  const double near = kNear * (bounds->upper - bounds->lower);
  return value <= bounds->lower + near || value >= bounds->upper - near;
}

ProjectMuscle* Project::find(std::string_view name) {
  const auto at = std::find_if(muscles.begin(), muscles.end(), [&](const auto& m) { return m.name == name; });
  return at == muscles.end() ? nullptr : &*at;
}

const ProjectMuscle* Project::find(std::string_view name) const { return const_cast<Project*>(this)->find(name); }

UnknownCount unknowns(const Project& project, MuscleQuantity quantity) {
  std::set<std::size_t> all, on_bound;
  for (const ProjectMuscle& muscle : project.muscles) {
    const auto number = muscle.numbers.find(quantity);
    if (number == muscle.numbers.end() || !number->second.unknown) continue;
    all.insert(*number->second.unknown);
    if (number->second.is_on_bound()) on_bound.insert(*number->second.unknown);
  }
  return {all.size(), on_bound.size()};
}

std::vector<std::string> muscles_without_emg(const Project& project) {
  std::vector<std::string> names;
  if (!project.has_mapping) return names;
  for (const ProjectMuscle& muscle : project.muscles)
    if (muscle.inputs.empty()) names.push_back(muscle.name);
  return names;
}

std::vector<std::string> knees_without_extensor(const Project& project) {
  std::vector<std::string> knees;
  if (!project.has_mapping) return knees;
  for (const ProjectDof& dof : project.dofs) {
    if (dof.muscles.empty() || body::lower_case(dof.name).find("knee") == std::string::npos) continue;
    const bool has = std::any_of(dof.muscles.begin(), dof.muscles.end(), [&](const std::string& name) {
      const ProjectMuscle* muscle = project.find(name);
      return muscle != nullptr && !muscle->inputs.empty() && is_quadriceps(name);
    });
    if (!has) knees.push_back(dof.name);
  }
  return knees;
}

}  // namespace myoid::opensim
