#include "myoid/opensim/projects/calibration_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace myoid::opensim {
namespace {

std::size_t unknown_count(const Project& project) {
  std::size_t count = 0;
  for (const ProjectMuscle& muscle : project.muscles)
    for (const auto& [quantity, number] : muscle.numbers)
      if (number.unknown) count = std::max(count, *number.unknown + 1);
  return count;
}

std::optional<CalibrationBounds> bounds_of(const ProjectNumber& number, const PlannedQuantity& planned) {
  if (!planned.bounds || !planned.is_relative) return planned.bounds;
  if (!number.start) return std::nullopt;
  const CalibrationBounds base = number.bounds.value_or(CalibrationBounds{*number.start, *number.start});
  const auto [low, high] = std::minmax({base.lower * planned.bounds->lower, base.lower * planned.bounds->upper,
                                        base.upper * planned.bounds->lower, base.upper * planned.bounds->upper});
  return CalibrationBounds{low, high};
}

/// Returns true for a quantity that programs give many muscles at once.
bool is_shareable(MuscleQuantity quantity) {
  switch (quantity) {
    case MuscleQuantity::optimal_fiber_length:
    case MuscleQuantity::pennation_angle:
    case MuscleQuantity::tendon_slack_length:
    case MuscleQuantity::max_isometric_force:
      return false;
    default:
      return true;
  }
}

}  // namespace

void plan(Project& project, const PlannedQuantity& planned, const std::vector<std::string>& muscles) {
  std::vector<std::vector<std::string>> sharing;
  const std::set<std::string> wanted(muscles.begin(), muscles.end());
  if (planned.sharing == Sharing::all) sharing.push_back(muscles);
  if (planned.sharing == Sharing::groups) sharing = planned.groups;
  if (planned.sharing == Sharing::single)
    for (const std::string& name : wanted) sharing.push_back({name});
  std::size_t next = unknown_count(project);
  for (const std::vector<std::string>& group : sharing) {
    bool is_used = false;
    for (const std::string& name : group) {
      ProjectMuscle* muscle = project.find(name);
      if (muscle == nullptr || !wanted.contains(name)) continue;
      const auto number = muscle->numbers.find(planned.quantity);
      if (number == muscle->numbers.end()) continue;
      number->second.bounds = bounds_of(number->second, planned);
      if (!number->second.unknown) {
        number->second.unknown = next;
        is_used = true;
      }
    }
    if (is_used) ++next;
  }
}

void set_starts(Project& project, const std::vector<ProjectMuscle>& start) {
  for (const ProjectMuscle& other : start) {
    ProjectMuscle* muscle = project.find(other.name);
    if (muscle == nullptr) continue;
    for (const auto& [quantity, number] : other.numbers) {
      const auto own = muscle->numbers.find(quantity);
      if (own != muscle->numbers.end()) own->second.start = number.value;
    }
  }
}

void plan_changed_numbers(Project& project) {
  constexpr double kRounding = 1e-9;
  std::size_t next = unknown_count(project);
  std::map<std::pair<MuscleQuantity, double>, std::size_t> shared;
  for (ProjectMuscle& muscle : project.muscles) {
    for (auto& [quantity, number] : muscle.numbers) {
      if (!number.start || std::abs(number.value - *number.start) <= kRounding * std::abs(*number.start)) continue;
      if (!is_shareable(quantity)) {
        number.unknown = next++;
        continue;
      }
      const auto [same, is_new] = shared.try_emplace({quantity, number.value}, next);
      if (is_new) ++next;
      number.unknown = same->second;
    }
  }
}

}  // namespace myoid::opensim
