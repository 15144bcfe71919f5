#include "myoid/study/checks/needed_coordinates.h"

#include <set>

#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/kinematics/path_surrogate.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

/// Adds the coordinates of all joints that move the child of this joint, or are moved by it.
void add_limb(const body::BodyModel& model, std::size_t joint, std::set<int>& needed) {
  const std::vector<bool> carried = body::moved_bodies(model, static_cast<int>(joint));
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const int other = model.coordinates[c].joint;
    const auto child = static_cast<std::size_t>(model.joints[static_cast<std::size_t>(other)].child);
    const auto own = static_cast<std::size_t>(model.joints[joint].child);
    if (carried[child] || body::moved_bodies(model, other)[own]) needed.insert(static_cast<int>(c));
  }
}

}  // namespace

std::vector<std::string> needed_coordinates(const Study& study, const body::BodyModel& model, const TrialSpec& trial) {
  std::set<int> needed;
  for (const body::MuscleGroup& group : muscle_groups(study, model)) {
    for (const int m : group.members) {
      const std::vector<int> acting = body::acting_coordinates(model, model.muscles[static_cast<std::size_t>(m)].path);
      needed.insert(acting.begin(), acting.end());
    }
  }
  const bool measured = trial.external_torque || trial.load_cell || trial.given.torques;
  for (const std::string& name : study_coordinates(study.model)) {
    const auto index = model.find_coordinate(name);
    if (!index) continue;
    needed.insert(*index);
    if (!measured)
      add_limb(model, static_cast<std::size_t>(model.coordinates[static_cast<std::size_t>(*index)].joint), needed);
  }
  std::vector<std::string> names;
  for (const int c : needed) names.push_back(model.coordinates[static_cast<std::size_t>(c)].name);
  return names;
}

}  // namespace myoid::study
