#include "myoid/study/checks/study_muscles.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/model/path_survey.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

/// Returns true unless the muscle's arm by the coordinate is small at every angle.
bool moves(const body::BodyModel& model, int muscle, int coordinate) {
  constexpr int kSteps = 8;
  const Eigen::VectorXd arms = body::arms_over_range_m(model, muscle, coordinate, kSteps);
  return std::ranges::any_of(arms,
                             [](double r) { return !std::isfinite(r) || std::abs(r) >= kLimits.model.least_arm_m; });
}

}  // namespace

std::vector<Remark> shared_muscles(const Study& study) {
  std::vector<Remark> findings;
  for (std::size_t j = 0; j < study.muscles.size(); ++j) {
    const MuscleSpec& b = study.muscles[j];
    for (std::size_t i = 0; i < j; ++i) {
      const MuscleSpec& a = study.muscles[i];
      for (const std::string& name : b.osim) {
        if (std::ranges::find(a.osim, name) == a.osim.end()) continue;
        findings.push_back({.code = RemarkCode::shared_muscle,
                            .severity = Severity::error,
                            .where = "study",
                            .says = fmt::format("muscle '{}' of the model is in the osim lists of {} and of {}: its "
                                                "force would count twice; name it in one",
                                                name, a.name, b.name)});
      }
      if (a.emg != b.emg || a.same_as || b.same_as || a.without_emg) continue;
      findings.push_back({.code = RemarkCode::shared_channel,
                          .severity = Severity::warning,
                          .where = "study",
                          .says = fmt::format("{} and {} both have EMG channel '{}': a slip? Where one electrode "
                                              "stands for two muscles, write emg = {{ same_as = \"{}\" }}",
                                              a.name, b.name, a.emg, a.name)});
    }
  }
  return findings;
}

std::vector<Remark> idle_muscles(const Study& study, const body::BodyModel& model) {
  std::vector<Remark> found;
  const std::vector<std::string> coordinates = study_coordinates(study.model);
  for (const MuscleSpec& spec : study.muscles) {
    std::vector<std::string> idle;
    for (const std::string& name : spec.osim) {
      const int muscle = model.muscle_index(name);
      if (std::ranges::none_of(coordinates,
                               [&](const std::string& c) { return moves(model, muscle, model.coordinate_index(c)); }))
        idle.push_back(name);
    }
    if (idle.empty()) continue;
    const bool all = idle.size() == spec.osim.size();
    found.push_back(
        {.code = RemarkCode::idle_muscle,
         .severity = all ? Severity::error : Severity::warning,
         .where = "study",
         .about = spec.name,
         .says = fmt::format(
             "[[muscle]] {}: {} of the model {} no moment arm about {} (expected {:g} mm or more at some angle): {}",
             spec.name, fmt::join(idle, ", "), idle.size() == 1 ? "has" : "have", fmt::join(coordinates, ", "),
             1000.0 * kLimits.model.least_arm_m,
             all ? "it can make none of the torque; a muscle of the other side?"
                 : "the mean moment arm of this muscle is too small by it"),
         .remedy = "name muscles that cross the joint in osim, or another coordinate in [model]"});
  }
  return found;
}

}  // namespace myoid::study
