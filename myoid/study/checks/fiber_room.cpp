#include "myoid/study/checks/fiber_room.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "myoid/body/model/path_survey.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

struct Lengths {
  double shortest_m = std::numeric_limits<double>::infinity();
  double longest_m = 0.0;
};

/// Returns the lengths of muscles that act as one, over the range of each coordinate with the others at their default.
Lengths lengths_of(const body::BodyModel& model,
                   const body::MuscleGroup& group,
                   const std::vector<std::string>& coordinates) {
  constexpr int kSteps = 12;
  Lengths found;
  for (const std::string& name : coordinates) {
    Eigen::VectorXd sum_m = Eigen::VectorXd::Zero(kSteps + 1);
    for (std::size_t i = 0; i < group.members.size(); ++i)
      sum_m +=
          group.weights[i] * body::lengths_over_range_m(model, group.members[i], model.coordinate_index(name), kSteps);
    found.shortest_m = std::min(found.shortest_m, sum_m.minCoeff());
    found.longest_m = std::max(found.longest_m, sum_m.maxCoeff());
  }
  return found;
}

}  // namespace

FiberRoom fiber_room(const std::string& muscle, double length_m, double tendon_m, double optimal_m) {
  const double fiber_m = length_m - tendon_m;
  if (fiber_m <= 0.0)
    return {true, fmt::format("length of {} of {:.4g} m and tendon_slack_length {:.4g} m leave no fiber", muscle,
                              length_m, tendon_m)};
  const double relative = fiber_m / optimal_m;
  if (relative >= kLimits.model.shortest_fiber && relative <= kLimits.model.longest_fiber) return {};
  return {false, fmt::format("fibers of {} are {:.2g} times their optimal length of {:.4g} m, expected about 1", muscle,
                             relative, optimal_m)};
}

std::vector<Remark> tendons_too_long(const Study& study, const body::BodyModel& model) {
  std::vector<Remark> found;
  const std::vector<std::string> coordinates = study_coordinates(study.model);
  const auto setups = muscle_setups(study, model);
  const std::vector<body::MuscleGroup> groups = muscle_groups(study, model);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Lengths lengths = lengths_of(model, groups[g], coordinates);
    if (!(lengths.longest_m >= lengths.shortest_m)) continue;
    const double tendon_m = setups[g].start.tendon_slack_length_m;
    const double optimal_m = setups[g].start.optimal_fiber_length_m;
    // The length of the path that suits the muscle best.
    const double best_m = std::clamp(tendon_m + optimal_m, lengths.shortest_m, lengths.longest_m);
    const FiberRoom room = fiber_room(setups[g].name, best_m, tendon_m, optimal_m);
    if (room.says.empty()) continue;
    found.push_back({.code = RemarkCode::idle_muscle,
                     .severity = room.none ? Severity::error : Severity::warning,
                     .where = "study",
                     .about = setups[g].name,
                     .says = fmt::format("[[muscle]] {}: {}, and its path is {:.4g} to {:.4g} m long in this model",
                                         setups[g].name, room.says, lengths.shortest_m, lengths.longest_m),
                     .remedy = "correct tendon_slack_length or optimal_fiber_length [m] in the model or in "
                               "[[muscle]] start, or scale the model"});
  }
  return found;
}

}  // namespace myoid::study
