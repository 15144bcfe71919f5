#include "myoid/study/checks/unlike_trials.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/study/checks/muscle_pulls.h"
#include "myoid/study/checks/trial_plausibility.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

constexpr LikenessLimits kLike = kLimits.likeness;

/// Returns the median of the other entries; empty: they are too few.
std::optional<double> median_of_others(const std::vector<double>& values, std::size_t i, int fewest) {
  std::vector<double> others = values;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
  if (std::ssize(others) < fewest) return std::nullopt;
  return math::median(std::move(others));
}

Remark of_torque(const TrialSpec& trial, const std::string& coordinate, double factor) {
  const bool certain = factor > kLike.torque_unit || factor * kLike.torque_unit < 1.0;
  return {
      .code = RemarkCode::unit_doubtful,
      .severity = certain ? Severity::error : Severity::warning,
      .where = trial.name,
      .about = coordinate,
      .value = factor,
      .says = fmt::format(
          "{}: by the EMG the torque on {} is {:.3g} times as large as in the other trials, expected "
          "{:.2g} to {:g} times: {}",
          trial.external_torque->filename().string(), coordinate, factor, 1.0 / kLike.torque_less, kLike.torque_more,
          certain ? "its numbers are in another unit"
                  : "are its numbers in another unit, or has its EMG or a maximal contraction another gain?"),
      .remedy = "write the unit of the numbers in the header, as in '" + coordinate + "_moment [N m]'"};
}

double range_rad(const AngleSpan& span) { return span.greatest_rad - span.least_rad; }

/// Returns true if the i-th trial's numbers are radians, in the place of degrees.
bool are_radians(const std::vector<TrialAngles>& trials, std::size_t i) {
  const AngleSpan& own = trials[i].span;
  const double largest_rad = std::max(own.greatest_rad, -own.least_rad);
  if (largest_rad >= kLimits.joints.least_angle_deg * kDegree || !(range_rad(own) > 0.0)) return false;
  std::vector<TrialAngles> others = trials;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
  const AngleSpan all = span_of(others);
  const double beyond_rad = body::kMotionLimits.beyond_rad;
  if (own.least_rad / kDegree < all.least_rad - beyond_rad ||
      own.greatest_rad / kDegree > all.greatest_rad + beyond_rad)
    return false;
  std::erase_if(others, [&](const TrialAngles& other) { return other.held != trials[i].held; });
  return std::ssize(others) >= kLike.fewest_alike && std::ranges::all_of(others, [&](const TrialAngles& other) {
           return range_rad(other.span) > kLike.angle * range_rad(own);
         });
}

}  // namespace

AngleSpan span_of(const std::vector<TrialAngles>& trials) {
  AngleSpan span;
  for (const TrialAngles& trial : trials) {
    span.least_rad = std::min(span.least_rad, trial.span.least_rad);
    span.greatest_rad = std::max(span.greatest_rad, trial.span.greatest_rad);
  }
  return span;
}

std::vector<Remark> unlike_angles(const AnglesOfStudy& angles) {
  std::vector<Remark> found;
  for (const auto& [name, trials] : angles) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (!are_radians(trials, i)) continue;
      const AngleSpan& span = trials[i].span;
      found.push_back(
          {.code = RemarkCode::unit_doubtful,
           .severity = Severity::warning,
           .where = trials[i].trial,
           .about = name,
           .value = range_rad(span) / kDegree,
           .says = fmt::format("{} goes from {:.2g} to {:.2g} degrees, and in the other trials at least {:.0f} times "
                               "as far: are these the radians of {:.0f} to {:.0f} degrees, under a header that says "
                               "degrees",
                               name, span.least_rad / kDegree, span.greatest_rad / kDegree, kLike.angle,
                               span.least_rad / kDegree / kDegree, span.greatest_rad / kDegree / kDegree),
           .remedy = "then write " + name + " [rad] into its header (of a .mot inDegrees=no)"});
    }
  }
  return found;
}

std::vector<Remark> unlike_torques(const Study& study,
                                   const body::BodyModel& model,
                                   const std::vector<EffortTrial>& trials) {
  std::vector<Remark> found;
  if (std::ranges::none_of(trials, [](const EffortTrial& t) { return t.external_torque != nullptr; })) return found;
  for (const auto& [name, capacity] : joint_capacities(study, model)) {
    const Pulls pulls = pulls_on(study, model, name);
    std::vector<ToldTrial> told = told_trials(trials, name, pulls, 0.0);
    std::vector<double> over;
    for (const ToldTrial& one : told) over.push_back(std::log(one.sums.torque_over_pull(pulls.strength_nm)));
    for (std::size_t i = 0; i < told.size(); ++i) {
      const auto usual = median_of_others(over, i, kLike.fewest_others);
      if (!usual) continue;
      const double factor = std::exp(over[i] - *usual);
      const bool opposed = told[i].sums.unopposed(pulls.strength_nm) < kLike.unopposed;
      const bool more = factor > kLike.torque_more && told[i].peak_nm < capacity.greatest_nm();
      if (more || (factor * kLike.torque_less < 1.0 && !opposed))
        found.push_back(of_torque(*told[i].trial->spec, name, factor));
    }
  }
  return found;
}

}  // namespace myoid::study
